#include "palpate/control/finger_forces.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

#include "calibration/sample_calibrations.h"

namespace palpate::finger_forces_test {
namespace {

const std::vector<MatrixSettings> kLikeTheCalibration(6, {0.5, 100});
Calibration calibration() { return testing::linearCalibration({0.5, 100.0, false}); }

TEST(FingerForces, OfAFingerAreTheSumOfItsMatrices) {
  FingerForces forces(calibration(), sdh2(), kLikeTheCalibration);
  EXPECT_EQ(forces.forcesN(), std::vector<double>(3, 0.0));
  TactileFrame frame(sdh2().layout);
  // Matrices 2 and 3 are those of finger 1; everywhere 500 counts.
  for (const std::size_t m : {std::size_t{2}, std::size_t{3}}) frame.matrix(m).setConstant(500.0F);
  forces.apply(frame, {});
  EXPECT_EQ(forces.forcesN()[0], 0.0);
  EXPECT_EQ(forces.forcesN()[2], 0.0);
  // P = 2 + 0.1 K [kPa], K = 500 counts; 84 and 78 taxels of 3.4 mm x 3.4 mm.
  EXPECT_NEAR(forces.forcesN()[1], 52.0 * (84 + 78) * 3.4 * 3.4 * 1e-3, 0.01);
}

TEST(FingerForces, AHalfSensitivityMeasuresTheSameForceByHalfTheCounts) {
  TactileFrame full(sdh2().layout), half(sdh2().layout);
  full.matrix(1).setConstant(600.0F);
  half.matrix(1).setConstant(300.0F);
  FingerForces at05(calibration(), sdh2(), kLikeTheCalibration);
  FingerForces at025(calibration(), sdh2(), std::vector<MatrixSettings>(6, {0.25, 100}));
  at05.apply(full, {});
  at025.apply(half, {});
  EXPECT_NEAR(at05.forcesN()[0], at025.forcesN()[0], 1e-6);
  EXPECT_GT(at05.forcesN()[0], 1.0);
}

TEST(FingerForces, TheLargestIsThatOfSaturation) {
  const FingerForces forces(calibration(), sdh2(), kLikeTheCalibration);
  const double taxels = static_cast<double>(sdh2().layout->matrix(0).numEnabled() +
                                            sdh2().layout->matrix(1).numEnabled());
  EXPECT_NEAR(forces.largestN(0), (2.0 + 0.1 * 3500.0) * taxels * 3.4 * 3.4 * 1e-3, 0.5);
  EXPECT_THROW(forces.largestN(3), std::out_of_range);
}

TEST(FingerForces, RefusesWhatCannotMeasure) {
  EXPECT_THROW(FingerForces({}, sdh2(), {}), std::invalid_argument);
  Calibration another = calibration();
  another.hand = "another hand";
  EXPECT_THROW(FingerForces(another, sdh2(), {}), std::invalid_argument);
  EXPECT_THROW(FingerForces(calibration(), sdh2(), std::vector<MatrixSettings>(6, {0.0, 100})),
               std::invalid_argument);
}

TEST(FingerForces, CountsTheFingers) { EXPECT_EQ(numFingers(sdh2()), 3u); }

}  // namespace
}  // namespace palpate::finger_forces_test
