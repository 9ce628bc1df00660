#include "palpate/laboratory/slip_accuracy.h"

#include <cmath>

#include "palpate/core/error.h"
#include "palpate/slip/slip_method.h"

#include "slip/slip_scene.h"
#include "testing/testing.h"

namespace palpate::slip_accuracy_test {
namespace {

const MethodAccuracy& named(const std::vector<MethodAccuracy>& all, const std::string& name) {
  for (const MethodAccuracy& one : all)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

BenchmarkedMethod onlyRegister() {
  for (const BenchmarkedMethod& method : benchmarkedMethods())
    if (method.name == "register") return method;
  throw std::out_of_range("register");
}

// Targets, from the values in docs/notes/slip.md.
TEST(SlipAccuracy, RegisterIsNearTheBound) {
  for (const auto& [noise, most] : {std::pair{5.0, 1.2}, {20.0, 1.2}}) {
    SlipAccuracyOptions options;
    options.noiseSd = noise;
    const auto results = measureSlipAccuracy({onlyRegister()}, options);
    const SlipAccuracy& all = results.at(0).all;
    EXPECT_LT(all.rmse / all.crb, most) << noise;
    // A method that is better than the bound shows that the bound is wrong.
    EXPECT_GT(all.rmse / all.crb, 0.9) << noise;
    EXPECT_LT(all.drift100, noise > 10.0 ? 0.025 : 0.015) << noise;
    EXPECT_LT(all.driftDeg100, noise > 10.0 ? 0.95 : 0.6) << noise;
    EXPECT_LT(all.edge, 0.1) << noise;
    EXPECT_LT(std::abs(all.bias), 0.001) << noise;
    EXPECT_NEAR(all.gainX, 1.0, 0.01) << noise;
    EXPECT_NEAR(all.gainY, 1.0, 0.01) << noise;
    EXPECT_EQ(all.invalid, 0);
    EXPECT_EQ(results.at(0).shapes.size(), 6U);
  }
}

// The shape between the taxels is learned within ten frames, at edges of 0.35 taxel, too. From then
// on the motion since the reference stays within 0.02 taxel.
TEST(SlipAccuracy, RegisterLearnsSharpEdgesInTenFrames) {
  SlipAccuracyOptions options;
  options.sensor.coverTaxels = 0.35;
  const auto results = measureSlipAccuracy({onlyRegister()}, options);
  for (const ShapeAccuracy& one : results.at(0).shapes) {
    const SlipAccuracy& accuracy = one.accuracy;
    EXPECT_LT(accuracy.rmseLater, 1.3 * accuracy.crb) << nameOf(one.shape);
    for (const double drift : accuracy.drift) EXPECT_LT(drift, 0.02) << nameOf(one.shape);
  }
}

// The standard deviation that is given with a step is that of its errors. In the first ten frames
// it may be up to 2.5 times too large, never too small.
TEST(SlipAccuracy, RegisterKnowsItsAccuracy) {
  for (const double edge : {0.35, 0.6}) {
    SlipAccuracyOptions options;
    options.sensor.coverTaxels = edge;
    const auto results = measureSlipAccuracy({onlyRegister()}, options);
    for (const ShapeAccuracy& one : results.at(0).shapes) {
      EXPECT_GT(one.accuracy.normalisedFirst, 0.4) << nameOf(one.shape);
      EXPECT_LT(one.accuracy.normalisedFirst, 1.25) << nameOf(one.shape);
      EXPECT_GT(one.accuracy.normalisedLater, 0.8) << nameOf(one.shape);
      EXPECT_LT(one.accuracy.normalisedLater, 1.25) << nameOf(one.shape);
    }
  }
}

TEST(SlipAccuracy, JudgesByTheTruth) {
  // A method that always reports (0.05, 0) is wrong by that where the mean motion along x is 0.
  const BenchmarkedMethod fixed{"fixed", [](const MatrixLayout&) {
                                  return [](const ConstMatrixMap&) {
                                    SlipMotion motion;
                                    motion.x = 2.5;
                                    motion.y = 6.5;
                                    motion.valid = true;
                                    motion.refValid = true;
                                    motion.dx = 0.05;
                                    return motion;
                                  };
                                }};
  // A method that never reports a motion.
  const BenchmarkedMethod silent{"silent", [](const MatrixLayout&) {
                                   return [](const ConstMatrixMap&) { return SlipMotion{}; };
                                 }};
  SlipAccuracyOptions options;
  options.shapes = {SlipShape::kGaussian};
  options.trials = 4;
  const auto results = measureSlipAccuracy({fixed, silent}, options);
  const SlipAccuracy& wrong = results.at(0).all;
  // The steps themselves: 0.6 * 0.13 / sqrt 2 along x and 1.2 * 0.09 / sqrt 2 along y (rms),
  // uncorrelated with 0.05.
  const double x2 = std::pow(0.6 * 0.13, 2) / 2.0 + 0.05 * 0.05;
  const double y2 = std::pow(1.2 * 0.09, 2) / 2.0;
  EXPECT_NEAR(wrong.rmse, std::sqrt((x2 + y2) / 2.0), 0.01);
  EXPECT_NEAR(wrong.gainY, 0.0, 1e-12);
  EXPECT_NEAR(wrong.edge, 1.5, 1e-12);
  EXPECT_NEAR(wrong.tilt, 0.0, 1e-12);
  EXPECT_EQ(wrong.worstTiltX, 0.0);
  EXPECT_EQ(wrong.worstTiltY, 0.0);
  EXPECT_EQ(wrong.normalisedLater, 0.0);
  // All steps are those of the first ten frames and of the others.
  EXPECT_NEAR(10.0 * std::pow(wrong.rmseFirst, 2) + 90.0 * std::pow(wrong.rmseLater, 2),
              100.0 * std::pow(wrong.rmse, 2),
              1e-9);
  EXPECT_EQ(wrong.drift.back(), wrong.drift100);
  EXPECT_EQ(wrong.invalid, 0);
  EXPECT_EQ(wrong.steps, 400);
  EXPECT_EQ(results.at(1).all.invalid, 400);
  EXPECT_EQ(results.at(1).all.rmse, 0.0);
}

TEST(SlipAccuracy, IsReproducibleAndCanBeCancelled) {
  SlipAccuracyOptions options;
  options.trials = 1;
  options.shapes = {SlipShape::kBar};
  const auto first = measureSlipAccuracy(benchmarkedMethods(), options);
  const auto second = measureSlipAccuracy(benchmarkedMethods(), options);
  ASSERT_EQ(first.size(), slipMethods().size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(first[i].all.rmse, second[i].all.rmse) << first[i].name;
  options.seed = 2;
  EXPECT_NE(named(measureSlipAccuracy(benchmarkedMethods(), options), "centroid").all.rmse,
            named(first, "centroid").all.rmse);
  EXPECT_THROW(measureSlipAccuracy(benchmarkedMethods(), options, [](double) { return false; }),
               Cancelled);
  options.trials = 0;
  EXPECT_THROW(measureSlipAccuracy({}, options), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::slip_accuracy_test
