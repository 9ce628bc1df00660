#include "palpate/control/saved_pose.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"

namespace palpate::saved_pose_test {
namespace {

SavedPose pose() { return {"rest", sdh2().name, {0, -30, 30, -30.5, 30, -90, 90}}; }

TEST(SavedPose, IsReadAsItWasWritten) {
  SavedPose odd = pose();
  odd.name = "soft / \"things\" \xc3\xa4";
  const std::vector<SavedPose> poses{pose(), odd};
  EXPECT_EQ(parsePoses(posesText(poses), "poses.json"), poses);
  EXPECT_TRUE(parsePoses(posesText({}), "poses.json").empty());
}

TEST(SavedPose, FitsAHandOfItsNameWithinTheRangesOnly) {
  EXPECT_EQ(problemOf(pose(), sdh2()), "");
  SavedPose bad = pose();
  bad.hand = "another";
  EXPECT_EQ(problemOf(bad, sdh2()), "the pose 'rest' is of another hand: another");
  bad = pose();
  bad.anglesDeg.pop_back();
  EXPECT_EQ(problemOf(bad, sdh2()), "the pose 'rest' has 6 angles, the hand has 7 axes");
  for (const double angle :
       {-90.01, 90.01, std::nan(""), std::numeric_limits<double>::infinity()}) {
    bad = pose();
    bad.anglesDeg[1] = angle;
    EXPECT_NE(problemOf(bad, sdh2()).find("out of range: finger 0 proximal"), std::string::npos);
  }
}

TEST(SavedPose, ItsMotionNamesEveryAxis) {
  const MoveJoints move = motionTo(motionTo(pose(), 25.0), 0.0, sdh2());
  EXPECT_EQ(move.targetDeg, pose().anglesDeg);
  EXPECT_EQ(move.velocityDegPerS, std::vector<double>(7, 25.0));
  EXPECT_EQ(describe(motionTo(pose(), 25.0)), "motion: rest, 25 deg/s");
}

TEST(SavedPose, BadFilesAreRefusedWithTheirPlace) {
  const auto errorOf = [](const std::string& text) {
    try {
      parsePoses(text, "poses.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(errorOf("{").find("poses.json"), std::string::npos);
  EXPECT_NE(errorOf("{}").find("not a list of poses"), std::string::npos);
  EXPECT_NE(errorOf(R"({"format": "palpate-poses", "version": 2, "poses": []})").find("version"),
            std::string::npos);
  const std::string head = R"({"format": "palpate-poses", "version": 1, "poses": [)";
  EXPECT_NE(
      errorOf(head + R"({"name": "", "hand": "h", "angles_deg": []}]})").find("poses[0].name"),
      std::string::npos);
  EXPECT_NE(
      errorOf(head + R"({"name": "a", "hand": "h", "angles_deg": ["x"]}]})").find("angles_deg"),
      std::string::npos);
  EXPECT_NE(errorOf(head + R"({"name": "a", "angles_deg": []}]})").find("hand"), std::string::npos);
}

}  // namespace
}  // namespace palpate::saved_pose_test
