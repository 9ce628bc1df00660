#include "palpate/slip/sensor_slip_detector.h"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"

namespace palpate::sensor_slip_detector_test {
namespace {

TEST(SensorSlipDetector, SaysWhichMatrixSlips) {
  const auto layout = sdh2().layout;
  SensorSlipDetector detector(*layout);
  SyntheticSensor sensor;
  sensor.layout = layout->matrix(5);
  SyntheticSlip slip(sensor, 1);
  bool other = false, slipped = false;
  for (int i = 0; i < 60; ++i) {
    TactileFrame frame(layout);
    frame.hostUs = 31'500 * i;
    slip.read({.y = 5.0 + 0.2 * std::max(0, i - 50)}, frame.matrix(5));
    slip.read({}, frame.matrix(1));
    const auto& detections = detector.update(frame);
    ASSERT_EQ(detections.size(), 6U);
    slipped |= detections[5].slipping;
    other |= detections[1].slipping || detections[0].slipping;
    EXPECT_EQ(detector.slipping(), detections[5].slipping);
  }
  EXPECT_TRUE(slipped);
  EXPECT_FALSE(other);
  detector.setReference();
  EXPECT_EQ(detector.last()[5].motion.refDy, detector.matrix(5).last().motion.refDy);
  detector.setOn(false);
  detector.reset();
  EXPECT_FALSE(detector.slipping());
}

TEST(SensorSlipDetector, RefusesOtherLayouts) {
  SensorSlipDetector detector(*sdh2().layout);
  EXPECT_THROW(detector.update(TactileFrame()), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sensor_slip_detector_test
