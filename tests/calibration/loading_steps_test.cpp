#include "palpate/calibration/loading_steps.h"

#include <cmath>
#include <stdexcept>

#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::loading_steps_test {
namespace {

constexpr double kFrameS = 0.032;

// A frame every 32 ms; spans of a level one after the other.
StepSignal levels(const std::vector<std::pair<std::size_t, double>>& spans) {
  StepSignal signal;
  for (const auto& [frames, value] : spans)
    for (std::size_t i = 0; i < frames; ++i) {
      signal.timeS.push_back(kFrameS * static_cast<double>(signal.timeS.size()));
      signal.values.push_back(value);
    }
  return signal;
}

TEST(LoadingSteps, BeginWithTheLastUnloadedFrame) {
  const auto steps = findLoadingSteps(levels({{10, 0.0}, {100, 50.0}}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].begin, 9u);
  EXPECT_EQ(steps[0].end, 109u);
  EXPECT_TRUE(steps[0].beginSeen);
  EXPECT_FALSE(steps[0].released);
  EXPECT_EQ(steps[0].flickerFrames, 0u);
}

TEST(LoadingSteps, EndBeforeTheLoadIsTakenAway) {
  const auto steps = findLoadingSteps(
      levels({{5, 0.0}, {100, 50.0}, {1, 30.0}, {1, 10.0}, {50, 0.0}, {60, 20.0}}));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_TRUE(steps[0].released);
  EXPECT_LE(steps[0].end, 104u) << "the falling edge is no part of it";
  EXPECT_GE(steps[0].end, 101u);
  EXPECT_EQ(steps[1].begin, 156u);
}

TEST(LoadingSteps, AFallingLoadIsNotCutAsARelease) {
  // 8 % lower at the end, and never taken away.
  const auto steps = findLoadingSteps(levels({{5, 0.0}, {100, 50.0}, {20, 46.0}}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].end, 124u);
}

TEST(LoadingSteps, BridgeFlickerAndCountIt) {
  const auto steps = findLoadingSteps(levels({{5, 0.0}, {3, 2.0}, {2, 0.0}, {100, 40.0}}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].begin, 4u);
  EXPECT_EQ(steps[0].flickerFrames, 2u);
  LoadingStepOptions none;
  none.bridgedFrames = 0;
  const auto separate = findLoadingSteps(levels({{5, 0.0}, {3, 2.0}, {2, 0.0}, {100, 40.0}}), none);
  ASSERT_EQ(separate.size(), 1u) << "three frames are no step of their own";
  EXPECT_EQ(separate[0].begin, 9u);
}

TEST(LoadingSteps, LeaveOutWhatIsTooShort) {
  EXPECT_TRUE(findLoadingSteps(levels({{5, 0.0}, {25, 50.0}, {20, 0.0}})).empty()) << "0.8 s";
  LoadingStepOptions options;
  options.minDurationS = 0.5;
  EXPECT_EQ(findLoadingSteps(levels({{5, 0.0}, {25, 50.0}, {20, 0.0}}), options).size(), 1u);
}

TEST(LoadingSteps, SayWhereTheBeginWasNotSeen) {
  const auto steps = findLoadingSteps(levels({{100, 50.0}}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_FALSE(steps[0].beginSeen);
  EXPECT_EQ(steps[0].begin, 0u);
}

TEST(LoadingSteps, AGapEndsAStep) {
  StepSignal signal = levels({{5, 0.0}, {200, 50.0}});
  for (std::size_t i = 105; i < signal.timeS.size(); ++i) signal.timeS[i] += 20.0;
  const auto steps = findLoadingSteps(signal);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].end, 104u);
  EXPECT_EQ(steps[1].begin, 105u);
  EXPECT_FALSE(steps[1].beginSeen) << "nobody saw when the load behind the gap came";
}

TEST(LoadingSteps, TakeNumbersOnly) {
  StepSignal signal = levels({{5, 0.0}, {100, 50.0}});
  signal.values[50] = std::nan("");
  const auto steps = findLoadingSteps(signal);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].end, 104u);
  EXPECT_TRUE(findLoadingSteps({}).empty());
  signal.values.pop_back();
  EXPECT_THROW(findLoadingSteps(signal), std::invalid_argument);
}

TEST(LoadingSteps, RefuseBadOptions) {
  for (const auto spoil : {+[](LoadingStepOptions& o) { o.aboveCounts = -1.0; },
                           +[](LoadingStepOptions& o) { o.minDurationS = std::nan(""); },
                           +[](LoadingStepOptions& o) { o.minFrames = 5; },
                           +[](LoadingStepOptions& o) { o.releaseFraction = 1.1; }}) {
    LoadingStepOptions options;
    spoil(options);
    EXPECT_THROW(findLoadingSteps({}, options), std::invalid_argument);
  }
}

TEST(LoadingSteps, SignalTellsMeanSaturationAndSwitchedTaxels) {
  const auto layout = std::make_shared<SensorLayout>(
      std::vector{MatrixLayout::full(2, 2, 3.4), MatrixLayout::full(2, 3, 3.4)});
  ProfileBuilder builder(layout);
  builder.addFrame(1'000'000, std::vector<float>(10, 0.0F));
  builder.addFrame(1'032'000, std::vector<float>{9, 9, 9, 9, 4095, 0, 0, 2, 0, 0});
  builder.addFrame(1'064'000, std::vector<float>{9, 9, 9, 9, 4095, 0, 3, 0, 0, 0});
  const Profile profile = builder.finish({});
  const StepSignal signal = stepSignal(profile, 1, SignalKind::kMean);
  EXPECT_EQ(signal.values, (std::vector{0.0, 4097.0 / 2.0, 4098.0 / 2.0}));
  EXPECT_EQ(signal.saturatedTaxels, (std::vector{0, 1, 1}));
  EXPECT_EQ(signal.toggledTaxels, (std::vector{0, 2, 2}));
  EXPECT_NEAR(signal.timeS[2], 0.064, 1e-12);
  EXPECT_THROW(stepSignal(profile, 2), std::out_of_range);
}

}  // namespace
}  // namespace palpate::loading_steps_test
