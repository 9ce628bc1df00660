#include "palpate/kinematics/hand_pose.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "palpate/kinematics/hand_geometry.h"

#include "testing/sdh2.h"

namespace palpate::hand_pose_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const std::vector<double> kPoses[] = {
    {0, 0, 0, 0, 0, 0, 0}, {60, -75, 75, -30, 20, 7, -7}, {90, -72, 72, -90, 0, 11, -11}};

void expectRigid(const Isometry3d& transform) {
  EXPECT_LT((transform.linear().transpose() * transform.linear() - Eigen::Matrix3d::Identity())
                .cwiseAbs()
                .maxCoeff(),
            1e-14);
  EXPECT_NEAR(transform.linear().determinant(), 1.0, 1e-14);
  EXPECT_EQ(transform.matrix().row(3), Eigen::RowVector4d(0, 0, 0, 1));
}

// Joint centres by trigonometry in the plane of a finger: from the base 16.7 mm up to the proximal
// joint, 86.5 mm along the proximal link (tilted by its angle from upright), 68.5 mm along the
// distal one.
TEST(HandPose, LinksEndWhereTrigonometrySays) {
  const HandGeometry geometry(sdh2Geometry());
  const double rad = std::numbers::pi / 180.0;
  for (const auto& angles : kPoses) {
    const HandPose pose = geometry.pose(angles);
    for (std::size_t f = 0; f < 3; ++f) {
      const Vector3d base = geometry.description().fingers[f].baseMm;
      for (std::size_t l = 0; l < 3; ++l) expectRigid(pose.baseFromLink(f, l));
      const Vector3d root = pose.baseFromLink(f, 0).translation();
      const Vector3d knuckle = pose.baseFromLink(f, 1).translation();
      const Vector3d tip = pose.baseFromLink(f, 2).translation();
      EXPECT_LT((root - base - Vector3d(0, 0, 16.7)).norm(), 1e-12);
      const double proximal = angles[2 * f + 1] * rad, distal = proximal + angles[2 * f + 2] * rad;
      EXPECT_NEAR(knuckle.z() - root.z(), 86.5 * std::cos(proximal), 1e-12);
      EXPECT_NEAR(tip.z() - knuckle.z(), 68.5 * std::cos(distal), 1e-12);
      EXPECT_NEAR((knuckle - root).norm(), 86.5, 1e-12);
      EXPECT_NEAR((tip - knuckle).norm(), 68.5, 1e-12);
      // Sideways in the finger's plane, towards the object with rising angles.
      const double reach = 86.5 * std::sin(proximal) + 68.5 * std::sin(distal);
      EXPECT_NEAR((tip - root).head<2>().norm(), std::abs(reach), 1e-9);
      // A link's X axis points along it.
      EXPECT_LT((pose.baseFromLink(f, 2) * Vector3d(-68.5, 0, 0) - knuckle).norm(), 1e-12);
    }
  }
}

// At phi0 = 90 degrees fingers 0 and 2 face each other along y, in the plane x = 19.05: bent
// inwards by the same angle b at their roots, their tips are 66 - 2 (86.5 + 68.5) sin b apart;
// straight, 66 mm.
TEST(HandPose, FingertipsMeetAtTheAngleThatTrigonometrySays) {
  const HandGeometry geometry(sdh2Geometry());
  const auto tips = [&](double bendDeg, double phi0 = 90.0) {
    const HandPose pose = geometry.pose({phi0, bendDeg, 0, 0, 0, bendDeg, 0});
    return (pose.baseFromLink(0, 2).translation() - pose.baseFromLink(2, 2).translation()).eval();
  };
  EXPECT_NEAR(tips(0.0).norm(), 66.0, 1e-12);
  EXPECT_NEAR(tips(7.0).norm(), 66.0 - 310.0 * std::sin(7.0 * std::numbers::pi / 180.0), 1e-10);
  EXPECT_NEAR(tips(-20.0).norm(), 66.0 + 310.0 * std::sin(20.0 * std::numbers::pi / 180.0), 1e-10);
  const double meet = std::asin(33.0 / 155.0) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(tips(meet).norm(), 0.0, 1e-10);
  // At phi0 = 0 both look the same way: bending keeps them 66 mm apart.
  EXPECT_NEAR(tips(25.0, 0.0).norm(), 66.0, 1e-10);
}

TEST(HandPose, TheFrameOfASurfacePointTouchesIt) {
  const HandGeometry geometry(sdh2Geometry());
  const double h = 1e-5;
  for (const auto& angles : kPoses) {
    const HandPose pose = geometry.pose(angles);
    for (std::size_t m = 0; m < 6; ++m)
      for (double yMm = -1.0; yMm < 46.0; yMm += 1.7) {
        if (std::abs(yMm - 8.5 * 3.4) < 0.01) continue;
        const Isometry3d baseFromSurface = pose.baseFromSurface(m, 5.0, yMm);
        expectRigid(baseFromSurface);
        EXPECT_LT((baseFromSurface.translation() - pose.pointMm(m, 5.0, yMm)).norm(), 1e-12);
        EXPECT_LT((baseFromSurface.linear().col(2) - pose.normalAt(m, 5.0, yMm)).norm(), 1e-12);
        const Vector3d across = (pose.pointMm(m, 5.0 + h, yMm) - pose.pointMm(m, 5.0, yMm)) / h;
        const Vector3d toTip =
            (pose.pointMm(m, 5.0, yMm - h) - pose.pointMm(m, 5.0, yMm + h)) / (2 * h);
        EXPECT_LT((baseFromSurface.linear().col(0) - across).norm(), 1e-6);
        EXPECT_LT((baseFromSurface.linear().col(1) - toTip).norm(), 1e-6);
      }
  }
}

// Neighbours share corners, a taxel lies in the middle of its own, and the patches are as large as
// the taxel is along the curve: the quadrilateral of its chords is smaller by the ratio of chord to
// arc.
TEST(HandPose, CornersBelongToTheCurvedSurface) {
  for (const auto& [radius, radiusMm] :
       {std::pair(BendRadius::kNominal, 58.0), std::pair(BendRadius::kEffective, 48.4)}) {
    const HandGeometry geometry(sdh2Geometry(radius));
    const HandPose pose = geometry.pose(kPoses[1]);
    const double arc = 3.4 / radiusMm, chordMm = 2.0 * radiusMm * std::sin(arc / 2.0);
    std::vector<Vector3d> corners;
    for (std::size_t m = 0; m < 6; ++m) {
      const MatrixLayout& layout = geometry.description().layout.matrix(m);
      pose.cornersMm(m, corners);
      ASSERT_EQ(corners.size(), static_cast<std::size_t>((layout.rows + 1) * 7));
      for (int y = 0; y <= layout.rows; ++y)
        for (int x = 0; x <= 6; ++x)
          EXPECT_LT((corners[static_cast<std::size_t>(y * 7 + x)] - pose.cornerMm(m, y, x)).norm(),
                    1e-12);
      for (int y = 0; y < layout.rows; ++y)
        for (int x = 0; x < 6; ++x) {
          const Vector3d a = pose.cornerMm(m, y, x), b = pose.cornerMm(m, y, x + 1);
          const Vector3d c = pose.cornerMm(m, y + 1, x + 1), d = pose.cornerMm(m, y + 1, x);
          const bool bent = m % 2 == 1 && y <= 8;
          const double areaMm2 = ((c - a).cross(d - b)).norm() / 2.0;
          EXPECT_NEAR(areaMm2, 3.4 * (bent ? chordMm : 3.4), 1e-10) << m << ' ' << y;
          // The middle of the corners is the taxel, but for the height of the arc over its chord.
          const double sagittaMm = bent ? radiusMm * (1.0 - std::cos(arc / 2.0)) : 0.0;
          EXPECT_LT(
              (pose.positionMm(m, y, x) - pose.normal(m, y, x) * sagittaMm - (a + b + c + d) / 4.0)
                  .norm(),
              1e-10);
          EXPECT_NEAR((c - a).cross(b - d).normalized().dot(pose.normal(m, y, x)), 1.0, 1e-10);
        }
    }
  }
}

// The same code, another table: a single finger with one joint and one pad of 3 x 2 taxels of 5 mm.
TEST(HandPose, AnotherHandIsAnotherTable) {
  GeometryDescription hand;
  hand.numAxes = 1;
  hand.layout = SensorLayout({MatrixLayout::full(3, 2, 5.0)});
  Finger finger;
  finger.baseMm = {10.0, 20.0, 30.0};
  finger.links = {denavitHartenbergLink(0, 1.0, 0.0, 0.0, 100.0, 0.0)};
  hand.fingers = {finger};
  // Rows run against x of the link, columns along its z.
  SensorSurface surface;
  surface.place = {0, 0};
  surface.linkFromSurface.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  surface.linkFromSurface.translation() = Vector3d(-20.0, 8.0, -2.5);
  hand.surfaces = {surface};
  const HandGeometry geometry(hand);
  // The joint turns about z: at 90 degrees the link lies along y and its sensor (Y of the link)
  // looks along -x.
  const HandPose pose = geometry.pose({90.0});
  ASSERT_EQ(pose.positionsMm().size(), 6u);
  EXPECT_LT((pose.baseFromLink(0, 0).translation() - Vector3d(10, 120, 30)).norm(), 1e-12);
  EXPECT_LT((pose.positionMm(0, 0, 0) - Vector3d(2, 100, 27.5)).norm(), 1e-12);
  EXPECT_LT((pose.positionMm(0, 2, 1) - Vector3d(2, 90, 32.5)).norm(), 1e-12);
  EXPECT_LT((pose.normal(0, 1, 1) - Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((pose.cornerMm(0, 0, 0) - Vector3d(2, 102.5, 25)).norm(), 1e-12);
  ASSERT_EQ(pose.jointAxes().size(), 1u);
  EXPECT_EQ(pose.jointAxes()[0].originMm, finger.baseMm);
}

TEST(HandPose, WrongQuestionsAreRefused) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose(std::vector<double>(7, 0.0));
  EXPECT_THROW(pose.cornerMm(0, 15, 0), std::out_of_range);
  EXPECT_THROW(pose.cornerMm(0, 0, 7), std::out_of_range);
  EXPECT_THROW(pose.cornerMm(0, -1, 0), std::out_of_range);
  EXPECT_THROW(pose.cornerMm(6, 0, 0), std::out_of_range);
  EXPECT_THROW(pose.baseFromLink(3, 0), std::out_of_range);
  EXPECT_THROW(pose.baseFromLink(0, 3), std::out_of_range);
  EXPECT_THROW(pose.baseFromSurface(6, 0, 0), std::out_of_range);
  EXPECT_THROW(pose.baseFromSurface(0, std::nan(""), 0), std::invalid_argument);
  std::vector<Vector3d> corners;
  EXPECT_THROW(pose.cornersMm(6, corners), std::out_of_range);
}

TEST(HandPose, AnEmptyPoseSaysSo) {
  const HandPose none;
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.positionsMm().empty());
  EXPECT_THROW(none.description(), std::out_of_range);
  EXPECT_THROW(none.positionMm(0, 0, 0), std::out_of_range);
  EXPECT_THROW(none.pointMm(0, 0, 0), std::out_of_range);
  EXPECT_THROW(none.baseFromLink(0, 0), std::out_of_range);
  EXPECT_FALSE(HandGeometry(sdh2Geometry()).pose(std::vector<double>(7, 0.0)).empty());
}

}  // namespace
}  // namespace palpate::hand_pose_test
