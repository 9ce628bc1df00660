#include "palpate/kinematics/contact_geometry.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/recording.h"

#include "kinematics/golden_table.h"
#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::contact_geometry_test {
namespace {

using Eigen::Vector3d;

// Loads of 1 on taxel (row 0, column 1) and 3 on (2, 3): the centroid is at column 2.5 and row 1.5,
// the variances are 0.75 taxels^2 in both directions, fully correlated.
TEST(ContactGeometry, TaxelsThatArentSquareByHand) {
  const HandDescription hand = parseHand(
      R"({"format": "palpate-hand", "version": 1, "name": "pad", "full_scale": 10, "matrices":
          [{"name": "a", "rows": 3, "columns": 4, "pitch_mm": [5.28, 10.28], "surface":
            {"origin_mm": [1, 2, 3], "x_axis": [1, 0, 0], "y_axis": [0, 1, 0]}}]})",
      "",
      "hand.json");
  const HandGeometry geometry(describeGeometry(hand));
  const HandPose pose = geometry.pose({});
  EXPECT_TRUE(pose.positionMm(0, 2, 3).isApprox(Vector3d(16.84, 22.56, 3.0)));
  EXPECT_TRUE(pose.cornerMm(0, 3, 4).isApprox(Vector3d(19.48, 27.7, 3.0)));
  TactileFrame frame(hand.layout);
  frame.matrix(0)(0, 1) = 1.0F;
  frame.matrix(0)(2, 3) = 3.0F;
  const MatrixContact contact = contactOf(frame, pose).matrices[0];
  EXPECT_DOUBLE_EQ(contact.xMm, 13.2);
  EXPECT_DOUBLE_EQ(contact.yMm, 15.42);
  EXPECT_TRUE(contact.centroidMm.isApprox(Vector3d(14.2, 17.42, 3.0)));
  EXPECT_DOUBLE_EQ(contact.areaMm2, 2.0 * 5.28 * 10.28);
  EXPECT_NEAR(contact.majorSdMm, std::sqrt(0.75) * std::hypot(5.28, 10.28), 1e-9);
  EXPECT_NEAR(contact.minorSdMm, 0.0, 1e-6);
}

// All rows of the golden file: one frame of every shared grasp. Its joint angles have five
// decimals, which the recording has too.
TEST(ContactGeometry, SpheresAgreeWithTheGoldenNumbers) {
  const auto golden = testing::goldenFolder();
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(golden);
  PALPATE_NEED(recordings);
  const testing::GoldenTable table(*golden / "bounding_sphere.csv");
  ASSERT_EQ(table.numRows(), 571u);
  const HandGeometry geometry(sdh2Geometry());
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

// What the study's window sketch shows: a ball of about 66 mm between two fingertips, 36 and 24
// active taxels.
TEST(ContactGeometry, OfAHandThatHoldsABall) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const Profile profile = openRecording(*folder / "grasps" / "foam_ball.dsa");
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose(profile.anglesAtFrame(2411)->values);
  const HandContact contact = contactOf(profile.frame(2411), pose);
  EXPECT_EQ(contact.numActive, 60u);
  EXPECT_EQ(contact.matrices[1].numActive, 36u);
  EXPECT_EQ(contact.matrices[5].numActive, 24u);
  EXPECT_NEAR(2.0 * contact.taxelSphere->radiusMm, 65.9, 1.0);
  EXPECT_LT(contact.centroidSphere->radiusMm, contact.taxelSphere->radiusMm);
  // Between the fingers, nearer to the one that feels more; the pads look at each other.
  const Vector3d a = contact.matrices[1].centroidMm, b = contact.matrices[5].centroidMm;
  EXPECT_LT((*contact.centroidMm - a).norm(), (*contact.centroidMm - b).norm());
  EXPECT_LT(contact.matrices[1].meanNormal.dot(contact.matrices[5].meanNormal), -0.9);
  EXPECT_NEAR(contact.areaMm2, 60 * 3.4 * 3.4, 1e-9);
}

class ContactOfAFrame : public ::testing::Test {
 protected:
  HandGeometry geometry_{sdh2Geometry()};
  HandPose pose_ = geometry_.pose({60, -20, 40, -20, 40, -20, 40});
  TactileFrame frame_{sdh2().layout};
};

TEST_F(ContactOfAFrame, OfNoTouchIsNothing) {
  const HandContact contact = contactOf(frame_, pose_);
  EXPECT_EQ(contact.numActive, 0u);
  EXPECT_FALSE(contact.taxelSphere || contact.centroidSphere || contact.centroidMm);
  ASSERT_EQ(contact.matrices.size(), 6u);
  for (const MatrixContact& matrix : contact.matrices) {
    EXPECT_EQ(matrix.numActive, 0u);
    EXPECT_EQ(matrix.areaMm2, 0.0);
    EXPECT_EQ(matrix.meanNormal, Vector3d::Zero());
  }
}

TEST_F(ContactOfAFrame, OfOneTaxelIsThatTaxel) {
  frame_.matrix(3)(2, 4) = 7.0F;
  const HandContact contact = contactOf(frame_, pose_);
  const MatrixContact& matrix = contact.matrices[3];
  EXPECT_EQ(matrix.numActive, 1u);
  EXPECT_LT((matrix.centroidMm - pose_.positionMm(3, 2, 4)).norm(), 1e-12);
  EXPECT_LT((matrix.meanNormal - pose_.normal(3, 2, 4)).norm(), 1e-12);
  EXPECT_EQ(matrix.majorSdMm, 0.0);
  EXPECT_EQ(matrix.minorSdMm, 0.0);
  EXPECT_NEAR(matrix.majorAxis.norm(), 1.0, 1e-12);
  EXPECT_EQ(contact.taxelSphere->radiusMm, 0.0);
  EXPECT_LT((contact.taxelSphere->centreMm - pose_.positionMm(3, 2, 4)).norm(), 1e-12);
  EXPECT_LT((*contact.centroidMm - pose_.positionMm(3, 2, 4)).norm(), 1e-12);
}

// By hand: values 1 and 3 at rows 10 and 12 of column 2: centroid at row 11.5, variance (1 * 1.5^2
// + 3 * .5^2) / 4 = .75 rows^2, all along the finger.
TEST_F(ContactOfAFrame, AxesAreThoseOfTheWeightedValues) {
  frame_.matrix(1)(10, 2) = 1.0F;
  frame_.matrix(1)(12, 2) = 3.0F;
  const MatrixContact matrix = contactOf(frame_, pose_).matrices[1];
  EXPECT_NEAR(matrix.xMm, 2 * 3.4, 1e-12);
  EXPECT_NEAR(matrix.yMm, 11.5 * 3.4, 1e-12);
  EXPECT_NEAR(matrix.majorSdMm, std::sqrt(0.75) * 3.4, 1e-12);
  EXPECT_NEAR(matrix.minorSdMm, 0.0, 1e-6);
  const Vector3d alongMm = pose_.positionMm(1, 10, 2) - pose_.positionMm(1, 12, 2);
  EXPECT_NEAR(std::abs(matrix.majorAxis.dot(alongMm.normalized())), 1.0, 1e-9);
  EXPECT_NEAR(matrix.sum, 4.0, 1e-12);
}

// A diagonal of the flat part: the major axis in space is the line through its taxels, whatever the
// pose.
TEST_F(ContactOfAFrame, AxesPointAlongTheContactInSpace) {
  for (const std::size_t m : {0u, 2u, 4u})
    for (int i = 0; i < 5; ++i) frame_.matrix(m)(3 + i, m == 2 ? 5 - i : i) = 10.0F;
  const HandContact contact = contactOf(frame_, pose_);
  for (const std::size_t m : {0u, 2u, 4u}) {
    const MatrixContact& matrix = contact.matrices[m];
    const Vector3d along =
        (pose_.positionMm(m, 3, m == 2 ? 5 : 0) - pose_.positionMm(m, 7, m == 2 ? 1 : 4))
            .normalized();
    EXPECT_NEAR(std::abs(matrix.majorAxis.dot(along)), 1.0, 1e-9) << m;
    EXPECT_NEAR(matrix.majorAxis.dot(matrix.minorAxis), 0.0, 1e-12);
    EXPECT_LT((matrix.majorAxis.cross(matrix.minorAxis) - pose_.normal(m, 5, 2)).norm(), 1e-9);
    // Five points sqrt(2) * 3.4 mm apart: variance 2 of that squared.
    EXPECT_NEAR(matrix.majorSdMm, 2.0 * 3.4, 1e-9);
  }
}

// On the bend the centroid lies on the surface, not on the chord, and the mean normal between the
// taxels' normals.
TEST_F(ContactOfAFrame, OnTheBendTheCentroidStaysOnTheSurface) {
  frame_.matrix(5)(1, 3) = frame_.matrix(5)(7, 3) = 5.0F;
  const MatrixContact matrix = contactOf(frame_, pose_).matrices[5];
  EXPECT_LT((matrix.centroidMm - pose_.pointMm(5, 3 * 3.4, 4 * 3.4)).norm(), 1e-12);
  const Vector3d chordMm = (pose_.positionMm(5, 1, 3) + pose_.positionMm(5, 7, 3)) / 2.0;
  EXPECT_GT((matrix.centroidMm - chordMm).norm(), 0.5);
  EXPECT_LT((matrix.meanNormal - pose_.normal(5, 4, 3)).norm(), 1e-9);
}

TEST_F(ContactOfAFrame, OddValuesAreCountedAndLeftOut) {
  frame_.matrix(1)(9, 2) = 10.0F;
  const HandContact plain = contactOf(frame_, pose_);
  frame_.matrix(1)(4, 2) = std::numeric_limits<float>::quiet_NaN();
  frame_.matrix(1)(5, 2) = std::numeric_limits<float>::infinity();
  frame_.matrix(0)(5, 2) = -std::numeric_limits<float>::infinity();
  frame_.matrix(1)(6, 2) = -20.0F;
  frame_.matrix(1)(0, 0) = 99.0F;  // the cut corner of a fingertip: no taxel
  const HandContact odd = contactOf(frame_, pose_);
  EXPECT_EQ(odd.numNotFinite, 3u);
  EXPECT_EQ(odd.numActive, 1u);
  EXPECT_EQ(odd.sum, 10.0);
  EXPECT_EQ(odd.matrices[1].centroidMm, plain.matrices[1].centroidMm);
  EXPECT_EQ(odd.taxelSphere->radiusMm, 0.0);
}

TEST_F(ContactOfAFrame, OptionsChangeWhatCounts) {
  frame_.matrix(1)(9, 2) = 10.0F;
  frame_.matrix(5)(9, 2) = 30.0F;
  ContactOptions options;
  options.threshold = 10.0;
  EXPECT_EQ(contactOf(frame_, pose_, options).numActive, 1u);
  options = {};
  options.spheres = false;
  const HandContact without = contactOf(frame_, pose_, options);
  EXPECT_EQ(without.numActive, 2u);
  EXPECT_FALSE(without.taxelSphere.has_value());
  EXPECT_EQ(without.matrices[1].centroidMm, contactOf(frame_, pose_).matrices[1].centroidMm);
}

TEST_F(ContactOfAFrame, MemoryThatIsUsedAgainKeepsNothing) {
  frame_.matrix(1)(9, 2) = 10.0F;
  frame_.matrix(4)(9, 2) = std::numeric_limits<float>::quiet_NaN();
  HandContact contact;
  contactOf(frame_, pose_, {}, contact);
  contactOf(TactileFrame(sdh2().layout), pose_, {}, contact);
  EXPECT_EQ(contact.numActive + contact.numNotFinite + contact.activeMm.size(), 0u);
  EXPECT_EQ(contact.sum + contact.areaMm2, 0.0);
  EXPECT_FALSE(contact.taxelSphere || contact.centroidSphere || contact.centroidMm);
}

TEST_F(ContactOfAFrame, WrongQuestionsAreRefused) {
  ContactOptions options;
  options.threshold = -1.0;
  EXPECT_THROW(contactOf(frame_, pose_, options), std::invalid_argument);
  options.threshold = std::nan("");
  EXPECT_THROW(contactOf(frame_, pose_, options), std::invalid_argument);
  EXPECT_THROW(contactOf(frame_, HandPose()), std::invalid_argument);
  EXPECT_THROW(contactOf(TactileFrame(), pose_), std::invalid_argument);
  const auto pad =
      std::make_shared<SensorLayout>(std::vector<MatrixLayout>{MatrixLayout::full(4, 4, 3.4)});
  EXPECT_THROW(contactOf(TactileFrame(pad), pose_), std::invalid_argument);
  // Matrices in another order: as many places, other sizes.
  std::vector<MatrixLayout> turned = sdh2().layout->matrices();
  std::reverse(turned.begin(), turned.end());
  EXPECT_THROW(contactOf(TactileFrame(std::make_shared<SensorLayout>(turned)), pose_),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::contact_geometry_test
