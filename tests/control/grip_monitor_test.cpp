#include "palpate/control/grip_monitor.h"

#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"

#include "testing/testing.h"

namespace palpate::grip_monitor_test {
namespace {

// A contact on matrix 3 of the SDH-2.
struct Bench {
  SyntheticSlip slip;
  GripMonitor watch{sdh2()};
  SyntheticContact contact;
  std::int64_t stampUs = 1'000'000;

  Bench() : slip(sensor()) {
    contact.shape = SlipShape::kFlatEllipse;
    contact.y = 6.0;
  }
  static SyntheticSensor sensor() {
    SyntheticSensor sensor;
    sensor.layout = sdh2().layout->matrix(3);
    return sensor;
  }
  void frame() {
    TactileFrame felt(sdh2().layout);
    felt.hostUs = stampUs += 31'500;
    slip.read(contact, felt.matrix(3));
    watch.onFrame(felt);
  }
};

TEST(GripMonitor, WhatRestsDoesNotSlip) {
  Bench bench;
  for (int i = 0; i < 10; ++i) bench.frame();
  EXPECT_FALSE(bench.watch.slip().has_value());  // no reference yet
  bench.watch.setReference();
  for (int i = 0; i < 100; ++i) {
    bench.contact.peakCounts *= 1.002;  // with more force
    bench.frame();
    EXPECT_FALSE(bench.watch.slip().has_value());
  }
  EXPECT_GT(bench.watch.sumCounts(), 1000.0);
}

TEST(GripMonitor, TellsWhereItSlips) {
  Bench bench;
  for (int i = 0; i < 5; ++i) bench.frame();
  bench.watch.setReference();
  for (int i = 0; i < 7 && !bench.watch.slip(); ++i) {
    bench.contact.y += 0.1;
    bench.frame();
  }
  const auto slip = bench.watch.slip();
  ASSERT_TRUE(slip.has_value());
  EXPECT_EQ(slip->matrix, 3U);
  EXPECT_NEAR(slip->motion.refDy, bench.contact.y - 6.0, 0.05);
  EXPECT_NE(slip->why.find("finger 1 distal"), std::string::npos) << slip->why;
}

TEST(GripMonitor, ASuddenStepCountsInTheSecondFrame) {
  GripMonitorOptions options;
  options.referenceTaxels = 50.0;
  Bench bench;
  bench.watch = GripMonitor(sdh2(), options);
  for (int i = 0; i < 5; ++i) bench.frame();
  bench.watch.setReference();
  bench.contact.y += 0.3;
  bench.frame();
  EXPECT_FALSE(bench.watch.slip().has_value());
  bench.contact.y += 0.3;
  bench.frame();
  EXPECT_TRUE(bench.watch.slip().has_value());
}

TEST(GripMonitor, TurningIsSlipping) {
  Bench bench;
  for (int i = 0; i < 5; ++i) bench.frame();
  bench.watch.setReference();
  for (int i = 0; i < 8; ++i) {
    bench.contact.angleDeg += 1.0;
    bench.frame();
  }
  ASSERT_TRUE(bench.watch.slip().has_value());
  EXPECT_NE(bench.watch.slip()->why.find("degrees"), std::string::npos);
}

TEST(GripMonitor, LittleLoadSaysNothing) {
  Bench bench;
  bench.contact.peakCounts = 160.0;  // some taxels over the threshold
  for (int i = 0; i < 5; ++i) bench.frame();
  bench.watch.setReference();
  bench.contact.y += 3.0;
  bench.frame();
  bench.frame();
  EXPECT_FALSE(bench.watch.slip().has_value());
  bench.watch.reset();
  EXPECT_FALSE(bench.watch.touches());
  GripMonitorOptions options;
  options.stepTaxels = 0.0;
  EXPECT_THROW(GripMonitor(sdh2(), options), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::grip_monitor_test
