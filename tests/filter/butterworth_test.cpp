#include "palpate/filter/butterworth.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "palpate/filter/filtered_profile.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::butterworth_test {
namespace {

using Band = ButterworthOptions::Band;

constexpr double kRateHz = 74.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// What scipy 1.10.1 gives for the signal below, at the samples of kAt:
//   sos = scipy.signal.butter(order, edges, band, fs=74, output="sos")
//   forward   = scipy.signal.sosfilt(sos, x, zi=scipy.signal.sosfilt_zi(sos) * x[0])[0]
//   zeroPhase = scipy.signal.sosfiltfilt(sos, x)
struct Reference {
  Band band;
  double lowHz, highHz;
  int order;
  double forward[6], zeroPhase[6];
};
constexpr std::size_t kAt[] = {0, 1, 10, 51, 75, 119};
const Reference kReferences[] = {
    {Band::kLowPass,
     1,
     5,
     1,
     {3.5, 3.50573017273, 3.49236362742, 5.10403151171, 5.96252181418, 5.64432073403},
     {3.46833843211, 3.49981427376, 3.20002444189, 5.29453592588, 5.46098295486, 5.54501870483}},
    {Band::kLowPass,
     1,
     5,
     2,
     {3.5, 3.50111090929, 3.81813093496, 4.61471552539, 6.19994846509, 6.06373035933},
     {3.50718692729, 3.58818703707, 3.18864677082, 5.2598454158, 5.36284528135, 5.5169548862}},
    {Band::kLowPass,
     1,
     12.5,
     5,
     {3.5, 3.50036194772, 4.13479279231, 4.56380286415, 5.740747142, 6.00937829558},
     {3.49883237654, 3.27477346885, 3.25254408996, 5.97438616709, 5.39672555918, 5.52783534451}},
    {Band::kLowPass,
     1,
     36,
     8,
     {3.5, 3.52599582525, 3.20644988249, 6.66161258249, 5.67167546575, 5.46795559839},
     {3.50369572236, 3.52857343541, 3.24535390008, 6.38540870325, 5.61512627225, 5.53453582461}},
    {Band::kHighPass,
     0.5,
     5,
     1,
     {-4.4408920985e-16,
      0.0316464088562,
      -0.313682548572,
      2.73254146833,
      0.607321933035,
      -0.349978958082},
     {0.364562639007,
      0.377547743461,
      -0.045931520413,
      1.86078815463,
      0.439054788187,
      0.950735715171}},
    {Band::kHighPass,
     6,
     5,
     4,
     {1.11022302463e-15,
      0.0164670094557,
      0.55266054095,
      0.155388605827,
      -0.0944252822905,
      0.54807569477},
     {0.000159115423655,
      -0.0874722459396,
      -0.00423892785016,
      0.97514229454,
      0.338652155786,
      -0.0306616400536}},
    {Band::kBandPass,
     2,
     8,
     1,
     {-2.10942374679e-15,
      0.0066765769143,
      -0.323699193487,
      1.29992441435,
      -0.377085557226,
      -1.03059570864},
     {0.012682118768,
      0.0611134056053,
      0.0730333848468,
      0.9828533262,
      -0.410735135661,
      0.0209597560648}},
    {Band::kBandPass,
     2,
     8,
     2,
     {0, 0.00152580455585, -0.0954190237343, 0.442771405837, -0.714828881599, -1.08504517303},
     {0.104680935624,
      0.179202648872,
      0.125134140897,
      0.89959608923,
      -0.524922764505,
      0.151239327926}},
    {Band::kBandPass,
     3,
     20,
     5,
     {0, 0.00122397329433, -0.831388376205, -0.156535463466, 0.499393062987, 0.440515030782},
     {0.00841896775783,
      0.0274762198137,
      0.210450907194,
      1.73051665022,
      0.000295875857984,
      -0.0604795430595}},
    {Band::kBandStop,
     4,
     6,
     1,
     {3.5, 3.52978333222, 3.41282115731, 6.25374614813, 6.13030092933, 6.01934697815},
     {3.6048636905, 3.60431970929, 3.1143939507, 6.02795782035, 5.76030029581, 5.54255528058}},
    {Band::kBandStop,
     10,
     16,
     3,
     {3.5, 3.51930592344, 3.56651664957, 4.79677957868, 5.53006752055, 5.44432373281},
     {3.50439845315, 3.59501151556, 3.21755758429, 5.59175145726, 5.26966946358, 5.53155498184}},
    {Band::kBandStop,
     1,
     30,
     8,
     {3.5, 3.50000131594, 3.48402444641, 3.47561300608, 3.33905001624, 4.85892105285},
     {3.55046397374, 3.51096140001, 3.17136301901, 4.41309506125, 5.88117972949, 5.8519866641}},
};

std::vector<double> evenTimes(std::size_t count) {
  std::vector<double> timeS;
  for (std::size_t i = 0; i < count; ++i) timeS.push_back(static_cast<double>(i) / kRateHz);
  return timeS;
}

// x_i = 3 + sin(0.3 i) + cos(1.1 i) / 2 + i / 100, and 2 more from sample 50.
std::vector<double> referenceSignal() {
  std::vector<double> values;
  for (int i = 0; i < 120; ++i)
    values.push_back(3.0 + std::sin(0.3 * i) + 0.5 * std::cos(1.1 * i) + 0.01 * i +
                     (i >= 50 ? 2.0 : 0.0));
  return values;
}

ButterworthOptions optionsOf(const Reference& reference) {
  return {.band = reference.band,
          .lowHz = reference.lowHz,
          .highHz = reference.highHz,
          .order = reference.order};
}

TEST(Butterworth, IsSciPysForwardAndForwardBackward) {
  const std::vector<double> timeS = evenTimes(120), values = referenceSignal();
  for (const Reference& reference : kReferences) {
    const ButterworthOptions options = optionsOf(reference);
    const auto forward = butterworthFiltered(timeS, values, options);
    const auto zeroPhase = butterworthZeroPhase(timeS, values, options);
    for (std::size_t k = 0; k < std::size(kAt); ++k) {
      EXPECT_NEAR(forward[kAt[k]], reference.forward[k], 1e-8)
          << static_cast<int>(reference.band) << " order " << reference.order << " at " << kAt[k];
      EXPECT_NEAR(zeroPhase[kAt[k]], reference.zeroPhase[k], 1e-8)
          << static_cast<int>(reference.band) << " order " << reference.order << " at " << kAt[k];
    }
  }
}

TEST(Butterworth, StreamsTheSameAsAWholeSeries) {
  const std::vector<double> timeS = evenTimes(120), values = referenceSignal();
  for (const Reference& reference : kReferences) {
    const auto expected = butterworthFiltered(timeS, values, optionsOf(reference));
    ButterworthFilter filter(optionsOf(reference), 2);
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        std::vector<double> samples = {values[i], -2.0 * values[i]};
        filter.step(samples, 1.0 / kRateHz);
        ASSERT_NEAR(samples[0], expected[i], 1e-9) << reference.order << " at " << i;
        ASSERT_NEAR(samples[1], -2.0 * expected[i], 1e-9) << reference.order << " at " << i;
      }
      filter.restart();
    }
  }
}

// |H|^2 = 1 / (1 + e^(2 n)), with e the analog frequency over that of the edge; 1/2 at every edge.
TEST(Butterworth, HasTheAmplitudeOfTheFormulaAtEveryFrequency) {
  const auto analog = [](double hz) { return std::tan(std::numbers::pi * hz / kRateHz); };
  for (const Band band : {Band::kLowPass, Band::kHighPass, Band::kBandPass, Band::kBandStop})
    for (int order = 1; order <= 8; ++order) {
      const ButterworthOptions options{.band = band, .lowHz = 6.0, .highHz = 14.0, .order = order};
      for (const double hz : {2.0, 6.0, 9.0, 14.0, 20.0, 30.0}) {
        const double low = analog(6.0), high = analog(14.0), w = analog(hz);
        double ratio = w / high;
        if (band == Band::kHighPass) ratio = low / w;
        if (band == Band::kBandPass) ratio = (w * w - low * high) / (w * (high - low));
        if (band == Band::kBandStop) ratio = w * (high - low) / (w * w - low * high);
        const double expected = 1.0 / std::sqrt(1.0 + std::pow(ratio, 2 * order));
        // Amplitude of the response to a tone, once the beginning is forgotten.
        const std::size_t count = 74 * 40;
        std::vector<double> tone;
        for (std::size_t i = 0; i < count; ++i)
          tone.push_back(std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(i) / kRateHz));
        const auto filtered = butterworthFiltered(evenTimes(count), tone, options);
        double squares = 0.0;
        for (std::size_t i = count / 2; i < count; ++i) squares += filtered[i] * filtered[i];
        EXPECT_NEAR(std::sqrt(2.0 * squares / (static_cast<double>(count) / 2)), expected, 1e-6)
            << static_cast<int>(band) << " order " << order << " at " << hz << " Hz";
      }
    }
}

TEST(Butterworth, IrregularStampsNeedNoResampling) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.2);
  std::vector<double> timeS, tone;
  double t = 0.0;
  for (int i = 0; i < 4000; ++i) {
    t += std::max(0.2, 1.0 + noise(random)) / kRateHz;
    timeS.push_back(t);
    tone.push_back(std::sin(2.0 * std::numbers::pi * 5.0 * t));
  }
  const ButterworthOptions options{.highHz = 20.0, .order = 4};
  const auto zeroPhase = butterworthZeroPhase(timeS, tone, options);
  double squares = 0.0;
  for (std::size_t i = 500; i < 3500; ++i)
    squares += (zeroPhase[i] - tone[i]) * (zeroPhase[i] - tone[i]);
  EXPECT_LT(std::sqrt(squares / 3000.0), 0.01);
}

TEST(Butterworth, IsStableAndKeepsALoadThroughLongIntervals) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const Reference& reference : kReferences) {
    ButterworthFilter filter(optionsOf(reference));
    for (int i = 0; i < 20'000; ++i) {
      double value = 1000.0 * uniform(random);
      const double intervalS = i % 50 == 0 ? 0.9 : std::pow(10.0, -4.0 + 2.5 * uniform(random));
      filter.step({&value, 1}, intervalS);
      // Stamps as wild as these also move the rate; what matters is that nothing grows.
      ASSERT_LT(std::abs(value), 1e6) << reference.order << " at " << i;
    }
  }
  // A constant stays itself, or is nothing for what has no frequency 0.
  ButterworthFilter low({.highHz = 5.0, .order = 6}), high({.band = Band::kHighPass, .order = 6});
  for (int i = 0; i < 200; ++i) {
    double load = 700.0, none = 700.0;
    low.step({&load, 1}, i % 9 == 0 ? 0.3 : 0.013);
    high.step({&none, 1}, i % 9 == 0 ? 0.3 : 0.013);
    ASSERT_NEAR(load, 700.0, 1e-9);
    ASSERT_NEAR(none, 0.0, 1e-9);
  }
}

TEST(Butterworth, RestartsAfterAGap) {
  const std::vector<double> values = referenceSignal();
  std::vector<double> timeS = evenTimes(120);
  for (std::size_t i = 40; i < 120; ++i) timeS[i] += 100.0;
  const std::vector<std::size_t> gaps = {39};
  for (const auto filtered : {butterworthFiltered, butterworthZeroPhase}) {
    const auto whole = filtered(timeS, values, {}, gaps);
    const auto first = filtered(std::span(timeS).first(40), std::span(values).first(40), {}, {});
    const auto second =
        filtered(std::span(timeS).subspan(40), std::span(values).subspan(40), {}, {});
    for (std::size_t i = 0; i < 120; ++i)
      EXPECT_EQ(whole[i], i < 40 ? first[i] : second[i - 40]) << i;
  }
}

TEST(Butterworth, ShortAndOddSeriesAreDefined) {
  for (const auto filtered : {butterworthFiltered, butterworthZeroPhase}) {
    EXPECT_TRUE(filtered({}, {}, {}, {}).empty());
    EXPECT_EQ(filtered(std::vector{1.0}, std::vector{4.0}, {}, {}), std::vector{4.0});
    const auto two = filtered(std::vector{1.0, 2.0}, std::vector{4.0, 4.0}, {}, {});
    EXPECT_NEAR(two[1], 4.0, 1e-12);
    std::vector<double> values = referenceSignal();
    const std::vector<double> timeS = evenTimes(120);
    std::vector<double> interpolated = values;
    values[0] = values[60] = values[119] = kNan;
    interpolated[0] = values[1];
    interpolated[60] = (values[59] + values[61]) / 2.0;
    interpolated[119] = values[118];
    const auto with = filtered(timeS, values, {}, {});
    const auto expected = filtered(timeS, interpolated, {}, {});
    for (std::size_t i = 0; i < 120; ++i) EXPECT_NEAR(with[i], expected[i], 1e-12) << i;
    EXPECT_TRUE(std::isnan(filtered(timeS, std::vector(120, kNan), {}, {})[5]));
    EXPECT_THROW(filtered(std::vector{1.0, 1.0}, std::vector{4.0, 4.0}, {}, {}),
                 std::invalid_argument);
    EXPECT_THROW(filtered(std::vector{1.0}, std::vector{4.0, 4.0}, {}, {}), std::invalid_argument);
  }
  ButterworthFilter filter(ButterworthOptions{});
  double value = kNan;
  filter.step({&value, 1}, 1.0);
  EXPECT_EQ(value, 0.0);
  EXPECT_THROW(filter.step({&value, 1}, 0.0), std::invalid_argument);
  EXPECT_THROW(filter.step({}, 0.1), std::invalid_argument);
}

std::string refusal(const ButterworthOptions& options, double rateHz) {
  try {
    options.validateForRate(rateHz);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

TEST(Butterworth, RefusesWhatTheRateCannotShow) {
  EXPECT_EQ(refusal({.highHz = 36.9}, kRateHz), "taken");
  EXPECT_EQ(refusal({.highHz = 37.0}, kRateHz),
            "low-pass: 37 Hz is not below 37.00 Hz, half the rate of 74.00 samples/s");
  EXPECT_EQ(refusal({.band = Band::kHighPass, .lowHz = 40.0}, kRateHz),
            "high-pass: 40 Hz is not below 37.00 Hz, half the rate of 74.00 samples/s");
  EXPECT_EQ(refusal({.band = Band::kBandPass, .lowHz = 1.0, .highHz = 50.0}, kRateHz).substr(0, 17),
            "band-pass: 50 Hz ");
  EXPECT_EQ(refusal({.band = Band::kBandStop, .lowHz = 6.0, .highHz = 5.0}, kRateHz),
            "band-stop: low must be below high, but 6 Hz is not below 5 Hz");
  EXPECT_EQ(refusal({.order = 9}, kRateHz), "low-pass: order must be 1..8, is 9");
  EXPECT_EQ(refusal({.order = 0}, kRateHz), "low-pass: order must be 1..8, is 0");
  EXPECT_NE(refusal({.highHz = kNan}, kRateHz), "taken");
  EXPECT_NE(refusal({.highHz = -1.0}, kRateHz), "taken");
  EXPECT_THROW(butterworthSections({}, 0.0), std::invalid_argument);
  // Live, a rate may fall below what was asked for: the edge is moved.
  EXPECT_NO_THROW(butterworthSections({.highHz = 100.0}, kRateHz));
  EXPECT_NO_THROW(
      butterworthSections({.band = Band::kBandStop, .lowHz = 90.0, .highHz = 100.0}, kRateHz));
}

TEST(Butterworth, ForgetsAnInputWithinItsLength) {
  for (const Reference& reference : kReferences) {
    const ButterworthOptions options = optionsOf(reference);
    const double length = butterworthLength(options, kRateHz);
    const auto count = static_cast<std::size_t>(length * 1.5) + 50;
    std::vector<double> pulse(count, 0.0);
    pulse[1] = 1.0;
    const auto response = butterworthFiltered(evenTimes(count), pulse, options);
    double largest = 0.0;
    for (const double value : response) largest = std::max(largest, std::abs(value));
    EXPECT_LT(std::abs(response.back()), 1e-8 * largest) << reference.order;
  }
}

// A profile of one taxel.
Profile profileOf(const std::vector<double>& values, double rateHz) {
  const auto layout =
      std::make_shared<const SensorLayout>(std::vector{MatrixLayout::full(1, 1, 3.4)});
  ProfileBuilder builder(layout);
  for (std::size_t i = 0; i < values.size(); ++i) {
    TactileFrame frame(layout);
    frame.hostUs = 1'000'000 + std::llround(static_cast<double>(i) * 1e6 / rateHz);
    frame.values[0] = static_cast<float>(values[i]);
    builder.addFrame(frame);
  }
  return builder.finish({});
}

TEST(Butterworth, FiltersAProfileInWhateverOrder) {
  std::vector<double> values;
  for (int i = 0; i < 3000; ++i) values.push_back(1000.0 + 500.0 * std::sin(0.1 * i) + i % 7);
  const Profile source = profileOf(values, 50.0);
  std::vector<double> timeS;
  for (std::size_t i = 0; i < values.size(); ++i)
    timeS.push_back(static_cast<double>(source.frameTimeUs(i) - source.frameTimeUs(0)) / 1e6);
  for (const auto& [text, zeroPhase] : {std::pair{"low-pass:cutoff=3,order=3", false},
                                        {"low-pass:cutoff=3,order=3,centred=1", true}}) {
    const Profile filtered = filteredProfile(source, parseRecipe(std::vector<std::string>{text}));
    const ButterworthOptions options{.highHz = 3.0, .order = 3};
    const auto expected = zeroPhase ? butterworthZeroPhase(timeS, values, options)
                                    : butterworthFiltered(timeS, values, options);
    for (std::size_t i = values.size(); i-- > 0;)
      ASSERT_NEAR(filtered.frame(i).values[0], expected[i], 0.01) << text << " " << i;
  }
}

TEST(Butterworth, AProfileSaysItsOwnLimit) {
  const Profile source = profileOf(std::vector<double>(100, 7.0), 50.0);
  const auto filtered = [&](const char* text) {
    return filteredProfile(source, parseRecipe(std::vector<std::string>{text}));
  };
  EXPECT_NO_THROW(filtered("low-pass:cutoff=24.9"));
  EXPECT_NO_THROW(filtered("median | (low-pass:cutoff=25)"));
  try {
    filtered("median | low-pass:cutoff=25");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "step 2: low-pass: 25 Hz is not below 25.00 Hz, half the rate of 50.00 samples/s");
  }
}

}  // namespace
}  // namespace palpate::butterworth_test
