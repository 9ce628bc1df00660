#include "palpate/kinematics/joint_range.h"

#include <limits>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

namespace palpate::joint_range_test {
namespace {

// The SDH-2: axis 0 turns 0..90 degrees, the others -90..90 (manual).
TEST(JointRange, KnowsWhatTheHandCanDo) {
  const auto& axes = sdh2().axes;
  EXPECT_EQ(checkAngles({0, -90, 90, 0, 0, 90, -90}, axes).state, AngleValidity::kValid);
  // As recorded: a real joint overshoots.
  EXPECT_EQ(checkAngles({90.00197, -6, 5, -90.004, 0, 0, 0}, axes).state, AngleValidity::kValid);
  const AnglesCheck beyond = checkAngles({0, 0, 0, 0, 0, 0, 91.5}, axes);
  EXPECT_EQ(beyond.state, AngleValidity::kOutOfRange);
  EXPECT_EQ(beyond.problem, "axis 6 (finger 2 distal) at 91.5 degrees; its range is -90..90");
  EXPECT_EQ(checkAngles({-1.5, 0, 0, 0, 0, 0, 0}, axes).state, AngleValidity::kOutOfRange);
  EXPECT_EQ(checkAngles({-1.5, 0, 0, 0, 0, 0, 0}, axes, 2.0).state, AngleValidity::kValid);
}

TEST(JointRange, WhatIsNoPoseIsUnusable) {
  const auto& axes = sdh2().axes;
  EXPECT_EQ(checkAngles({}, axes).problem, "0 joint angles for 7 axes");
  EXPECT_EQ(checkAngles(std::vector<double>(8, 0.0), axes).state, AngleValidity::kUnusable);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    // Not a number counts before out of range.
    const AnglesCheck check = checkAngles({400, 0, bad, 0, 0, 0, 0}, axes);
    EXPECT_EQ(check.state, AngleValidity::kUnusable);
    EXPECT_EQ(check.problem, "angle of axis 2 is not a number");
  }
}

}  // namespace
}  // namespace palpate::joint_range_test
