// What is said of a slip, of made-up truths and findings; and of what a model names.
#include "commands/demo_truth.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/emulator/scene.h"
#include "palpate/emulator/simulated_recording.h"
#include "palpate/recording/dsa_writer.h"

#include "testing/testing.h"

namespace palpate::commands::demo_truth_test {
namespace {
namespace fs = std::filesystem;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;
constexpr std::int64_t kFrameUs = 30'000;

std::int64_t timeUs(std::size_t frame) {
  return kStartUs + static_cast<std::int64_t>(frame) * kFrameUs;
}

// Held by matrices 1 and 5 from frame 20 on; between frames 100 and 140 it moves 0.1 taxel a frame
// over matrix 1, half of that over matrix 5; let go in frame 200.
std::vector<DemoTruthFrame> pulledTruth(double stepTaxels = 0.1) {
  std::vector<DemoTruthFrame> truth;
  for (std::size_t i = 0; i < 220; ++i) {
    DemoTruthFrame frame{timeUs(i), static_cast<double>(i) * 0.03, std::vector<MatrixTruth>(6)};
    const double steps = std::clamp(static_cast<double>(i) - 100.0, 0.0, 40.0);
    if (i >= 20 && i < 200) {
      // It had moved before, while the fingers closed.
      frame.matrices[1] = {
          .contact = true, .forceN = 8.0, .slipXTaxels = 0.7, .slipYTaxels = -steps * stepTaxels};
      frame.matrices[5] = {
          .contact = true, .forceN = 8.0, .slipYTaxels = -steps * stepTaxels / 2.0};
    }
    truth.push_back(frame);
  }
  return truth;
}

SlipSegment alarmOf(std::size_t matrix, std::size_t begin, std::size_t end) {
  return {
      .begin = begin, .end = end, .beginUs = timeUs(begin), .endUs = timeUs(end), .matrix = matrix};
}

// Samples of matrix 1 whose imprint is 0.02 taxel further in each frame behind the 100th.
SlipSeries seriesWith(std::vector<SlipSegment> slips) {
  SlipSeries series;
  series.firstUs = kStartUs;
  series.matrices.resize(6);
  for (std::size_t i = 0; i < 220; ++i) {
    series.timeS.push_back(static_cast<double>(i) * 0.03);
    SlipSample sample;
    sample.frame = static_cast<std::uint32_t>(i);
    sample.refValid = true;
    sample.refDy = static_cast<float>(0.02 * std::max(0.0, static_cast<double>(i) - 100.0));
    sample.indicator = SlipIndicator::kSlipping;
    sample.state = SlipState::kSlip;
    if (i >= 20) series.matrices[1].push_back(sample);
  }
  series.slips = std::move(slips);
  return series;
}

DemoFinding compared(const std::vector<DemoTruthFrame>& truth,
                     double fromS = 2.0,
                     double untilS = 5.5,
                     std::vector<SlipSegment> slips = {}) {
  return compareSlip(seriesWith(std::move(slips)), *defaultHand().layout, truth, fromS, untilS);
}

void expectParts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
}

TEST(DemoTruth, TellsWhenAHeldObjectBeganToMoveAndHowFarItWent) {
  const DemoFinding slip = compared(pulledTruth());
  const Json truth = slip.json.at("truth");
  EXPECT_EQ(truth.at("matrix").asInteger(), 1);
  EXPECT_NEAR(truth.at("moved_taxels").asDouble(), 4.0, 1e-9);
  EXPECT_NEAR(truth.at("moved_mm").asDouble(), 13.6, 1e-6);
  EXPECT_NEAR(truth.at("began_ms").asDouble(), static_cast<double>(timeUs(101)) * 1e-3, 31.0);
  EXPECT_NEAR(truth.at("ended_ms").asDouble(), static_cast<double>(timeUs(139)) * 1e-3, 31.0);
  EXPECT_FALSE(slip.json.at("seen").asBool());
  EXPECT_FALSE(slip.json.contains("alarm"));
  expectParts(slip.text, {"4.0 taxels (13.6 mm)", "no alarm was raised"});
}

TEST(DemoTruth, KnowsNoMotionOfWhatStayedOrWasNotHeld) {
  EXPECT_THROW(compared(pulledTruth(0.02)), Error) << "less than a taxel";
  EXPECT_THROW(compared(pulledTruth(), 0.1), Error) << "not held at the begin";
  EXPECT_THROW(compared(pulledTruth(), 2.0, 2.5), Error) << "before it moved";
  EXPECT_THROW(compared({}), Error);
}

TEST(DemoTruth, TheFirstAlarmOfTheMotionCounts) {
  // One while the fingers close, one too early, two of the motion, one when it is let go.
  const DemoFinding slip = compared(pulledTruth(),
                                    2.0,
                                    5.5,
                                    {alarmOf(5, 22, 30),
                                     alarmOf(1, 80, 82),
                                     alarmOf(1, 105, 150),
                                     alarmOf(5, 108, 140),
                                     alarmOf(1, 200, 205)});
  EXPECT_TRUE(slip.json.at("seen").asBool());
  EXPECT_EQ(slip.json.at("false_alarms_before").asInteger(), 1);
  const Json alarm = slip.json.at("alarm");
  EXPECT_EQ(alarm.at("matrix").asInteger(), 1);
  EXPECT_EQ(alarm.at("frame").asInteger(), 105);
  EXPECT_NEAR(alarm.at("after_s").asDouble(), 4.0 * 0.03, 0.031);
  EXPECT_NEAR(alarm.at("moved_taxels").asDouble(), 0.5, 1e-9);
  EXPECT_NEAR(alarm.at("imprint_taxels").asDouble(), 1.0, 1e-6);
  EXPECT_EQ(alarm.at("lamp").asString(), "slipping");
  expectParts(slip.text,
              {"matrix 1", "'slipping'", "frame 105", "it went 1.0", "1 false alarm before"});
}

TEST(DemoTruth, AnAlarmAfterTheMotionIsNoneOfIt) {
  EXPECT_FALSE(compared(pulledTruth(), 2.0, 5.5, {alarmOf(1, 200, 205)}).json.at("seen").asBool());
}

// Friction of 0.35 holds the pen until the pull, less its weight, is more than what both pads
// press; then it slips upwards, and stays in the fingers when the pull ends.
TEST(SlippingPen, SlipsWhenFrictionHoldsItNoLongerAndIsCaught) {
  const Scene scene = loadScene("slipping_pen", testing::dataFolder() / "scenes");
  // The steps of its script that the tour takes its times from.
  ASSERT_EQ(scene.script.size(), 4u);
  ASSERT_TRUE(std::holds_alternative<LoadObject>(scene.script[1].action));
  ASSERT_TRUE(std::holds_alternative<ReleaseAction>(scene.script[3].action));
  const double pullS = scene.script[1].atS, releaseS = scene.script[3].atS;
  PhysicalHand hand(scene);
  std::vector<std::uint16_t> counts(hand.hand().layout->numCells());
  const auto truthAt = [&](double timeS) {
    hand.advanceTo(timeS);
    hand.scan(counts);
    return hand.truth();
  };
  const auto held = truthAt(pullS - 0.5);
  ASSERT_TRUE(held[1].contact && held[5].contact);
  const auto rested = truthAt(pullS);
  EXPECT_NEAR(rested[1].slipYTaxels, held[1].slipYTaxels, 0.01) << "at rest";
  const double frictionLimitN = 0.35 * (rested[1].forceN + rested[5].forceN);
  const double weightN = 0.02 * 9.81, pullNPerS = 20.0 / 2.0;
  const double slipsS = pullS + (frictionLimitN + weightN) / pullNPerS;
  ASSERT_LT(slipsS, pullS + 2.0) << "the pull is strong enough";
  EXPECT_NEAR(truthAt(slipsS - 0.15)[1].slipYTaxels, rested[1].slipYTaxels, 0.1);
  EXPECT_LT(truthAt(slipsS + 0.4)[1].slipYTaxels, rested[1].slipYTaxels - 0.1) << "upwards";
  const auto caught = truthAt(releaseS - 0.4), last = truthAt(releaseS - 0.01);
  EXPECT_TRUE(last[1].contact && last[5].contact);
  EXPECT_LT(last[1].slipYTaxels, rested[1].slipYTaxels - 2.0);
  EXPECT_NEAR(last[1].slipYTaxels, caught[1].slipYTaxels, 0.05) << "it slips no longer";
}

class DemoRecognitionTest : public ::testing::Test {
 protected:
  // A grasp of a scene; `sizeMm` of its object, where it is to be another.
  KnownGrasp recorded(const std::string& scene, const std::string& object, double sizeMm = 0.0) {
    Scene played = loadScene(scene, testing::dataFolder() / "scenes");
    if (sizeMm > 0.0) played = parseScene(sphereOf(sizeMm), "sphere.json");
    const fs::path file = folder_ / (scene + std::to_string(++count_) + ".dsa");
    writeDsa(simulateRecording(played), file);
    return {file, object};
  }
  static std::string sphereOf(double sizeMm) {
    return R"({"objects": [{"shape": "sphere", "size_mm": )" + std::to_string(sizeMm) +
           R"(, "stiffness_n_per_mm3": 10, "friction": 0.7, "pose": {"position_mm": [0, 0, 145]}}],
               "hand": {"preshape": "centrical"},
               "script": [{"at_s": 1.5, "grasp": {}}, {"at_s": 9, "release": {}}]})";
  }

  const testing::TemporaryFolder folder_;
  const TrainedModel model_ = loadModel(testing::dataFolder() / "emulated_objects.json");
  int count_ = 0;
};

TEST_F(DemoRecognitionTest, NamesWhatItWasTaughtAndCallsOtherThingsUnknown) {
  const DemoFinding asked = askModel(
      model_, {recorded("pen", "pen"), recorded("ball", "ball"), recorded("ball", "marble", 45.0)});
  const Json grasps = asked.json.at("grasps");
  ASSERT_EQ(grasps.size(), 3u);
  EXPECT_EQ(grasps.at(0).at("label").asString(), "pen");
  EXPECT_EQ(grasps.at(1).at("label").asString(), "ball");
  EXPECT_EQ(grasps.at(1).at("rank").asInteger(), 1);
  EXPECT_GT(grasps.at(1).at("probability").asDouble(), 0.97);
  EXPECT_FALSE(grasps.at(2).at("taught").asBool());
  EXPECT_TRUE(grasps.at(2).at("rank").isNull());
  EXPECT_EQ(grasps.at(2).at("label").asString(), "unknown");
  EXPECT_TRUE(grasps.at(2).at("right").asBool());
  EXPECT_EQ(asked.json.at("taught").asInteger(), 2);
  EXPECT_EQ(asked.json.at("right").asInteger(), 2);
  expectParts(asked.text, {"2 of 2", "the marble, which was not trained, is called unknown"});
  EXPECT_EQ(asked.text.find("wrong"), std::string::npos) << asked.text;
}

TEST_F(DemoRecognitionTest, SaysWhatIsWrong) {
  // The ball was exchanged, the pen called a bottle by whoever recorded it, and of the box nothing
  // was grasped.
  const std::vector<KnownGrasp> known = {recorded("ball", "ball", 45.0),
                                         recorded("pen", "bottle"),
                                         recorded("empty", "box"),
                                         recorded("pen", "marble")};
  const DemoFinding asked = askModel(model_, known);
  expectParts(asked.text,
              {"0 of 3",
               "wrong: the ball is called unknown; its own name is at rank",
               "wrong: the bottle is called pen; its own name is at rank",
               "wrong: the box could not be asked about: ",
               "wrong: the marble is called pen"});
  EXPECT_EQ(asked.text.find("surely"), std::string::npos) << asked.text;
  EXPECT_EQ(asked.json.at("right").asInteger(), 0);
  EXPECT_EQ(asked.json.at("taught").asInteger(), 3);
  const Json grasps = asked.json.at("grasps");
  ASSERT_EQ(grasps.size(), 4u);
  const Json bottle = grasps.at(1);
  EXPECT_EQ(bottle.at("file").asString(), known[1].file.filename().string());
  EXPECT_EQ(bottle.at("label").asString(), "pen");
  EXPECT_EQ(bottle.at("object").asString(), "bottle");
  EXPECT_GT(bottle.at("rank").asInteger(), 1);
  EXPECT_LT(bottle.at("probability").asDouble(), 0.05);
  EXPECT_FALSE(bottle.at("right").asBool());
  EXPECT_FALSE(grasps.at(2).at("trouble").asString().empty());
  EXPECT_TRUE(grasps.at(2).at("label").isNull());
  EXPECT_FALSE(grasps.at(3).at("right").asBool());
}

}  // namespace
}  // namespace palpate::commands::demo_truth_test
