#include "palpate/model/hand_joints.h"

#include <memory>
#include <numbers>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"

namespace palpate::hand_joints_test {
namespace {

// A hand with the axis "spread" that moves the joint `moved`, and an axis "close" without joints.
HandDescription handWith(const std::string& joints, const std::string& moved) {
  HandDescription hand;
  hand.axes.resize(2);
  hand.axes[0].name = "spread";
  hand.axes[1].name = "close";
  HandFile file;
  file.urdf = "<robot name=\"r\">" + joints + "</robot>";
  file.axisJoints = {{moved}, {}};
  hand.file = std::make_shared<const HandFile>(file);
  return hand;
}

constexpr char kFollowing[] =
    R"(<joint name="wrist" type="fixed"/><joint name="a" type="revolute"/>)"
    R"(<joint name="b" type="revolute"><mimic joint="a" multiplier="-2" offset="0.5"/></joint>)"
    R"(<joint name="c" type="revolute"><mimic joint="b" multiplier="3"/></joint>)";

TEST(HandJoints, WithoutAUrdfAnAxisIsAJoint) {
  HandDescription hand;
  hand.axes.resize(1);
  hand.axes[0].name = "spread";
  const std::vector<HandJoint> joints = handJoints(hand);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_EQ(joints[0].name, "spread");
  const double angles[] = {180.0};
  EXPECT_NEAR(joints[0].valueSi(angles), std::numbers::pi, 1e-12);
  EXPECT_EQ(joints[0].valueSi({}), 0.0);
}

// b = -2 a + 0.5 rad and c = 3 b, so c = -6 a + 1.5 rad.
TEST(HandJoints, JointsThatMimicOthersFollowTheAxis) {
  const std::vector<HandJoint> joints = handJoints(handWith(kFollowing, "a"));
  ASSERT_EQ(joints.size(), 4u);
  EXPECT_EQ(joints[0].name, "a");
  EXPECT_EQ(joints[1].name, "close") << "an axis without joints is one";
  EXPECT_EQ(joints[2].name, "b");
  EXPECT_EQ(joints[3].name, "c");
  const double angles[] = {18.0, 0.0};  // 0.1 pi
  EXPECT_NEAR(joints[2].valueSi(angles), -0.2 * std::numbers::pi + 0.5, 1e-12);
  EXPECT_NEAR(joints[3].valueSi(angles), -0.6 * std::numbers::pi + 1.5, 1e-12);
}

TEST(HandJoints, WhatDoesNotFitIsNamedOrLeftToTheAxes) {
  for (const auto& [joints, moved, words] :
       {std::tuple{kFollowing, "z", "names 'z', which the URDF does not have"},
        std::tuple{kFollowing, "wrist", "names 'wrist', which is a fixed joint"},
        std::tuple{R"(<joint name="a" type="prismatic"/>)", "a", "the axis is in deg"}}) {
    const HandDescription hand = handWith(joints, moved);
    try {
      handJoints(hand);
      ADD_FAILURE() << words;
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_EQ(shownJoints(hand).size(), 2u);
  }
}

}  // namespace
}  // namespace palpate::hand_joints_test
