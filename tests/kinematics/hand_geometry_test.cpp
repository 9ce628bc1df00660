#include "palpate/kinematics/hand_geometry.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "palpate/core/number_text.h"

#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::hand_geometry_test {
namespace {

using Eigen::Vector3d;

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

// Every row of the golden file: taxels (masked ones too) and points on and beyond the matrices.
TEST(HandGeometry, AgreesWithTheGoldenNumbers) {
  const auto golden = testing::goldenFolder();
  PALPATE_NEED(golden);
  std::ifstream file(*golden / "forward_kinematics.csv");
  std::string line;
  std::getline(file, line);
  const HandGeometry geometry(sdh2Geometry());
  double worst = 0.0;
  std::size_t taxels = 0, points = 0;
  while (std::getline(file, line)) {
    const auto fields = fieldsOf(line);
    ASSERT_EQ(fields.size(), 15u) << line;
    std::vector<double> angles;
    for (std::size_t i = 2; i < 9; ++i) angles.push_back(parseDouble(fields[i]).value());
    const auto matrix = static_cast<std::size_t>(parseInteger(fields[9]).value());
    const double px = parseDouble(fields[10]).value(), py = parseDouble(fields[11]).value();
    const Vector3d expected(parseDouble(fields[12]).value(),
                            parseDouble(fields[13]).value(),
                            parseDouble(fields[14]).value());
    const HandPose pose = geometry.pose(angles);
    Vector3d got;
    if (fields[0] == "taxel") {
      got = pose.positionMm(matrix, static_cast<int>(py), static_cast<int>(px));
      ++taxels;
    } else {
      got = pose.pointMm(matrix, px, py);
      ++points;
    }
    worst = std::max(worst, (got - expected).cwiseAbs().maxCoeff());
  }
  EXPECT_GE(taxels, 3888u);
  EXPECT_EQ(taxels % 486, 0u);
  EXPECT_GE(points, 72u * taxels / 486);
  EXPECT_LT(worst, 1e-9);
}

const std::vector<double> kPoses[] = {
    {0, 0, 0, 0, 0, 0, 0}, {60, -75, 75, -30, 20, 7, -7}, {90, -72, 72, -90, 0, 11, -11}};

// Central differences along the rows and columns span the surface.
TEST(HandGeometry, NormalsStandOnTheSurface) {
  const HandGeometry geometry(sdh2Geometry());
  for (const auto& angles : kPoses) {
    const HandPose pose = geometry.pose(angles);
    for (std::size_t m = 0; m < 6; ++m)
      for (double yMm = -1.0; yMm < 46.0; yMm += 1.7) {
        if (std::abs(yMm - 8.5 * 3.4) < 0.01) continue;
        const double h = 1e-5;
        const Vector3d alongY =
            (pose.pointMm(m, 5.0, yMm + h) - pose.pointMm(m, 5.0, yMm - h)) / (2 * h);
        const Vector3d alongX =
            (pose.pointMm(m, 5.0 + h, yMm) - pose.pointMm(m, 5.0 - h, yMm)) / (2 * h);
        const Vector3d normal = pose.normalAt(m, 5.0, yMm);
        EXPECT_NEAR(alongX.norm(), 1.0, 1e-7);
        EXPECT_NEAR(alongY.norm(), 1.0, 1e-7) << "arc length is kept";
        EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
        EXPECT_NEAR(normal.dot(alongX), 0.0, 1e-7);
        EXPECT_NEAR(normal.dot(alongY), 0.0, 1e-7);
      }
  }
}

// With the fingers straight up the sensors look inwards, at the axis of the hand.
TEST(HandGeometry, NormalsPointOutOfTheSensorTowardsTheObject) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose(std::vector<double>(7, 0.0));
  // Axis 0 at 60 degrees: all three fingers look at the middle.
  const HandPose centrical = geometry.pose({60, 0, 0, 0, 0, 0, 0});
  for (const std::size_t m : {0u, 2u, 4u}) {
    const Vector3d position = centrical.positionMm(m, 7, 2);
    const Vector3d normal = centrical.normal(m, 7, 2);
    const Vector3d inwards = Vector3d(-position.x(), -position.y(), 0.0).normalized();
    EXPECT_GT(normal.dot(inwards), 0.95) << m;
    EXPECT_NEAR(normal.z(), 0.0, 1e-12) << m;
  }
  // Towards the tip a bent fingertip looks up.
  EXPECT_GT(pose.normal(1, 0, 2).z(), 0.3);
  EXPECT_NEAR(pose.normal(1, 12, 2).z(), 0.0, 1e-12);
}

TEST(HandGeometry, TaxelsAndPointsAreTheSamePlaces) {
  const HandGeometry geometry(sdh2Geometry(BendRadius::kEffective));
  for (const auto& angles : kPoses) {
    const HandPose pose = geometry.pose(angles);
    for (std::size_t m = 0; m < 6; ++m)
      for (int y = 0; y < (m % 2 == 0 ? 14 : 13); ++y)
        for (int x = 0; x < 6; ++x) {
          EXPECT_LT((pose.positionMm(m, y, x) - pose.pointMm(m, 3.4 * x, 3.4 * y)).norm(), 1e-9);
          EXPECT_LT((pose.normal(m, y, x) - pose.normalAt(m, 3.4 * x, 3.4 * y)).norm(), 1e-9);
        }
  }
}

// d p / d angle = direction x (p - origin), summed over the joints in front of the taxel.
TEST(HandGeometry, JointLinesAreWhatTheAnglesTurnAbout) {
  const HandGeometry geometry(sdh2Geometry());
  const double stepDeg = 1e-4;
  for (const auto& angles : kPoses) {
    const HandPose pose = geometry.pose(angles);
    for (std::size_t axis = 0; axis < 7; ++axis) {
      auto turned = angles;
      turned[axis] += stepDeg;
      const HandPose after = geometry.pose(turned);
      for (std::size_t m = 0; m < 6; ++m) {
        const SensorSurface& surface = geometry.description().surfaces[m];
        const Vector3d at = pose.positionMm(m, 3, 1);
        Vector3d expected = Vector3d::Zero();
        for (const JointAxis& line : pose.jointAxes())
          if (line.axis == axis && line.finger == surface.place.finger &&
              line.link <= *surface.place.link)
            expected += line.direction.cross(at - line.originMm);
        const Vector3d moved =
            (after.positionMm(m, 3, 1) - at) / (stepDeg * std::acos(-1.0) / 180.0);
        EXPECT_LT((moved - expected).norm(), 1e-2) << axis << ' ' << m;
      }
    }
  }
}

TEST(HandGeometry, ASmallerFingertipBendsMore) {
  const HandGeometry study(sdh2Geometry()), effective(sdh2Geometry(BendRadius::kEffective));
  const HandPose a = study.pose(kPoses[0]), b = effective.pose(kPoses[0]);
  EXPECT_LT(b.positionMm(1, 0, 2).z(), a.positionMm(1, 0, 2).z());
  EXPECT_EQ(b.positionMm(1, 10, 2), a.positionMm(1, 10, 2));
}

TEST(HandGeometry, WrongQuestionsAreRefused) {
  const HandGeometry geometry(sdh2Geometry());
  EXPECT_THROW(geometry.pose(std::vector<double>(6, 0.0)), std::invalid_argument);
  std::vector<double> angles(7, 0.0);
  angles[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(geometry.pose(angles), std::invalid_argument);
  const HandPose pose = geometry.pose(std::vector<double>(7, 0.0));
  EXPECT_THROW(pose.positionMm(6, 0, 0), std::out_of_range);
  EXPECT_THROW(pose.positionMm(1, 13, 0), std::out_of_range);
  EXPECT_THROW(pose.normal(1, 0, -1), std::out_of_range);
  EXPECT_THROW(pose.pointMm(6, 0, 0), std::out_of_range);
  EXPECT_THROW(pose.pointMm(0, std::numeric_limits<double>::infinity(), 0), std::invalid_argument);
  GeometryDescription broken = sdh2Geometry();
  broken.surfaces.pop_back();
  EXPECT_THROW(HandGeometry{broken}, std::invalid_argument);
  broken = sdh2Geometry();
  broken.fingers[0].links[1].axis = 7;
  EXPECT_THROW(HandGeometry{broken}, std::invalid_argument);
}

}  // namespace
}  // namespace palpate::hand_geometry_test
