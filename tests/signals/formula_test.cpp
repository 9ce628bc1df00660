#include "palpate/signals/formula.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/filter/butterworth.h"
#include "palpate/model/profile_builder.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::formula_test {
namespace {

using Names = std::vector<std::string>;

constexpr double kEver = std::numeric_limits<double>::infinity();

double one(const std::string& text, const std::vector<std::vector<double>>& values = {}) {
  return Formula(text).evaluate(std::vector{2.0}, values, kEver).at(0);
}

TEST(Formula, ComputesSampleBySample) {
  EXPECT_EQ(one("1 + 2 * 3"), 7.0);
  EXPECT_EQ(one("-(a - b) / 4", {{10.0}, {2.0}}), -2.0);
  EXPECT_EQ(one("abs(a) + sqrt(b)", {{-3.0}, {16.0}}), 7.0);
  EXPECT_EQ(one("min(a, b) * max(a, b, 5)", {{2.0}, {3.0}}), 10.0);
  EXPECT_EQ(one("a > 1 ? t : 0", {{1.5}}), 2.0);
  EXPECT_TRUE(std::isnan(one("a + 1", {{std::nan("")}})));
  EXPECT_TRUE(std::isinf(one("1 / a", {{0.0}})));
}

TEST(Formula, NamesItsSignals) {
  EXPECT_EQ(Formula("m3_mean - m1_mean + t").names(), (Names{"m1_mean", "m3_mean"}));
  EXPECT_EQ(Formula("der(a + der (b)) + under").names(), (Names{"a", "b", "under"}));
  EXPECT_EQ(Formula("42").names(), Names{});
}

TEST(Formula, PartsAtCommasOutsideOfBrackets) {
  EXPECT_EQ(splitAtCommas("a, smooth(b, 3),c"),
            (std::vector<std::string>{"a", " smooth(b, 3)", "c"}));
  EXPECT_EQ(splitAtCommas(""), std::vector<std::string>{""});
}

// numpy 1.24: numpy.gradient([1, 4, 9, 7, 7.5], [0, 1, 1.5, 3, 3.2]).
TEST(Formula, DerivativesAreNumPys) {
  const std::vector<double> timeS = {0.0, 1.0, 1.5, 3.0, 3.2};
  const std::vector<double> values = {1.0, 4.0, 9.0, 7.0, 7.5};
  const auto slopes = derivativeOf(timeS, values, kEver);
  const std::vector<double> expected = {3, 7.66666666667, 7.16666666667, 2.04901960784, 2.5};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(slopes[i], expected[i], 1e-9) << i;
  EXPECT_EQ(Formula("der(a)").evaluate(timeS, {values}, kEver), slopes);
  const auto twice = Formula("2 * der(a + 1) - t").evaluate(timeS, {values}, kEver);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(twice[i], 2.0 * expected[i] - timeS[i], 1e-9) << i;
  // A gap parts them.
  const auto parted = derivativeOf(timeS, values, 1.2);
  EXPECT_NEAR(parted[2], (9.0 - 4.0) / 0.5, 1e-12);
  EXPECT_NEAR(parted[3], (7.5 - 7.0) / 0.2, 1e-12);
  EXPECT_TRUE(std::isnan(derivativeOf(std::vector{1.0}, std::vector{1.0}, kEver)[0]));
}

// By hand: means and medians of up to three neighbours.
TEST(Formula, SmoothsOverSamplesButNotOverGaps) {
  const std::vector<double> timeS = {0, 1, 2, 3, 4, 10, 11};
  const std::vector<double> values = {3, 9, 0, 6, 3, 100, 200};
  const auto of = [&](const char* text) { return Formula(text).evaluate(timeS, {values}, 2.0); };
  EXPECT_EQ(of("smooth(a, 3)"), (std::vector<double>{6, 4, 5, 3, 4.5, 150, 150}));
  EXPECT_EQ(of("median(a, 3)"), (std::vector<double>{6, 3, 6, 3, 4.5, 150, 150}));
  EXPECT_EQ(of("smooth(a,1)"), values);
  EXPECT_EQ(of("median( 2 * a , 3 ) + 1"), (std::vector<double>{13, 7, 13, 7, 10, 301, 301}));
}

TEST(Formula, MeansGoOnBehindAnOverflow) {
  constexpr double kMax = std::numeric_limits<double>::max();
  const std::vector<double> timeS = {0, 1, 2, 3, 4, 5, 6};
  const std::vector<double> values = {1, kMax, kMax, 0, 3, 6, 9};
  const auto means = Formula("smooth(a, 3)").evaluate(timeS, {values}, kEver);
  EXPECT_FALSE(std::isfinite(means[1]));
  EXPECT_EQ(means[3], kMax / 3.0);
  EXPECT_EQ(means[4], 3.0);
  EXPECT_EQ(means[6], 7.5);
}

// The filter itself is checked against SciPy in butterworth_test: here that it is the one meant.
TEST(Formula, FiltersAreButterworthsWithoutDelay) {
  std::vector<double> timeS, values, slow;
  for (int i = 0; i < 400; ++i) {
    timeS.push_back(0.01 * i);
    slow.push_back(std::sin(2.0 * M_PI * 1.0 * timeS.back()));
    values.push_back(slow.back() + std::sin(2.0 * M_PI * 30.0 * timeS.back()));
  }
  const auto low = Formula("lowpass(a, 5)").evaluate(timeS, {values}, kEver);
  EXPECT_EQ(low, butterworthZeroPhase(timeS, values, {.highHz = 5.0}));
  const auto high = Formula("a - highpass(a, 5)").evaluate(timeS, {values}, kEver);
  EXPECT_EQ(Formula("bandpass(a, 0.3, 5)").evaluate(timeS, {values}, kEver),
            butterworthZeroPhase(
                timeS,
                values,
                {.band = ButterworthOptions::Band::kBandPass, .lowHz = 0.3, .highHz = 5.0}));
  EXPECT_EQ(Formula("bandstop(a, 25, 35)").evaluate(timeS, {values}, kEver),
            butterworthZeroPhase(
                timeS,
                values,
                {.band = ButterworthOptions::Band::kBandStop, .lowHz = 25.0, .highHz = 35.0}));
  for (std::size_t i = 100; i < 300; ++i) {
    EXPECT_NEAR(low[i], slow[i], 0.03) << i;
    EXPECT_NEAR(high[i], slow[i], 0.03) << i;
  }
  EXPECT_THROW((void)Formula("lowpass(a, 60)").evaluate(timeS, {values}, kEver),
               std::invalid_argument)
      << "half of the rate is 50 Hz";
}

TEST(Formula, KnowsOnHowManyNeighboursItDepends) {
  EXPECT_EQ(Formula("a + b").reach(50.0), 0u);
  EXPECT_EQ(Formula("der(a)").reach(50.0), 1u);
  EXPECT_EQ(Formula("der(smooth(a, 9))").reach(50.0), 6u);
  EXPECT_GT(Formula("lowpass(a, 1)").reach(50.0), 50u);
  // core F4: half of the windows, however long they are.
  EXPECT_EQ(Formula("smooth(a, 100001)").reach(50.0), 50'001u);
  EXPECT_EQ(Formula("median(smooth(a, 50001), 50001)").reach(50.0), 50'002u);
}

// core F5: against means and medians of each window by themselves.
TEST(Formula, AMovingWindowHoldsTheValuesAroundEachSample) {
  constexpr std::size_t kSamples = 500;
  constexpr int kHalf = 10;
  std::vector<double> timeS, values;
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < kSamples; ++i) {
    state = state * 1'664'525U + 1'013'904'223U;
    timeS.push_back(static_cast<double>(i) + (i >= 200 ? 100.0 : 0.0));
    values.push_back(state >> 29U == 0 ? std::nan("") : static_cast<double>(state >> 24U) / 3.0);
  }
  const auto means = Formula("smooth(a, 21)").evaluate(timeS, {values}, 50.0);
  const auto medians = Formula("median(a, 21)").evaluate(timeS, {values}, 50.0);
  for (int i = 0; i < static_cast<int>(kSamples); ++i) {
    const int begin = std::max(i >= 200 ? 200 : 0, i - kHalf);
    const int end = std::min(i < 200 ? 200 : static_cast<int>(kSamples), i + kHalf + 1);
    std::vector<double> here;
    for (int k = begin; k < end; ++k)
      if (std::isfinite(values[static_cast<std::size_t>(k)]))
        here.push_back(values[static_cast<std::size_t>(k)]);
    std::sort(here.begin(), here.end());
    const std::size_t n = here.size();
    const auto at = static_cast<std::size_t>(i);
    EXPECT_NEAR(
        means[at], std::accumulate(here.begin(), here.end(), 0.0) / static_cast<double>(n), 1e-12);
    EXPECT_EQ(medians[at], (here[(n - 1) / 2] + here[n / 2]) / 2.0) << i;
  }
}

// core F5: sorting each window anew would take an hour.
TEST(Formula, LongWindowsAreComputedInShortTime) {
  std::vector<double> timeS, values;
  for (int i = 0; i < 100'000; ++i) {
    timeS.push_back(i);
    values.push_back(i * 7919 % 10'007);
  }
  const auto medians = Formula("median(a, 50001)").evaluate(timeS, {values}, kEver);
  EXPECT_NEAR(medians[50'000], 5003.0, 5.0);
  // The mean of a straight line is its middle, whatever has left the window.
  const auto means = Formula("smooth(t / 3, 50001)").evaluate(timeS, {}, kEver);
  EXPECT_DOUBLE_EQ(means[60'000], 20'000.0);
}

TEST(Formula, IsCancelled) {
  const std::vector<double> timeS = {0.0, 1.0, 2.0};
  const std::vector<double> values = {1.0, 2.0, 3.0};
  for (const char* text : {"a + 1", "median(a, 3)", "smooth(smooth(a, 3), 3)"}) {
    std::vector<double> reported;
    (void)Formula(text).evaluate(timeS, {values}, kEver, [&](double fraction) {
      reported.push_back(fraction);
      return true;
    });
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end())) << text;
    EXPECT_THROW((void)Formula(text).evaluate(timeS, {values}, kEver, [](double) { return false; }),
                 Cancelled)
        << text;
  }
}

TEST(Formula, NamesAFunctionThatIsNone) {
  const auto refusal = [](const std::string& text) {
    try {
      (void)Formula(text);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("notch(a, 2, 3)")
                .find("there is no function notch; functions of signals are der, smooth, median, "
                      "lowpass, highpass, bandpass, bandstop"),
            std::string::npos)
      << refusal("notch(a, 2, 3)");
  EXPECT_NE(refusal("1 + der(foo (a))").find("no function foo"), std::string::npos);
  EXPECT_EQ(refusal("2 * (a + 1) + sqrt(a)"), "");
}

TEST(Formula, RefusesWhatIsNone) {
  const auto refusal = [](const std::string& text) {
    try {
      Formula made(text);
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return std::string(error.what());
    }
    return "taken: " + text;
  };
  for (const char* text :
       {"", "1 +", "a b", "(a", "a)", "sqrt()", "foo(a)", "a $ b", "der(", "\"a\""})
    EXPECT_EQ(refusal(text).rfind("formula \"", 0), 0u) << refusal(text);
  EXPECT_NE(refusal("a = 3").find("=="), std::string::npos);
  EXPECT_NE(refusal("a, b").find("comma"), std::string::npos);
  EXPECT_NE(refusal("der(a").find("isn't closed"), std::string::npos);
  EXPECT_NE(refusal(std::string(1001, '1')).find("at most 1000"), std::string::npos);
  for (const std::string& text : {std::string(990, 'a') + " b",
                                  std::string(990, 'a') + "(1)",
                                  "lowpass(a," + std::string(980, 'b') + ")"})
    EXPECT_LT(refusal(text).size(), 500u) << refusal(text);
  EXPECT_NE(refusal("a == 3"), "");
  EXPECT_EQ(refusal("a >= 3"), "taken: a >= 3");
  EXPECT_THROW(Formula("a").evaluate(std::vector{1.0}, {}, kEver), std::invalid_argument);
  EXPECT_THROW(Formula("a").evaluate(std::vector{1.0}, {{}}, kEver), std::invalid_argument);
}

TEST(DerivedSeries, AreComputedAtTheFrames) {
  const Profile profile = synthesize({.durationS = 6.0, .grasps = 2});
  const Series sum = readSeries(
      profile, {.index = profile.layout().numMatrices(), .signal = SignalKind::kSum}, 0.0, 6.0);
  const Series derived = formulaSeries(profile, Formula("2 * hand_sum - 1"), 0.0, 6.0);
  ASSERT_EQ(derived.timeS.size(), sum.timeS.size());
  for (std::size_t i = 0; i < sum.values.size(); ++i) {
    EXPECT_NEAR(derived.timeS[i], sum.timeS[i], 1e-9);
    EXPECT_EQ(derived.values[i], 2.0 * sum.values[i] - 1.0);
  }
  // An angle is interpolated between its samples.
  const Series angle = formulaSeries(profile, Formula("angle1 + 0 * m1_mean"), 1.0, 2.0);
  const Series recorded =
      readSeries(profile, {.kind = SeriesChoice::Kind::kAngle, .index = 1}, 0.0, 6.0);
  const auto [low, high] = std::minmax_element(recorded.values.begin(), recorded.values.end());
  EXPECT_GT(angle.values.size(), 10u);
  for (const double value : angle.values) {
    EXPECT_GE(value, *low);
    EXPECT_LE(value, *high);
  }
  EXPECT_EQ(formulaSeries(profile, Formula("t"), 0.0, 6.0).values, derived.timeS);
}

// Frames of a real hand are not evenly spaced, so the mean rate of a part is another one.
TEST(DerivedSeries, ValuesDoNotDependOnTheSpan) {
  const Profile even = synthesize({.durationS = 40.0, .grasps = 4});
  ProfileBuilder builder(even.hand());
  std::int64_t hostUs = even.frameTimeUs(0);
  for (std::size_t i = 0; i < even.numFrames(); ++i) {
    TactileFrame frame = even.frame(i);
    frame.hostUs = hostUs;
    hostUs += 28'000 + static_cast<std::int64_t>(i * 7919 % 6000 + i);
    builder.addFrame(frame);
  }
  const Profile profile = builder.finish({});
  for (const char* text : {"bandpass(hand_mean, 1, 5)",
                           "der(lowpass(hand_sum, 4))",
                           "smooth(hand_sum, 9)",
                           "der(hand_max)"}) {
    const Series whole = formulaSeries(profile, Formula(text), 0.0, 40.0);
    const Series part = formulaSeries(profile, Formula(text), 12.0, 21.0);
    const auto at = static_cast<std::size_t>(
        std::lower_bound(whole.timeS.begin(), whole.timeS.end(), 12.0) - whole.timeS.begin());
    ASSERT_GT(part.values.size(), 100u);
    for (std::size_t i = 0; i < part.values.size(); ++i)
      ASSERT_EQ(part.values[i], whole.values[at + i]) << text << " at " << part.timeS[i];
  }
}

// core F4
TEST(DerivedSeries, LongWindowsDoNotDependOnTheSpan) {
  constexpr int kFrames = 60'000;
  HandDescription hand;
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(hand);
  for (int i = 0; i < kFrames; ++i)
    builder.addFrame(std::int64_t{i} * 10'000,
                     std::vector<float>{static_cast<float>(i < kFrames / 2 ? 1 : 101)});
  const Profile profile = builder.finish({});
  for (const char* text : {"smooth(m0_sum, 50001)", "median(m0_sum, 50001)"}) {
    const Series whole = formulaSeries(profile, Formula(text), 0.0, 600.0);
    const Series part = formulaSeries(profile, Formula(text), 50.0, 51.0);
    ASSERT_EQ(part.values.size(), 101u);
    for (std::size_t i = 0; i < part.values.size(); ++i)
      ASSERT_EQ(part.values[i], whole.values[5000 + i]) << text << " at " << part.timeS[i];
  }
  // By hand: frame 5000 has 5000 + 1 + 25,000 neighbours, of which one is 101.
  EXPECT_DOUBLE_EQ(
      formulaSeries(profile, Formula("smooth(m0_sum, 50001)"), 50.0, 50.0).values.at(0),
      (30'000.0 + 101.0) / 30'001.0);
}

TEST(DerivedSeries, RefusesWhatTheHandLacks) {
  const Profile profile = synthesize({.durationS = 1.0, .grasps = 1});
  for (const char* text : {"m9_mean", "angle77", "thumb"})
    EXPECT_THROW(formulaSeries(profile, Formula(text), 0.0, 1.0), std::invalid_argument) << text;
}

TEST(DerivedSeries, HasNoValueWhereASignalCannotBeRead) {
  const Profile whole = synthesize({.durationS = 20.0, .grasps = 2, .noiseCounts = 5.0});
  const Profile damaged = testing::withDamage(whole, 200, 279);
  const Formula formula("hand_sum + 2 * m1_max");
  EXPECT_THROW(formulaSeries(damaged, formula, 0.0, 20.0), FormatError);
  UnreadableSamples unreadable;
  const Series series = formulaSeries(damaged, formula, 0.0, 20.0, {}, &unreadable);
  EXPECT_EQ(unreadable.count, 80u);
  EXPECT_EQ(unreadable.runs, (std::vector<UnreadableSamples::Run>{{200, 279}}));
  const Series expected = formulaSeries(whole, formula, 0.0, 20.0);
  ASSERT_EQ(series.values.size(), expected.values.size());
  for (std::size_t i = 0; i < series.values.size(); ++i)
    if (i >= 200 && i <= 279) {
      EXPECT_TRUE(std::isnan(series.values[i])) << i;
    } else {
      EXPECT_EQ(series.values[i], expected.values[i]) << i;
    }
}

TEST(DerivedSeries, TakeTheLastSampleOfAFurtherSeries) {
  const Profile profile = testing::withWrist(synthesize({.durationS = 2.0, .grasps = 1}));
  const Formula formula("wrist_fz - m0_sum");
  EXPECT_EQ(formula.names(), (std::vector<std::string>{"m0_sum", "wrist_fz"}));
  const Series derived = formulaSeries(profile, formula, 0.0, 2.0);
  const Series sum = readSeries(profile, {.index = 0, .signal = SignalKind::kSum}, 0.0, 2.0);
  ASSERT_EQ(derived.timeS, sum.timeS);
  for (std::size_t i = 0; i < derived.values.size(); ++i) {
    const std::int64_t sinceUs = profile.frameTimeUs(i) - profile.frameTimeUs(0) - 30'000;
    const std::int64_t last = std::min<std::int64_t>(sinceUs / 50'000, 39);
    if (sinceUs < 0 || last % 10 == 3)
      EXPECT_TRUE(std::isnan(derived.values[i])) << i;
    else
      EXPECT_EQ(derived.values[i], -2.0 * static_cast<double>(last) - sum.values[i]) << i;
  }
  // A part is as that part of the whole, also before the first sample.
  const Series part = formulaSeries(profile, Formula("wrist_fx"), 0.0, 0.01);
  EXPECT_TRUE(std::isnan(part.values.at(0)));
}

TEST(DerivedSeries, SayWhichFurtherSeriesThereAre) {
  const Profile profile = testing::withWrist(synthesize({.durationS = 1.0, .grasps = 1}));
  try {
    formulaSeries(profile, Formula("wrist_f"), 0.0, 1.0);
    FAIL() << "taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("temperature0, wrist_fx, t"), std::string::npos)
        << error.what();
  }
}

TEST(Formula, ASeriesMayBeCalledAsAnyFunction) {
  const std::vector<double> timeS = {0.0, 1.0, 2.0};
  for (const char* name : {"derivative_0", "der_x", "smooth_t", "sum_fx"})
    EXPECT_EQ(Formula(std::string("der(") + name + ") + " + name)
                  .evaluate(timeS, {{0.0, 1.0, 2.0}}, 10.0),
              (std::vector{1.0, 2.0, 3.0}))
        << name;
}

}  // namespace
}  // namespace palpate::formula_test
