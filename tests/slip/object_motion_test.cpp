#include "palpate/slip/object_motion.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_description.h"

#include "testing/sdh2.h"

namespace palpate::object_motion_test {
namespace {

using Eigen::Vector3d;

// Returns what a contact at `at` measures of an object that moves by t and rotates by w about the
// origin of the base frame.
SlipArrow felt(const Vector3d& at, const Vector3d& normal, const Vector3d& t, const Vector3d& w) {
  SlipArrow arrow;
  arrow.originMm = at;
  arrow.normal = normal.normalized();
  arrow.alongX = arrow.normal.unitOrthogonal();
  arrow.alongY = arrow.normal.cross(arrow.alongX);
  const Vector3d v = t + w.cross(at);
  arrow.vectorMm = v - arrow.normal * arrow.normal.dot(v);
  return arrow;
}

TEST(ObjectMotion, ThreeContactsTellAll) {
  const Vector3d t(1.0, -0.5, 2.0), w(0.01, 0.02, -0.03);
  const std::vector<SlipArrow> arrows = {felt({30, 0, 80}, {-1, 0, 0}, t, w),
                                         felt({-15, 26, 90}, {0.5, -0.8, 0.2}, t, w),
                                         felt({-15, -26, 100}, {0.5, 0.8, 0.1}, t, w)};
  const ObjectMotion motion = objectMotion(arrows);
  EXPECT_EQ(motion.contacts, 3U);
  EXPECT_EQ(motion.rank, 6);
  EXPECT_TRUE(motion.unknown.empty());
  EXPECT_NEAR(motion.residualMm, 0.0, 1e-9);
  EXPECT_NEAR((motion.rotationRad - w).norm(), 0.0, 1e-9);
  EXPECT_NEAR((motion.translationMm - (t + w.cross(motion.centerMm))).norm(), 0.0, 1e-7);
}

// Two fingers face each other along x, with both surfaces upright. They cannot measure translation
// along x and rotation about x.
TEST(ObjectMotion, TwoContactsLeaveTheTurnBetweenThemFree) {
  const Vector3d t(0.0, 1.0, -2.0), w(0.0, 0.02, 0.05);
  const std::vector<SlipArrow> arrows = {felt({30, 0, 0}, {-1, 0, 0}, t, w),
                                         felt({-30, 0, 0}, {1, 0, 0}, t, w)};
  const ObjectMotion motion = objectMotion(arrows);
  EXPECT_EQ(motion.rank, 4);
  ASSERT_EQ(motion.unknown.size(), 2U);
  for (const auto& direction : motion.unknown)
    EXPECT_NEAR(std::hypot(direction(0), direction(3)), 1.0, 1e-9);
  EXPECT_NEAR((motion.translationMm - t).norm(), 0.0, 1e-9);
  EXPECT_NEAR((motion.rotationRad - w).norm(), 0.0, 1e-9);
}

TEST(ObjectMotion, KnownTurnsCloseTheGap) {
  const Vector3d w(0.1, 0.0, 0.0);
  std::vector<SlipArrow> arrows = {felt({30, 0, 0}, {-1, 0, 0}, Vector3d::Zero(), w),
                                   felt({-30, 0, 0}, {1, 0, 0}, Vector3d::Zero(), w)};
  // About its own normal.
  arrows[0].turnRad = -0.1;
  arrows[1].turnRad = 0.1;
  const ObjectMotion motion = objectMotion(arrows);
  EXPECT_EQ(motion.rank, 5);
  EXPECT_NEAR((motion.rotationRad - w).norm(), 0.0, 1e-9);
}

TEST(ObjectMotion, OneContactAndNone) {
  const std::vector<SlipArrow> one = {
      felt({10, 20, 30}, {0, 0, 1}, Vector3d(1, 2, 0), Vector3d::Zero())};
  const ObjectMotion motion = objectMotion(one);
  EXPECT_EQ(motion.rank, 2);
  EXPECT_NEAR((motion.translationMm - Vector3d(1, 2, 0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(objectMotion({}).rank, 0);
}

TEST(ObjectMotion, ContradictionsRemainAsResidual) {
  std::vector<SlipArrow> arrows = {felt({30, 0, 0}, {-1, 0, 0}, Vector3d::Zero(), Vector3d::Zero()),
                                   felt({-30, 0, 0}, {1, 0, 0}, Vector3d::Zero(), Vector3d::Zero()),
                                   felt({0, 30, 0}, {1, 0, 0}, Vector3d::Zero(), Vector3d::Zero())};
  arrows[0].vectorMm = Vector3d(0, 1, 0);
  // The first two arrows describe a rotation about z by 1/30; the third one contradicts it.
  arrows[1].vectorMm = Vector3d(0, -1, 0);
  arrows[2].vectorMm = Vector3d(0, 3, 0);
  EXPECT_GT(objectMotion(arrows).residualMm, 0.5);
  arrows[0].weight = 0.0;
  EXPECT_THROW(objectMotion(arrows), std::invalid_argument);
}

// The tangents of a taxel come from kinematics: the arrow of one column to the right leads to the
// position of the neighbour.
TEST(SlipArrow, LiesOnTheSurface) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose({0, -30, 30, -20, 25, -30, 30});
  const double pitch = sdh2().layout->matrix(1).pitchMm.x;
  for (std::size_t matrix = 0; matrix < 6; ++matrix) {
    const SlipArrow right = slipArrow(pose, matrix, pitch, 2.0, 9.0, 1.0, 0.0);
    const SlipArrow down = slipArrow(pose, matrix, pitch, 2.0, 9.0, 0.0, 1.0);
    EXPECT_NEAR((right.originMm - pose.positionMm(matrix, 9, 2)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((right.originMm + right.vectorMm - pose.positionMm(matrix, 9, 3)).norm(), 0.0, 0.1);
    EXPECT_NEAR((down.originMm + down.vectorMm - pose.positionMm(matrix, 10, 2)).norm(), 0.0, 0.2);
    EXPECT_NEAR(right.vectorMm.norm(), pitch, 1e-9);
    EXPECT_NEAR(right.normal.dot(pose.normal(matrix, 9, 2)), 1.0, 1e-6);
  }
  EXPECT_THROW(slipArrow(pose, 0, pitch, 0, 0, std::nan(""), 0), std::invalid_argument);
  const SlipArrow both = slipArrow(pose, 0, {5.28, 10.28}, 0.0, 0.0, 2.0, -1.0);
  EXPECT_NEAR(both.vectorMm.dot(both.alongX), 10.56, 1e-9);
  EXPECT_NEAR(both.vectorMm.dot(both.alongY), -10.28, 1e-9);
  EXPECT_THROW(slipArrow(pose, 0, 0.0, 0, 0, 1, 0), std::invalid_argument);
  EXPECT_THROW(slipArrow(pose, 0, {1.0, 0.0}, 0, 0, 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::object_motion_test
