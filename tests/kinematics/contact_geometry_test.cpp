#include "palpate/kinematics/contact_geometry.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_description.h"
#include "palpate/recording/recording.h"

#include "kinematics/golden_table.h"
#include "testing/testing.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

// All rows of the golden file: one frame of every shared grasp. Its joint angles have five decimals, which the recording has
// too.
TEST(ContactGeometry, SpheresAgreeWithTheGoldenNumbers) {
  const auto golden = testing::goldenFolder();
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(golden);
  PALPATE_NEED(recordings);
  const testing::GoldenTable table(*golden / "bounding_sphere.csv");
  ASSERT_EQ(table.numRows(), 571u);
  const HandGeometry geometry;
  HandContact contact;
  HandPose pose;
  double worst = 0.0;
  for (std::size_t row = 0; row < table.numRows(); ++row) {
    const Profile profile = openRecording(*recordings / table.text(row, "file"));
    const TactileFrame frame = profile.frame(static_cast<std::size_t>(table.number(row, "frame")));
    std::vector<double> angles;
    for (int axis = 0; axis < 7; ++axis)
      angles.push_back(table.number(row, "phi" + std::to_string(axis)));
    geometry.pose(angles, pose);
    contactOf(frame, pose, {}, contact);
    ASSERT_EQ(static_cast<double>(contact.numActive), table.number(row, "active")) << row;
    const Sphere& taxels = *contact.taxelSphere;
    const Sphere& centroids = *contact.centroidSphere;
    const double differences[] = {taxels.centreMm.x() - table.number(row, "cx"),
                                  taxels.centreMm.y() - table.number(row, "cy"),
                                  taxels.centreMm.z() - table.number(row, "cz"),
                                  taxels.radiusMm - table.number(row, "radius"),
                                  centroids.centreMm.x() - table.number(row, "centroid_cx"),
                                  centroids.centreMm.y() - table.number(row, "centroid_cy"),
                                  centroids.centreMm.z() - table.number(row, "centroid_cz"),
                                  centroids.radiusMm - table.number(row, "centroid_radius")};
    for (const double difference : differences) worst = std::max(worst, std::abs(difference));
  }
  // The file has 15 digits, of coordinates up to 200 mm.
  EXPECT_LT(worst, 2e-12);
}

}  // namespace
}  // namespace palpate
