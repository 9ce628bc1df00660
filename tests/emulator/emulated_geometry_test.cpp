#include "palpate/emulator/emulated_geometry.h"

#include <gtest/gtest.h>

#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

#include "device/stream_hands.h"

namespace palpate::testing::emulated_geometry_test {
namespace {

using Eigen::Vector3d;

TEST(EmulatedGeometry, IsThatOfTheDescription) {
  const HandDescription& hand = builtInHand("flat_pad_16x16");
  const HandGeometry geometry(emulatedGeometry(hand));
  const HandPose pose = geometry.pose({});
  // hand.json: taxel (0, 0) at (-37.5, 37.5), pitch 5, rows downwards.
  EXPECT_LT((pose.positionMm(0, 3, 2) - Vector3d(-27.5, 22.5, 0.0)).norm(), 1e-9);
  EXPECT_LT((pose.normal(0, 3, 2) - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(EmulatedGeometry, AHandWithoutSurfacesLiesOnAPlaneAsItsPictureShows) {
  // Two pads of 2 x 3 and 4 x 1 places of 2 mm, the second one right of the first.
  HandDescription hand = padHand({{2, 3}, {4, 1}});
  hand.matrices[1].pictureColumn = 1;
  const HandGeometry geometry(emulatedGeometry(hand));
  const HandPose pose = geometry.pose({});
  // Widths with one pitch between: 8 and 4 mm; the middle of the picture is at the origin.
  EXPECT_LT((pose.positionMm(0, 0, 0) - Vector3d(-4.0, 3.0, 0.0)).norm(), 1e-9);
  EXPECT_LT((pose.positionMm(0, 1, 2) - Vector3d(0.0, 1.0, 0.0)).norm(), 1e-9);
  EXPECT_LT((pose.positionMm(1, 3, 0) - Vector3d(4.0, -3.0, 0.0)).norm(), 1e-9);
  for (const Vector3d& normal : pose.normals()) EXPECT_EQ(normal, Vector3d(0.0, 0.0, 1.0));
}

TEST(EmulatedGeometry, MatricesInOneCellOfThePictureDoNotOverlap) {
  const HandDescription hand = padHand({{2, 2}, {2, 2}, {2, 2}});
  const HandGeometry geometry(emulatedGeometry(hand));
  const HandPose pose = geometry.pose({});
  EXPECT_NEAR(pose.positionMm(1, 0, 0).x() - pose.positionMm(0, 0, 1).x(), 4.0, 1e-9);
  EXPECT_NEAR(pose.positionMm(2, 0, 0).x() - pose.positionMm(1, 0, 1).x(), 4.0, 1e-9);
}

}  // namespace
}  // namespace palpate::testing::emulated_geometry_test
