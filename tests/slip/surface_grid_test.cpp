#include "palpate/slip/surface_grid.h"

#include <stdexcept>
#include <vector>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::surface_grid_test {
namespace {

using testing::reading;
using testing::viewOf;

// The finer spline is the same function as that of the key frame, whatever the border.
TEST(SurfaceGrid, BeginsAsTheSurfaceOfTheKeyFrame) {
  SyntheticSlip slip({}, 3);
  const MatrixValues values = reading(slip, {});
  KeyFrame key(slip.sensor().layout);
  ASSERT_TRUE(key.set(viewOf(values)));
  for (const int border : {0, 3}) {
    SurfaceGrid grid(slip.sensor().layout, border);
    grid.begin(key, std::vector<float>(84, 25.0F), 1600.0F, {1e4F, 100.0F});
    for (float y = 1.0F; y <= 12.0F; y += 0.37F)
      for (float x = 1.0F; x <= 4.0F; x += 0.29F) {
        const KeyFrame::Sample expected = key.at(x, y);
        const SurfaceGrid::Sample sample = grid.at(x, y);
        EXPECT_NEAR(sample.value, expected.value, 0.1F) << x << " " << y;
        EXPECT_NEAR(sample.alongX, expected.alongX, 0.5F) << x << " " << y;
        EXPECT_NEAR(sample.alongY, expected.alongY, 0.5F) << x << " " << y;
        // Of a mean of independent values.
        EXPECT_LT(sample.variance, 25.0F);
        EXPECT_GT(sample.variance, 0.0F);
      }
    // Beyond a silent side less is unknown than beyond a side with load.
    EXPECT_GT(grid.at(2.5F, -2.0F).variance, grid.at(2.5F, 6.0F).variance);
    EXPECT_LT(grid.at(2.5F, -2.0F).variance, 125.0F);
  }
}

TEST(SurfaceGrid, FindsTheCoefficientsOfAPlace) {
  const SurfaceGrid grid(MatrixLayout::full(14, 6, 3.4), 3);
  EXPECT_EQ(grid.columns(), 2 * 6 + 2 * 8);
  EXPECT_EQ(grid.rows(), 2 * 14 + 2 * 8);
  // The first of four knots lies one before the place; two taxels of margin, the reach of the
  // spline and the border lie before the first taxel.
  EXPECT_EQ(grid.cornerOf(0, 0), 7 * grid.columns() + 7);
  EXPECT_EQ(grid.cornerOf(-4, 3) - grid.cornerOf(0, 0), 3 - 4 * grid.columns());
  EXPECT_THROW(SurfaceGrid(MatrixLayout::full(14, 6, 3.4), -1), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::surface_grid_test
