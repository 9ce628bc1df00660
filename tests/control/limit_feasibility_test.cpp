#include "palpate/control/limit_feasibility.h"

#include "palpate/control/tactile_settings.h"
#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::limit_feasibility_test {
namespace {

std::vector<std::string> namesOf(const std::vector<UnmeasurableLimit>& unfelt) {
  std::vector<std::string> names;
  for (const UnmeasurableLimit& each : unfelt) names.push_back(sdh2().matrixName(each.matrix));
  return names;
}

TEST(FeltLimit, AsItIsAtPowerUpEveryLimitOfAGraspIsFelt) {
  const TactileSettings usual = defaultTactileSettings(sdh2());
  for (const int limit : {3, 200, 2200, 3300})
    EXPECT_TRUE(unmeasurableLimits(sdh2(), usual, limit).empty());
  EXPECT_TRUE(unmeasurableLimits(sdh2(), {}, 3300).empty()) << "not known: not made up";
}

// Readings are sent minus the threshold (protocol, 1.5.4): 200 counts above a threshold of 300 can
// be measured.
TEST(FeltLimit, AThresholdAboveTheLimitHidesLightTouchesNotTheLimit) {
  TactileSettings settings = defaultTactileSettings(sdh2());
  settings[3].thresholdCounts = 1000;
  EXPECT_TRUE(unmeasurableLimits(sdh2(), settings, 200).empty());
}

TEST(FeltLimit, AThresholdThatLeavesTooLittleIsNamed) {
  TactileSettings settings = defaultTactileSettings(sdh2());
  settings[1].thresholdCounts = 4095;
  const auto unfelt = unmeasurableLimits(sdh2(), settings, 200);
  EXPECT_EQ(namesOf(unfelt), std::vector<std::string>{"finger 0 distal"});
  EXPECT_EQ(unfelt.at(0).why,
            "finger 0 distal can't measure it: its threshold of 4095 leaves no more than 0 counts");
  // 4095 - 3700 = 395 counts are left: a limit of 200 needs 400.
  settings[1].thresholdCounts = 3700;
  EXPECT_EQ(unmeasurableLimits(sdh2(), settings, 200).size(), 1u);
  EXPECT_TRUE(unmeasurableLimits(sdh2(), settings, 100).empty() ||
              unmeasurableLimits(sdh2(), settings, 100)[0].why.find("sensitivity") !=
                  std::string::npos);
}

TEST(FeltLimit, ASensitivityOfNothingOrTooLittleIsNamed) {
  TactileSettings settings = defaultTactileSettings(sdh2());
  settings[4].sensitivity = 0.0;
  settings[5].sensitivity = 0.01;
  const auto unfelt = unmeasurableLimits(sdh2(), settings, 200);
  EXPECT_EQ(namesOf(unfelt), (std::vector<std::string>{"finger 2 proximal", "finger 2 distal"}));
  EXPECT_NE(unfelt.at(0).why.find("its sensitivity is 0"), std::string::npos) << unfelt[0].why;
  EXPECT_NE(unfelt.at(1).why.find("at sensitivity 0.01"), std::string::npos) << unfelt[1].why;
  settings[4].sensitivity = settings[5].sensitivity = 0.2;
  EXPECT_TRUE(unmeasurableLimits(sdh2(), settings, 200).empty());
}

TEST(FeltLimit, AMatrixOfWhichNothingIsScannedIsNamed) {
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[2].dynamicMask.assign(matrices[2].numCells(), 0);
  HandDescription hand = sdh2();
  hand.layout = std::make_shared<const SensorLayout>(SensorLayout(matrices));
  const auto unfelt = unmeasurableLimits(hand, defaultTactileSettings(hand), 200);
  EXPECT_EQ(namesOf(unfelt), std::vector<std::string>{"finger 1 proximal"});
  EXPECT_NE(unfelt.at(0).why.find("no taxel of it is scanned"), std::string::npos);
}

TEST(FeltLimit, EndsBelowSaturation) {
  EXPECT_TRUE(unmeasurableLimits(sdh2(), {}, 3300).empty());
  EXPECT_EQ(unmeasurableLimits(sdh2(), {}, 3301).size(), 6u);
  HandDescription other = sdh2();
  other.saturationCounts = 1000.0F;
  EXPECT_EQ(unmeasurableLimits(other, {}, 801).size(), 6u);
  EXPECT_TRUE(unmeasurableLimits(other, {}, 800).empty());
}

// The pinches fold finger 1 away.
TEST(FeltLimit, OnlyFingersThatMoveMatter) {
  const auto moving = [](const char* preshape) {
    std::vector<int> fingers;
    for (const MatrixDescription& matrix : sdh2().matrices)
      if (movesWith(sdh2Preshape(preshape), matrix) && matrix.segment == "distal")
        fingers.push_back(matrix.finger);
    return fingers;
  };
  EXPECT_EQ(moving("centrical"), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(moving("pinch-parallel"), (std::vector<int>{0, 2}));
  EXPECT_TRUE(moving("calibration").empty());
}

}  // namespace
}  // namespace palpate::limit_feasibility_test
