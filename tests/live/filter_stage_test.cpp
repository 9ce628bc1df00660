#include "palpate/live/filter_stage.h"

#include <stdexcept>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/live/processing_chain.h"
#include "palpate/live/signals_stage.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::filter_stage_test {
namespace {

Recipe recipeOf(const std::string& text) { return parseRecipe(std::vector<std::string>{text}); }
Profile grasps() { return synthesize({.durationS = 6.0, .grasps = 2, .noiseCounts = 12.0}); }

struct Found {
  TactileFrame frame;
  bool hasUnfiltered = false;
  double wholeSum = 0.0;
};

std::vector<Found> processed(const Profile& profile,
                             const std::string& recipe,
                             std::vector<Event> events = {}) {
  auto stage = std::make_unique<FilterStage>();
  stage->setRecipe(recipeOf(recipe));
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::move(stage));
  stages.push_back(std::make_unique<SignalsStage>());
  std::vector<Found> found;
  ChainOptions options;
  options.onResults = [&](const LiveResults& results) {
    found.push_back({*results.frame, results.unfiltered != nullptr, results.wholeSignals.sum});
  };
  ProcessingChain(std::move(stages), options).runOver(profile, std::move(events));
  return found;
}

TEST(FilterStage, GivesWhatTheRecordingGivesBitByBit) {
  const Profile profile = grasps();
  for (const char* text :
       {"median", "kalman | gaussian", "min-median:masked=1", "savitzky-golay:window=7"}) {
    const Profile expected = filteredProfile(profile, recipeOf(text));
    const auto found = processed(profile, text);
    ASSERT_EQ(found.size(), profile.numFrames());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].frame.values, expected.frame(i).values) << text << " " << i;
      ASSERT_EQ(found[i].frame.hostUs, profile.frameTimeUs(i));
      ASSERT_TRUE(found[i].hasUnfiltered);
      // Later stages receive the filtered frame.
      ASSERT_EQ(found[i].wholeSum, wholeFrameSignals(expected.frame(i)).sum);
    }
  }
}

TEST(FilterStage, OtherSettingsRestartItLiveAndOffline) {
  const Profile profile = grasps();
  const std::int64_t us = profile.frameTimeUs(70) - 500;
  const auto found =
      processed(profile, "kalman", {{us, us, "settings", std::nullopt, "threshold 50", ""}});
  const Profile expected = filteredProfile(profile, recipeOf("kalman"), {{us}});
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_EQ(found[i].frame.values, expected.frame(i).values) << i;
}

TEST(FilterStage, WhatNeedsLaterFramesIsLeftOut) {
  const Profile profile = grasps();
  const auto found = processed(profile, "rts | median | median3d:centred=1");
  const Profile expected = filteredProfile(profile, recipeOf("median"));
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_EQ(found[i].frame.values, expected.frame(i).values) << i;
  for (const Found& one : processed(profile, "rts")) EXPECT_FALSE(one.hasUnfiltered);
}

TEST(FilterStage, ARecipeMayChangeOnTheWay) {
  const Profile profile = grasps();
  FilterStage stage;
  std::vector<Event> events;
  const auto at = [&](std::size_t i) {
    LiveResults results;
    results.frame = std::make_shared<const TactileFrame>(profile.frame(i));
    stage.onFrame(results, events);
    return results;
  };
  EXPECT_EQ(at(40).unfiltered, nullptr);
  stage.setRecipe(recipeOf("median | box"));
  const LiveResults filtered = at(41);
  EXPECT_NE(filtered.frame->values, profile.frame(41).values);
  EXPECT_EQ(filtered.unfiltered->values, profile.frame(41).values);
  ASSERT_EQ(stage.costsUs().size(), 2u);
  EXPECT_GT(stage.costsUs()[0], 0.0);
  stage.setRecipe({});
  EXPECT_EQ(at(42).frame->values, profile.frame(42).values);
  EXPECT_TRUE(stage.costsUs().empty());
  Recipe bad;
  bad.steps.push_back({.name = "median", .explicitOptions = {{"size", 4}}});
  EXPECT_THROW(stage.setRecipe(bad), std::invalid_argument);
}

TEST(FilterStage, AMatrixThatIsNotThereIsLeftOut) {
  const SensorLayout pad({MatrixLayout::full(4, 4, 2.0)});
  const Recipe live = livePart(recipeOf("median:matrices=3 | box"), pad);
  EXPECT_FALSE(live.steps[0].enabled);
  EXPECT_TRUE(live.steps[1].enabled);
}

TEST(FilterStage, ABaselineThatWasTakenOfAnotherHandIsLeftOut) {
  const SensorLayout pad({MatrixLayout::full(1, 2, 2.0)});
  const Recipe live = livePart(recipeOf("baseline | baseline:rest=1/2/3 | baseline:rest=1/2"), pad);
  EXPECT_FALSE(live.steps[0].enabled) << "nothing was taken";
  EXPECT_FALSE(live.steps[1].enabled);
  EXPECT_TRUE(live.steps[2].enabled);
}

}  // namespace
}  // namespace palpate::filter_stage_test
