#include "palpate/kinematics/geometry_description.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

#include "testing/sdh2.h"

namespace palpate::geometry_description_test {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Figures of the study (chapter 4): a triangle of 66 mm, links of 86.5 and 68.5 mm.
TEST(GeometryDescription, TheSdh2HasTheLengthsOfTheStudy) {
  const GeometryDescription hand = sdh2Geometry();
  ASSERT_EQ(hand.fingers.size(), 3u);
  EXPECT_EQ(hand.numAxes, 7u);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_NEAR((hand.fingers[f].baseMm - hand.fingers[(f + 1) % 3].baseMm).norm(), 66.0, 1e-12);
    ASSERT_EQ(hand.fingers[f].links.size(), 3u);
    const auto& links = hand.fingers[f].links;
    EXPECT_NEAR(std::abs(links[0].jointFromEnd.translation().z()), 16.7, 1e-9);
    EXPECT_LT((links[1].jointFromEnd.translation() - Eigen::Vector3d(86.5, 0, 0)).norm(), 1e-9);
    EXPECT_LT((links[2].jointFromEnd.translation() - Eigen::Vector3d(68.5, 0, 0)).norm(), 1e-9);
  }
  EXPECT_EQ(hand.surfaces.size(), 6u);
  EXPECT_NO_THROW(hand.validate());
}

// The bend is a circle that goes on from the flat part: same place, same direction, arc length
// kept.
TEST(GeometryDescription, ASurfaceRowLiesOnThePlaneOrTheCircle) {
  for (const auto& [radius, radiusMm] :
       {std::pair(BendRadius::kNominal, 58.0), std::pair(BendRadius::kEffective, 48.4)}) {
    const SensorSurface surface = sdh2Geometry(radius).surfaces[1];
    ASSERT_DOUBLE_EQ(surface.radiusMm, radiusMm);
    const double bendY = 3.4 * 8.5;
    for (double row = -2.0; row < 14.0; row += 0.25) {
      const SurfaceRow at = surfaceRow(surface, 3.4, row);
      EXPECT_NEAR(std::hypot(at.normalY, at.normalZ), 1.0, 1e-15);
      if (row > 8.5) {
        EXPECT_EQ(at.zMm, 0.0);
        EXPECT_NEAR(bendY - at.yMm, (8.5 - row) * 3.4, 1e-12);
        EXPECT_EQ(at.normalZ, -1.0);
      } else {
        const double fromAxisY = at.yMm - bendY, fromAxisZ = at.zMm - radiusMm;
        EXPECT_NEAR(std::hypot(fromAxisY, fromAxisZ), radiusMm, 1e-12) << row;
        EXPECT_NEAR(std::atan2(-fromAxisY, -fromAxisZ) * radiusMm, (8.5 - row) * 3.4, 1e-12) << row;
        EXPECT_NEAR(at.normalY, fromAxisY / radiusMm, 1e-12);
      }
    }
    const SurfaceRow below = surfaceRow(surface, 3.4, 8.5),
                     above = surfaceRow(surface, 3.4, 8.5001);
    EXPECT_NEAR(below.yMm, above.yMm, 1e-3);
    EXPECT_NEAR(below.zMm, above.zMm, 1e-9);
  }
}

TEST(GeometryDescription, WhatDoesNotFitIsRefused) {
  const std::function<void(GeometryDescription&)> breakages[] = {
      [](auto& hand) { hand.surfaces.pop_back(); },
      [](auto& hand) { hand.surfaces[0].place.finger = 3; },
      [](auto& hand) { hand.surfaces[5].place.link = 3; },
      [](auto& hand) { hand.surfaces[1].radiusMm = 0.0; },
      [](auto& hand) { hand.surfaces[1].radiusMm = kNoNumber; },
      [](auto& hand) { hand.surfaces[1].bendRow = kNoNumber; },
      [](auto& hand) { hand.surfaces[2].linkFromSurface.translation().y() = kNoNumber; },
      [](auto& hand) { hand.fingers[0].links[1].axis = 7; },
      [](auto& hand) { hand.fingers[0].links[1].jointFromEnd.translation().x() = kNoNumber; },
      [](auto& hand) { hand.fingers[1].baseMm.x() = kNoNumber; },
      [](auto& hand) { hand.fingers[1].baseRotation *= 2.0; },
      [](auto& hand) { hand.fingers[1].baseRotation.col(0) *= -1.0; },
  };
  for (const auto& breakIt : breakages) {
    GeometryDescription hand = sdh2Geometry();
    breakIt(hand);
    EXPECT_THROW(hand.validate(), std::invalid_argument) << &breakIt - breakages;
  }
}

// Both pads of the gripper move by the travel of the axis and face each other.
TEST(GeometryDescription, AGripperSlides) {
  const HandDescription& gripper = builtInHand("parallel_gripper");
  const HandGeometry geometry(describeGeometry(gripper));
  const HandPose pose = geometry.pose({20.0});
  EXPECT_LT((pose.positionMm(0, 0, 0) - Eigen::Vector3d(-20.0, -8.5, 80.0)).norm(), 1e-9);
  EXPECT_LT((pose.positionMm(0, 13, 5) - Eigen::Vector3d(-20.0, 8.5, 80.0 - 13 * 3.4)).norm(),
            1e-9);
  EXPECT_LT((pose.positionMm(1, 0, 0) - Eigen::Vector3d(20.0, 8.5, 80.0)).norm(), 1e-9);
  EXPECT_LT((pose.normal(0, 3, 3) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((pose.normal(1, 3, 3) + Eigen::Vector3d::UnitX()).norm(), 1e-12);
  ASSERT_EQ(pose.jointAxes().size(), 2u);
  EXPECT_EQ(pose.jointAxes()[0].type, JointType::kPrismatic);
}

// With all joints at 0 the middle finger is straight: its length is the sum of its links. A curled
// finger moves towards the side that its fingertip looks to.
TEST(GeometryDescription, AHandOfFourFingers) {
  const HandGeometry geometry(describeGeometry(builtInHand("four_fingers")));
  ASSERT_EQ(geometry.description().fingers.size(), 4u);
  ASSERT_EQ(geometry.description().numAxes, 16u);
  std::vector<double> angles(16, 0.0);
  const HandPose straight = geometry.pose(angles);
  const double knuckleMm = 0.7 + 16.4 + 54.0 + 38.4;
  EXPECT_LT((straight.positionMm(1, 0, 0) - Eigen::Vector3d(12.0, -6.0, knuckleMm + 28.0)).norm(),
            1e-6);
  EXPECT_LT((straight.normal(1, 0, 0) - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  angles[5] = 45.0;
  const HandPose curled = geometry.pose(angles);
  EXPECT_GT(curled.positionMm(1, 0, 0).x(), straight.positionMm(1, 0, 0).x() + 50.0);
}

// A joint that mimics another one that mimics a third: value = multiplier * value + offset, twice.
TEST(GeometryDescription, JointsFollowOthers) {
  const auto joint = [](const std::string& name,
                        const std::string& from,
                        const std::string& to,
                        const std::string& mimic) {
    return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + from +
           "\"/><child link=\"" + to +
           "\"/><origin xyz=\"0.1 0 0\"/><axis xyz=\"0 0 1\"/>"
           "<limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/>" +
           mimic + "</joint>";
  };
  const std::string urdf =
      R"(<robot name="x"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>)" +
      joint("j1", "base", "a", "") +
      joint("j2", "a", "b", R"(<mimic joint="j1" multiplier="2" offset="0.1"/>)") +
      joint("j3", "b", "c", R"(<mimic joint="j2" multiplier="-0.5" offset="0.2"/>)") + "</robot>";
  const std::string json = R"({"format": "palpate-hand", "version": 1, "name": "x",
      "full_scale": 1, "urdf": "hand.urdf",
      "axes": [{"name": "only", "minimum": -90, "maximum": 90, "joints": ["j1"]}],
      "matrices": [{"name": "m", "rows": 1, "columns": 1, "pitch_mm": 1, "surface":
      {"link": "c", "origin_mm": [0, 0, 0], "x_axis": [1, 0, 0], "y_axis": [0, 1, 0]}}]})";
  const HandGeometry geometry(describeGeometry(parseHand(json, urdf, "hand.json")));
  const double q1 = 0.3, q2 = 2.0 * q1 + 0.1, q3 = -0.5 * q2 + 0.2;
  const HandPose pose = geometry.pose({q1 * 180.0 / std::numbers::pi});
  const Eigen::Vector3d expected(100.0 + 100.0 * std::cos(q1) + 100.0 * std::cos(q1 + q2),
                                 100.0 * std::sin(q1) + 100.0 * std::sin(q1 + q2),
                                 0.0);
  EXPECT_LT((pose.positionMm(0, 0, 0) - expected).norm(), 1e-9);
  const double turned = q1 + q2 + q3;
  const Eigen::Vector3d x = pose.baseFromMatrix(0).linear().col(0);
  EXPECT_LT((x - Eigen::Vector3d(std::cos(turned), std::sin(turned), 0.0)).norm(), 1e-9);
}

// Taxels of which each has a place of its own: points between them are interpolated.
TEST(GeometryDescription, ASurfaceByItsTaxels) {
  const std::string json = R"({"format": "palpate-hand", "version": 1, "name": "x",
      "full_scale": 1, "matrices": [{"name": "m", "rows": 1, "columns": 2, "pitch_mm": 2,
      "surface": {"taxels": [{"position_mm": [1, 2, 3], "normal": [0, 0, 1]},
                             {"position_mm": [3, 2, 5], "normal": [1, 0, 0]}]}}]})";
  const HandGeometry geometry(describeGeometry(parseHand(json, "", "hand.json")));
  const HandPose pose = geometry.pose(std::vector<double>{});
  EXPECT_LT((pose.positionMm(0, 0, 1) - Eigen::Vector3d(3, 2, 5)).norm(), 1e-12);
  EXPECT_LT((pose.normal(0, 0, 1) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((pose.pointMm(0, 1.0, 0.0) - Eigen::Vector3d(2, 2, 4)).norm(), 1e-12);
  const double half = std::sqrt(0.5);
  EXPECT_LT((pose.normalAt(0, 1.0, 0.0) - Eigen::Vector3d(half, 0, half)).norm(), 1e-12);
  const Eigen::Matrix3d frame = pose.baseFromSurface(0, 1.0, 0.0).linear();
  EXPECT_TRUE(frame.isUnitary(1e-9));
  EXPECT_NEAR(frame.determinant(), 1.0, 1e-9);
}

}  // namespace
}  // namespace palpate::geometry_description_test
