#include "palpate/slip/slip_hypotheses.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/laboratory/synthetic_slip.h"

namespace palpate::slip_hypotheses_test {
namespace {

constexpr std::array<RigidMotion, 1> kFromRest = {RigidMotion{}};

struct Pair {
  MatrixLayout layout = MatrixLayout::full(14, 6, 3.4);
  MatrixValues before = MatrixValues::Zero(14, 6);
  MatrixValues after = MatrixValues::Zero(14, 6);
  KeyFrame key{MatrixLayout::full(14, 6, 3.4)};
  ConstMatrixMap then() const { return {before.data(), before.rows(), before.cols()}; }
  ConstMatrixMap now() const { return {after.data(), after.rows(), after.cols()}; }
};

Pair pairOf(const SyntheticContact& before, const SyntheticContact& after, std::uint64_t seed = 1) {
  Pair pair;
  SyntheticSlip slip(SyntheticSensor{}, seed);
  slip.read(before, MatrixMap(pair.before.data(), 14, 6));
  slip.read(after, MatrixMap(pair.after.data(), 14, 6));
  pair.key.set(pair.then());
  return pair;
}

// A contact that touches every taxel: no taxel is below the threshold.
Pair everywhere() {
  Pair pair;
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x)
      pair.before(y, x) =
          400.0F +
          1000.0F * std::exp(-0.1F * static_cast<float>((x - 2) * (x - 2) + (y - 6) * (y - 6)));
  pair.key.set(pair.then());
  return pair;
}

TEST(LoadField, IsFoundExactlyWhereItHolds) {
  Pair pair = everywhere();
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x) {
      const double gain = 1.1 + 0.05 * (x - pair.key.centerX()) - 0.03 * (y - pair.key.centerY());
      pair.after(y, x) = pair.before(y, x) * static_cast<float>(gain);
    }
  const LoadFieldResult still = fitLoadField(pair.key, pair.now(), {});
  EXPECT_EQ(still.taxels, 84);
  EXPECT_NEAR(still.field.gain, 1.1, 1e-3);
  EXPECT_NEAR(still.field.alongX, 0.05, 1e-3);
  EXPECT_NEAR(still.field.alongY, -0.03, 1e-3);
  EXPECT_NEAR(still.residual, 0.0, 1e-2);
}

TEST(LoadField, HasNoGradientWhereTheContactHasNoExtent) {
  Pair pair;
  pair.before(6, 1) = 800.0F;
  pair.before(6, 2) = 900.0F;
  pair.after(6, 1) = 400.0F;
  pair.after(6, 2) = 450.0F;
  pair.key.set(pair.then());
  const LoadFieldResult still = fitLoadField(pair.key, pair.now(), {});
  EXPECT_NEAR(still.field.gain, 0.5, 0.05);
  EXPECT_NEAR(still.field.alongY, 0.0, 0.05);
}

TEST(LoadField, OfNothingIsNothing) {
  Pair pair = everywhere();
  pair.after.setZero();
  EXPECT_EQ(fitLoadField(pair.key, pair.now(), {}).taxels, 0);
  EXPECT_FALSE(compareSlipHypotheses(pair.key, pair.now(), kFromRest, {}).computed);
  pair.key.clear();
  EXPECT_EQ(fitLoadField(pair.key, pair.then(), {}).taxels, 0);
  EXPECT_FALSE(compareSlipHypotheses(pair.key, pair.then(), kFromRest, {}).computed);
}

// Computed by hand: ((0 + 1) / (3 + 1))^3 = 1/64 if the better hypothesis fits perfectly; ((39 + 1)
// / (9 + 1))^(3 / 1.9) otherwise.
TEST(Contest, WeighsResiduals) {
  const SlipHypothesisOptions options{.sharpness = 3.0, .misfit = 10.0};
  EXPECT_DOUBLE_EQ(motionScore(0.0, 0.0, options), 0.5);
  EXPECT_DOUBLE_EQ(motionScore(3.0, 0.0, options), 64.0 / 65.0);
  EXPECT_DOUBLE_EQ(motionScore(0.0, 3.0, options), 1.0 / 65.0);
  EXPECT_NEAR(motionScore(9.0, 39.0, options), 1.0 / (1.0 + std::pow(4.0, 3.0 / 1.9)), 1e-12);
}

TEST(Contest, MotionWinsWhenEdgedShapesMove) {
  for (const SlipShape shape : slipShapes())
    for (const double angle : {0.0, 1.0, 2.0, 4.0}) {
      const Pair pair = pairOf(
          {.shape = shape},
          {.shape = shape, .x = 2.5 + 0.8 * std::cos(angle), .y = 6.5 + 0.8 * std::sin(angle)});
      const SlipHypothesisResult result =
          compareSlipHypotheses(pair.key, pair.now(), kFromRest, {});
      ASSERT_TRUE(result.computed);
      EXPECT_GT(result.pMoved, 0.75) << nameOf(shape) << ' ' << angle;
      EXPECT_NEAR(result.motion.dx, 0.8 * std::cos(angle), 0.1) << nameOf(shape);
      EXPECT_NEAR(result.motion.dy, 0.8 * std::sin(angle), 0.1) << nameOf(shape);
    }
}

TEST(Contest, TheLoadFieldWinsWhenEdgedShapesTilt) {
  for (const SlipShape shape : slipShapes()) {
    const Pair pair = pairOf({.shape = shape}, {.shape = shape, .tiltY = 0.4});
    const SlipHypothesisResult result = compareSlipHypotheses(pair.key, pair.now(), kFromRest, {});
    ASSERT_TRUE(result.computed);
    EXPECT_LT(result.pMoved, hasEdge(shape) ? 0.1 : 0.5) << nameOf(shape);
    EXPECT_GT(result.field.alongY, 0.05) << nameOf(shape);
  }
}

TEST(Contest, TakesTheBestStart) {
  const Pair pair = pairOf({.y = 4.5}, {.y = 8.5});  // 4 taxels: from rest it is not found
  const std::array<RigidMotion, 2> starts = {RigidMotion{}, RigidMotion{.dy = 3.8}};
  const SlipHypothesisResult result = compareSlipHypotheses(pair.key, pair.now(), starts, {});
  EXPECT_NEAR(result.motion.dy, 4.0, 0.05);
  EXPECT_GT(result.pMoved, 0.9);
}

TEST(Contest, RefusesWhatItCannotCompare) {
  Pair pair = everywhere();
  const MatrixValues other = MatrixValues::Zero(13, 6);
  EXPECT_THROW(compareSlipHypotheses(pair.key, ConstMatrixMap(other.data(), 13, 6), kFromRest, {}),
               std::invalid_argument);
  KeyFrame blurred(pair.layout, {.blurTaxels = 0.6});
  blurred.set(pair.then());
  EXPECT_THROW(compareSlipHypotheses(blurred, pair.then(), kFromRest, {}), std::invalid_argument);
  EXPECT_THROW(SlipHypothesisOptions{.sharpness = 0.0}.validate(), std::invalid_argument);
  EXPECT_THROW(SlipHypothesisOptions{.misfit = -1.0}.validate(), std::invalid_argument);
}

TEST(MotionSdInflation, SaysWhichShapesCannotTell) {
  const RegistrationOptions options = SlipHypothesisOptions{}.registration;
  for (const SlipShape shape : slipShapes())
    for (const double x : {2.5, 2.8, 3.0}) {
      const Pair pair = pairOf({.shape = shape, .x = x}, {.shape = shape, .x = x});
      const MotionSdInflation condition = motionSdInflation(pair.key, options);
      EXPECT_GE(std::min(condition.x, condition.y), 1.0) << nameOf(shape);
      if (hasEdge(shape)) {
        EXPECT_LT(std::max(condition.x, condition.y), kMaxMotionSdInflation) << nameOf(shape);
      } else if (shape != SlipShape::kTwoBlobs) {
        EXPECT_GT(std::max(condition.x, condition.y), kMaxMotionSdInflation) << nameOf(shape);
      }
    }
  EXPECT_EQ(motionSdInflation(KeyFrame(MatrixLayout::full(14, 6, 3.4)), options).x,
            kUnboundedMotionSdInflation);
}

}  // namespace
}  // namespace palpate::slip_hypotheses_test
