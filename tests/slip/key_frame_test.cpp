#include "palpate/slip/key_frame.h"

#include <cmath>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::key_frame_test {
namespace {

using testing::reading;
using testing::viewOf;

TEST(KeyFrame, GoesThroughItsTaxels) {
  SyntheticSlip slip({});
  const MatrixValues values = reading(slip, {});
  KeyFrame key(slip.sensor().layout);
  ASSERT_TRUE(key.set(viewOf(values)));
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x) {
      if (values(y, x) == 0.0F) continue;
      const KeyFrame::Sample sample = key.at(static_cast<float>(x), static_cast<float>(y));
      EXPECT_NEAR(static_cast<double>(sample.value), static_cast<double>(values(y, x)), 0.05);
      EXPECT_EQ(sample.unknown, 0.0F);
    }
}

// A cubic spline represents a parabola exactly. Two places beyond the edges it is mirrored, which
// leaves an error of half a count.
TEST(KeyFrame, IsExactForAParabola) {
  const MatrixLayout layout = MatrixLayout::full(14, 6, 3.4);
  const auto surface = [](double x, double y) {
    return 900.0 - 3.0 * x * x + 2.0 * x * y + 11.0 * y - 2.0 * y * y;
  };
  MatrixValues values(14, 6);
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x) values(y, x) = static_cast<float>(surface(x, y));
  KeyFrame key(layout);
  ASSERT_TRUE(key.set(viewOf(values)));
  for (const auto& [x, y] : {std::pair{0.3F, 0.6F}, {2.5F, 7.25F}, {4.9F, 12.8F}, {0.0F, 5.5F}}) {
    const KeyFrame::Sample sample = key.at(x, y);
    const auto dx = static_cast<double>(x);
    const auto dy = static_cast<double>(y);
    EXPECT_NEAR(static_cast<double>(sample.value), surface(dx, dy), 0.6);
    EXPECT_NEAR(static_cast<double>(sample.alongX), -6.0 * dx + 2.0 * dy, 2.0);
    EXPECT_NEAR(static_cast<double>(sample.alongY), 2.0 * dx + 11.0 - 4.0 * dy, 2.0);
  }
}

TEST(KeyFrame, SlopesAreThoseOfItsValues) {
  SyntheticSlip slip({});
  KeyFrame key(slip.sensor().layout);
  ASSERT_TRUE(key.set(viewOf(reading(slip, {}))));
  for (const auto& [x, y] : {std::pair{1.3F, 4.6F}, {2.5F, 7.25F}, {3.9F, 8.1F}}) {
    const float h = 0.01F;
    const KeyFrame::Sample sample = key.at(x, y);
    EXPECT_NEAR(sample.alongX, (key.at(x + h, y).value - key.at(x - h, y).value) / (2 * h), 2.0);
    EXPECT_NEAR(sample.alongY, (key.at(x, y + h).value - key.at(x, y - h).value) / (2 * h), 2.0);
  }
}

TEST(KeyFrame, KnowsWhatItDoesNotKnow) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  values(6, 2) = 800.0F;
  values(6, 3) = 300.0F;
  KeyFrame key(MatrixLayout::full(14, 6, 3.4));
  ASSERT_TRUE(key.set(viewOf(values)));
  EXPECT_EQ(key.minCounts(), 300.0F);
  EXPECT_EQ(key.at(2.0F, 6.0F).unknown, 0.0F);
  EXPECT_EQ(key.at(1.0F, 6.0F).unknown, 1.0F);
  EXPECT_NEAR(key.at(1.0F, 6.0F).value, 0.4F * 300.0F, 0.1F);
  // Far from the contact a reading of 0 is a known value.
  EXPECT_EQ(key.at(2.0F, 10.0F).unknown, 0.0F);
  EXPECT_NEAR(key.at(2.5F, 6.0F).unknown, 0.0F, 1e-6F);
  EXPECT_NEAR(key.at(1.5F, 6.0F).unknown, 0.5F, 1e-6F);
}

TEST(KeyFrame, RoundContactsTellNoAngle) {
  SyntheticSlip slip({});
  KeyFrame key(slip.sensor().layout);
  for (const SlipShape shape : slipShapes()) {
    SyntheticContact contact;
    contact.shape = shape;
    ASSERT_TRUE(key.set(viewOf(reading(slip, contact))));
    if (hasOrientation(shape))
      EXPECT_GT(key.rotationSensitivity(), 0.1F) << nameOf(shape);
    else
      EXPECT_LT(key.rotationSensitivity(), 0.03F) << nameOf(shape);
  }
}

TEST(KeyFrame, SmoothingKeepsASumAndLeavesMasksOut) {
  MatrixLayout layout = MatrixLayout::full(5, 5, 3.4);
  MatrixValues values = MatrixValues::Zero(5, 5);
  values(2, 2) = 1000.0F;
  MatrixValues out(5, 5);
  smoothMatrix(layout, 0.6, values.data(), out.data());
  const double side = std::exp(-0.5 / 0.36);
  const double all = (1 + 2 * side) * (1 + 2 * side);
  EXPECT_NEAR(static_cast<double>(out(2, 2)), 1000.0 / all, 0.01);
  EXPECT_NEAR(static_cast<double>(out(1, 2)), 1000.0 * side / all, 0.01);
  EXPECT_NEAR(static_cast<double>(out(3, 3)), 1000.0 * side * side / all, 0.01);
  EXPECT_EQ(out(0, 2), 0.0F);
  layout.dynamicMask[2 * 5 + 2] = 0;
  smoothMatrix(layout, 0.6, values.data(), out.data());
  EXPECT_EQ(out.maxCoeff(), 0.0F);
  smoothMatrix(layout, 0.0, values.data(), out.data());
  EXPECT_EQ(out.maxCoeff(), 0.0F);
}

TEST(KeyFrame, RefusesWrongSettings) {
  KeyFrameOptions options;
  options.blurTaxels = 3.0;
  EXPECT_THROW(KeyFrame(MatrixLayout::full(2, 2, 1.0), options), std::invalid_argument);
  options = {};
  options.fillOfThreshold = -0.1;
  EXPECT_THROW(KeyFrame(MatrixLayout::full(2, 2, 1.0), options), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::key_frame_test
