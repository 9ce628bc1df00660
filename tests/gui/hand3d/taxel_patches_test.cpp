#include "gui/hand3d/taxel_patches.h"

#include <Eigen/Geometry>

#include "palpate/device/sdh2.h"

#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::gui::taxel_patches_test {
namespace {

Eigen::Vector3f facing(const TaxelPatch& patch) {
  return (patch.cornersMm[1] - patch.cornersMm[0]).cross(patch.cornersMm[2] - patch.cornersMm[0]);
}

float areaMm2(const TaxelPatch& patch) {
  const auto& at = patch.cornersMm;
  return 0.5F * ((at[1] - at[0]).cross(at[2] - at[0]).norm() +
                 (at[2] - at[0]).cross(at[3] - at[0]).norm());
}

TEST(TaxelPatches, OnTheHandTheyFaceOutwardsAroundTheirCentre) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose({30.0, -10.0, 20.0, -25.0, 40.0, -5.0, 15.0});
  TaxelPatches patches;
  patchesOnHand(pose, *sdh2().layout, patches);
  ASSERT_EQ(patches.size(), 486u);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const TaxelPatch& patch = patches[i];
    EXPECT_LT((patch.centreMm.cast<double>() - pose.positionsMm()[i]).norm(), 1e-4);
    EXPECT_GT(facing(patch).normalized().dot(patch.normal), 0.99F) << i;
    // 3.4 x 3.4 mm; a chord of the bent fingertip is a little shorter than its arc.
    EXPECT_NEAR(areaMm2(patch), 11.56F, 0.01F) << i;
    const Eigen::Vector3f middle =
        (patch.cornersMm[0] + patch.cornersMm[1] + patch.cornersMm[2] + patch.cornersMm[3]) / 4.0F;
    EXPECT_LT((middle - patch.centreMm).norm(), 0.05F);
    EXPECT_NEAR(patch.alongX.dot(patch.alongY), 0.0F, 1e-3F);
    EXPECT_NEAR(patch.alongX.norm(), 1.0F, 1e-5F);
  }
}

TEST(TaxelPatches, TheirAxesPointToTheNextColumnAndTheNextRow) {
  const HandGeometry geometry(sdh2Geometry());
  TaxelPatches patches;
  patchesOnHand(
      geometry.pose({0.0, -10.0, 20.0, -10.0, 20.0, -10.0, 20.0}), *sdh2().layout, patches);
  const SensorLayout& layout = *sdh2().layout;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const int columns = layout.matrix(m).columns;
    const auto at = [&](int y, int x) -> const TaxelPatch& {
      return patches[layout.offset(m) + static_cast<std::size_t>(y * columns + x)];
    };
    EXPECT_GT((at(6, 3).centreMm - at(6, 2).centreMm).dot(at(6, 2).alongX), 3.0F) << m;
    EXPECT_GT((at(7, 2).centreMm - at(6, 2).centreMm).dot(at(6, 2).alongY), 3.0F) << m;
  }
}

TEST(TaxelPatches, LaidFlatTheyLieLikeTheHeatMaps) {
  TaxelPatches patches;
  patchesLaidFlat(sdh2(), patches);
  ASSERT_EQ(patches.size(), 486u);
  const SensorLayout& layout = *sdh2().layout;
  const auto at = [&](std::size_t m, int y, int x) {
    return patches[layout.offset(m) + static_cast<std::size_t>(y * layout.matrix(m).columns + x)]
        .centreMm;
  };
  EXPECT_NEAR((at(1, 0, 1) - at(1, 0, 0)).x(), 3.4F, 1e-5F);
  EXPECT_NEAR((at(1, 1, 0) - at(1, 0, 0)).y(), -3.4F, 1e-5F);  // the fingertip is on top
  EXPECT_GT(at(1, 12, 0).y(), at(0, 0, 0).y());                // distal above proximal
  EXPECT_FLOAT_EQ(at(1, 0, 0).x(), at(0, 0, 0).x());
  EXPECT_LT(at(1, 0, 5).x(), at(3, 0, 0).x());  // finger 0 left of finger 1
  Eigen::Vector3f least = patches[0].centreMm, most = least;
  for (const TaxelPatch& patch : patches) {
    least = least.cwiseMin(patch.centreMm);
    most = most.cwiseMax(patch.centreMm);
    EXPECT_GT(facing(patch).z(), 0.0F);
    EXPECT_EQ(patch.normal, Eigen::Vector3f::UnitZ());
    EXPECT_EQ(patch.alongX, Eigen::Vector3f::UnitX());
    EXPECT_EQ(patch.alongY, Eigen::Vector3f(-Eigen::Vector3f::UnitY()));
  }
  EXPECT_NEAR(least.x(), -most.x(), 1e-4F);  // around the origin
  EXPECT_NEAR(least.y(), -most.y(), 1e-4F);
}

}  // namespace
}  // namespace palpate::gui::taxel_patches_test
