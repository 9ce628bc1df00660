#include "palpate/filter/filter_chain.h"

#include <random>
#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::filter_chain_test {
namespace {

class Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override {
    if (fails) throw std::runtime_error("no room");
    frames.push_back(frame);
  }
  std::vector<TactileFrame> frames;
  bool fails = false;
};

std::vector<TactileFrame> randomFrames(std::size_t count,
                                       unsigned seed,
                                       std::int64_t intervalUs = 31'000) {
  std::mt19937 random(seed);
  std::vector<TactileFrame> frames(count, TactileFrame(sdh2().layout));
  std::int64_t us = 1'700'000'000'000'000;
  for (TactileFrame& frame : frames) {
    frame.hostUs = us += intervalUs;
    for (std::size_t m = 0; m < 6; ++m)
      for (int y = 0; y < frame.layout->matrix(m).rows; ++y)
        for (int x = 0; x < 6; ++x)
          if (frame.layout->matrix(m).enabled(y, x) && random() % 3 != 0)
            frame.matrix(m)(y, x) = static_cast<float>(random() % 4096);
  }
  return frames;
}

Recipe recipeOf(const std::string& text) { return parseRecipe(std::vector<std::string>{text}); }

std::vector<TactileFrame> through(const std::string& recipe, std::vector<TactileFrame> frames) {
  Collector out;
  FilterChain chain(recipeOf(recipe), out);
  for (TactileFrame& frame : frames) chain.push(frame);
  chain.finish();
  return out.frames;
}

void expectSame(const std::vector<TactileFrame>& a,
                const std::vector<TactileFrame>& b,
                const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].hostUs, b[i].hostUs) << what << " " << i;
    ASSERT_EQ(a[i].allValues(), b[i].allValues()) << what << " frame " << i;
  }
}

const char* const kCausal[] = {"box",
                               "gaussian",
                               "median",
                               "median:size=5",
                               "bilateral",
                               "nlm",
                               "opening",
                               "threshold:above=900",
                               "running-mean",
                               "temporal-gaussian",
                               "temporal-min",
                               "kalman",
                               "low-pass:order=3",
                               "band-stop",
                               "kelvin-voigt:m=1,e=400,eta=40,q=1e8,r=1",
                               "median3d",
                               "min-median",
                               "savitzky-golay",
                               "median | kalman | savitzky-golay:derivative=1"};

// The frame in which a filter fails has gone in and never comes out; those behind it keep the
// contact that is theirs.
TEST(FilterChain, AfterAFilterHasFailedEveryFrameHasItsOwnContact) {
  for (const char* text : {"box", "running-mean:window=5,centred=1"}) {
    Collector out;
    FilterChain chain(recipeOf(text), out);
    std::vector<TactileFrame> frames = randomFrames(40, 3);
    std::vector<std::vector<float>> recorded;
    for (const TactileFrame& frame : frames) recorded.push_back(frame.values);
    std::size_t failed = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      out.fails = i == 20;
      try {
        chain.push(frames[i]);
      } catch (const std::runtime_error&) {
        ++failed;
      }
    }
    out.fails = false;
    chain.finish();
    EXPECT_EQ(failed, 1u) << text;
    std::size_t wrong = 0, compared = 0;
    for (const TactileFrame& frame : out.frames) {
      const auto i = static_cast<std::size_t>((frame.hostUs - out.frames.front().hostUs) / 31'000);
      ASSERT_LT(i, recorded.size());
      for (std::size_t k = 0; k < recorded[i].size(); ++k) {
        const float expected = recorded[i][k] > 0.0F ? frame.filtered[k] : 0.0F;
        wrong += frame.values[k] == expected ? 0 : 1;
      }
      ++compared;
    }
    EXPECT_EQ(wrong, 0u) << text;
    EXPECT_GT(compared, 30u) << text;
  }
}

TEST(FilterChain, CausalFiltersNeverChangeThePast) {
  const auto frames = randomFrames(40, 1);
  for (const char* text : kCausal) {
    ASSERT_TRUE(recipeOf(text).causal()) << text;
    const auto whole = through(text, frames);
    // Whatever comes later: other frames, or none.
    auto changed = frames;
    const auto other = randomFrames(40, 2);
    for (std::size_t i = 25; i < changed.size(); ++i) changed[i].values = other[i].values;
    auto early = through(text, changed);
    early.resize(25);
    auto expected = whole;
    expected.resize(25);
    expectSame(early, expected, text);
    // And each comes out at once.
    Collector out;
    FilterChain chain(recipeOf(text), out);
    for (std::size_t i = 0; i < 10; ++i) {
      TactileFrame frame = frames[i];
      chain.push(frame);
      ASSERT_EQ(out.frames.size(), i + 1) << text;
    }
  }
}

TEST(FilterChain, StepsFollowEachOther) {
  const auto frames = randomFrames(20, 3);
  expectSame(
      through("median | kalman", frames), through("kalman", through("median", frames)), "two");
  expectSame(through("median | (kalman) | box", frames),
             through("box", through("median", frames)),
             "one is off");
  expectSame(through("(median)", frames), frames, "none is on");
  const std::string offline = "running-mean:centred=1 | rts | median3d:centred=1";
  expectSame(
      through(offline, frames),
      through("median3d:centred=1", through("rts", through("running-mean:centred=1", frames))),
      "offline");
}

TEST(FilterChain, TimeStartsAnewAfterAGap) {
  const auto first = randomFrames(20, 4);
  auto second = randomFrames(20, 5);
  for (TactileFrame& frame : second) frame.hostUs = frame.hostUs + 147'000'000;  // 147 s later
  auto both = first;
  both.insert(both.end(), second.begin(), second.end());
  for (const char* text : {"running-mean",
                           "running-mean:centred=1",
                           "temporal-min",
                           "kalman",
                           "rts",
                           "median3d",
                           "median3d:centred=1",
                           "min-median",
                           "savitzky-golay:centred=1",
                           "high-pass:order=5",
                           "band-pass:centred=1",
                           "kelvin-voigt:m=1,e=400,eta=40,q=1e8,r=1"}) {
    auto expected = through(text, first);
    const auto rest = through(text, second);
    expected.insert(expected.end(), rest.begin(), rest.end());
    expectSame(through(text, both), expected, text);
  }
}

TEST(FilterChain, TimeStartsAnewWhenAskedAndWithOtherMasks) {
  const auto first = randomFrames(10, 6);
  auto second = randomFrames(10, 7);
  for (TactileFrame& frame : second) frame.hostUs += 310'000;
  for (const bool masks : {false, true}) {
    if (masks) {
      std::vector<MatrixLayout> other = sdh2().layout->matrices();
      other[0].dynamicMask.assign(other[0].numCells(), 0);
      const auto layout = std::make_shared<const SensorLayout>(other);
      for (TactileFrame& frame : second) frame.layout = layout;
    }
    Collector out;
    FilterChain chain(recipeOf("kalman"), out);
    for (TactileFrame frame : first) chain.push(frame);
    if (!masks) chain.restart();
    for (TactileFrame frame : second) chain.push(frame);
    chain.finish();
    auto expected = through("kalman", first);
    const auto rest = through("kalman", second);
    expected.insert(expected.end(), rest.begin(), rest.end());
    expectSame(out.frames, expected, masks ? "masks" : "asked");
  }
}

TEST(FilterChain, RefusesAMatrixThatIsNotThere) {
  Collector out;
  FilterChain chain(recipeOf("median:matrices=7"), out);
  TactileFrame frame(sdh2().layout);
  EXPECT_THROW(chain.push(frame), std::invalid_argument);
  Recipe bad;
  bad.steps.push_back({.name = "median", .explicitOptions = {{"size", 4}}});
  EXPECT_THROW(FilterChain(bad, out), std::invalid_argument);
}

TEST(FilterChain, SaturatedTaxelsAreValuesLikeOthers) {
  auto frames = randomFrames(5, 8);
  for (TactileFrame& frame : frames)
    for (float& value : frame.values)
      if (value > 0.0F) value = 4095.0F;
  for (const TactileFrame& frame : through("median | gaussian", frames))
    for (const float value : frame.values) {
      EXPECT_GE(value, 0.0F);
      EXPECT_LE(value, 4095.001F);
    }
}

TEST(FilterChain, TellsWhatEachStepCosts) {
  Collector out;
  FilterChain chain(recipeOf("nlm | (box) | median"), out);
  chain.measureCosts(true);
  for (TactileFrame frame : randomFrames(50, 9)) chain.push(frame);
  const auto costs = chain.costsUs();
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_GT(costs[0], 0.0);
  EXPECT_EQ(costs[1], 0.0);
  EXPECT_GT(costs[2], 0.0);
}

TEST(FilterLatency, CountsFramesUntilHalfOfAStepIsThere) {
  const std::pair<const char*, int> cases[] = {
      {"gaussian", 0},
      {"median", 0},
      {"running-mean", 2},           // three of five
      {"running-mean:window=9", 4},  // five of nine
      {"temporal-min", 2},           // all three
      {"temporal-min:window=2", 1},
      {"min-median", 2},
      {"median:size=31 | median3d:size=3,window=201", 100},  // 101 of 201
      {"median3d", 1},                                       // two of three
      {"running-mean:centred=1", 0},                         // sees the future
      {"kalman", 2},  // 1 - 0.729844^n reaches half at n = 3, the third frame
      {"median | temporal-min | temporal-min", 4},
  };
  for (const auto& [text, frames] : cases) {
    const auto latency = latencyFrames(recipeOf(text));
    ASSERT_TRUE(latency) << text;
    EXPECT_EQ(*latency, frames) << text;
  }
  EXPECT_FALSE(latencyFrames(recipeOf("savitzky-golay:derivative=2")));
}

TEST(FilterLatency, OfAFrequencyDependsOnTheRate) {
  // scipy 1.10.1: sosfilt(butter(2, 2, fs=rate, output="sos"), ones) first is 0.5 or more at these
  // indices.
  EXPECT_EQ(latencyFrames(recipeOf("low-pass:cutoff=2"), 50.0), 6);
  EXPECT_EQ(latencyFrames(recipeOf("low-pass:cutoff=2"), 200.0), 23);
  EXPECT_EQ(latencyFrames(recipeOf("high-pass:cutoff=2"), 50.0), 0);
}

TEST(FilterMemory, IsTheSumOfTheWindows) {
  EXPECT_EQ(filterLengthFrames(recipeOf("median")), 0u);
  EXPECT_EQ(filterLengthFrames(recipeOf("median3d | running-mean")), 6u);
  EXPECT_EQ(filterLengthFrames(recipeOf("median | rts")), std::nullopt);
  EXPECT_EQ(filterLengthFrames(recipeOf("(rts)")), 0u);
  EXPECT_GE(filterLengthFrames(recipeOf("kalman")).value(), 60u);  // 0.729844^66 = 1e-9
}

}  // namespace
}  // namespace palpate::filter_chain_test
