#include "palpate/calibration/drift_compensation.h"

#include "palpate/calibration/step_model.h"

#include "testing/testing.h"

namespace palpate::drift_compensation_test {
namespace {

// m = .02 K + .1 (T - 30)
Surface driftSurface() {
  std::vector<SurfacePoint> points;
  for (double k = 100.0; k <= 800.0; k += 100.0)
    for (const double t : {28.0, 36.0, 44.0}) points.push_back({k, t, 0.02 * k + 0.1 * (t - 30.0)});
  return fitSurface(points, {{0, 0}, {0, 1}, {1, 0}}, SurfaceSelection::kAllTerms);
}

TEST(DriftCompensation, TakesTheCreepOutAfterTheLag) {
  const Surface drift = driftSurface();
  DriftCompensation compensation({.steadyS = 2.0, .maxDurationS = 30.0});
  const StepParameters truth = StepParameters::ofTimes(400.0, 0.02 * 400.0 + 0.6, 0.3, 0.05);
  for (double t = 0.03; t < 20.0; t += 0.03) {
    const double gain = compensation.gainOf(drift, 100.0 + t, stepResponse(truth, t), 36.0);
    if (t < 1.9) {
      EXPECT_EQ(gain, stepResponse(truth, t)) << "within the lag as it is";
    }
    if (t > 2.1) {
      EXPECT_TRUE(compensation.compensating());
      EXPECT_NEAR(gain, 400.0, 1.5) << t;
    }
  }
}

TEST(DriftCompensation, BeginsAnewWithAnotherLoad) {
  const Surface drift = driftSurface();
  DriftCompensation compensation({.steadyS = 1.0});
  for (double t = 0.0; t < 5.0; t += 0.1) compensation.gainOf(drift, t, 300.0, 30.0);
  EXPECT_TRUE(compensation.compensating());
  compensation.gainOf(drift, 5.0, 500.0, 30.0);
  EXPECT_EQ(compensation.gainOf(drift, 5.12, 500.0, 30.0), 500.0);
  EXPECT_FALSE(compensation.compensating());
  for (double t = 5.2; t < 9.0; t += 0.1) compensation.gainOf(drift, t, 500.0, 30.0);
  EXPECT_TRUE(compensation.compensating());
  EXPECT_EQ(compensation.gainOf(drift, 9.1, 0.0, 30.0), 0.0);
  EXPECT_EQ(compensation.gainOf(drift, 9.25, 0.0, 30.0), 0.0);
  EXPECT_EQ(compensation.gainOf(drift, 9.3, 500.0, 30.0), 500.0) << "a new contact";
}

// As real recordings have it: one frame of 665 among readings of 807, one of 0.
TEST(DriftCompensation, ASingleFrameThatJumpsIsNoNewLoad) {
  const Surface drift = driftSurface();
  DriftCompensation compensation({.steadyS = 1.0});
  for (double t = 0.0; t < 5.0; t += 0.03) compensation.gainOf(drift, t, 400.0, 30.0);
  const double before = compensation.gainOf(drift, 5.0, 400.0, 30.0);
  compensation.gainOf(drift, 5.03, 310.0, 30.0);
  EXPECT_NEAR(compensation.gainOf(drift, 5.06, 400.0, 30.0), before, 1.0);
  EXPECT_EQ(compensation.gainOf(drift, 5.09, 0.0, 30.0), 0.0);
  EXPECT_NEAR(compensation.gainOf(drift, 5.12, 400.0, 30.0), before, 1.0);
}

TEST(DriftCompensation, StopsWhereCreepWasNotMeasuredAnyMore) {
  const Surface drift = driftSurface();
  DriftCompensation compensation({.steadyS = 1.0, .maxDurationS = 10.0});
  double gain = 0.0;
  for (double t = 0.0; t < 1000.0; t += 0.5) gain = compensation.gainOf(drift, t, 400.0, 30.0);
  // K + .02 K * 10 = 400
  EXPECT_NEAR(gain, 400.0 / 1.2, 1.0);
}

TEST(DriftCompensation, SaysThatALoadIsOlderThanTheFirstReading) {
  const Surface drift = driftSurface();
  DriftCompensation compensation({.steadyS = 1.0, .maxDurationS = 10.0});
  compensation.gainOf(drift, 0.0, 400.0, 30.0);
  EXPECT_TRUE(compensation.startUnknown());
  for (double t = 0.1; t < 9.95; t += 0.1) {
    compensation.gainOf(drift, t, 400.0, 30.0);
    EXPECT_TRUE(compensation.startUnknown()) << t;
  }
  compensation.gainOf(drift, 10.1, 400.0, 30.0);
  EXPECT_FALSE(compensation.startUnknown()) << "creep has ended, whenever the load began";
  compensation.reset();
  compensation.gainOf(drift, 11.0, 400.0, 30.0);
  EXPECT_TRUE(compensation.startUnknown());
  compensation.gainOf(drift, 13.0, 600.0, 30.0);
  compensation.gainOf(drift, 13.2, 600.0, 30.0);
  EXPECT_FALSE(compensation.startUnknown()) << "the start of the new load was seen";
  compensation.gainOf(drift, 14.0, 0.0, 30.0);
  compensation.gainOf(drift, 14.2, 0.0, 30.0);
  compensation.gainOf(drift, 15.0, 600.0, 30.0);
  EXPECT_FALSE(compensation.startUnknown()) << "so was the start of the next contact";
}

TEST(DriftCompensation, KnowsTheStartOfALoadAfterAnUnloadedReading) {
  DriftCompensation compensation({.steadyS = 1.0});
  compensation.gainOf(driftSurface(), 0.0, 0.0, 30.0);
  compensation.gainOf(driftSurface(), 0.1, 400.0, 30.0);
  EXPECT_FALSE(compensation.startUnknown());
}

TEST(DriftCompensation, LeavesTheReadingWhereDriftIsNotKnown) {
  DriftCompensation compensation({.steadyS = 1.0});
  for (double t = 0.0; t < 5.0; t += 0.5) EXPECT_EQ(compensation.gainOf({}, t, 400.0, 30.0), 400.0);
  EXPECT_FALSE(compensation.compensating());
}

}  // namespace
}  // namespace palpate::drift_compensation_test
