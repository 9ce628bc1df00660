#include "palpate/slip/slip_detector.h"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/laboratory/synthetic_slip.h"

namespace palpate::slip_detector_test {
namespace {

constexpr std::int64_t kFrameUs = 31'500;

struct Watch {
  explicit Watch(const SlipDetectorOptions& options = {},
                 std::int64_t frameUs = kFrameUs,
                 const SyntheticSensor& sensor = {})
      : slip(sensor, 1),
        detector(sensor.layout, options),
        values(MatrixValues::Zero(sensor.layout.rows, sensor.layout.columns)),
        stepUs(frameUs) {}
  const SlipDetection& read(const SyntheticContact& contact) {
    slip.read(contact, MatrixMap(values.data(), values.rows(), values.cols()));
    return next();
  }
  const SlipDetection& nothing() {
    values.setZero();
    return next();
  }
  const SlipDetection& next() {
    timeUs += stepUs;
    return detector.update(ConstMatrixMap(values.data(), values.rows(), values.cols()), timeUs);
  }
  void rest(int frames, const SyntheticContact& contact = {}) {
    for (int i = 0; i < frames; ++i) read(contact);
  }

  SyntheticSlip slip;
  SlipDetector detector;
  MatrixValues values;
  std::int64_t stepUs;
  std::int64_t timeUs = 1'400'000'000'000'000;
};

TEST(SlipDetector, IsReadyOnceAContactSettledAndStill) {
  Watch watch;
  EXPECT_EQ(watch.nothing().indicator, SlipIndicator::kNotComputable);
  EXPECT_EQ(watch.read({}).state, SlipState::kInvalid);
  watch.rest(40);
  const SlipDetection& detection = watch.detector.last();
  EXPECT_EQ(detection.indicator, SlipIndicator::kReady);
  EXPECT_EQ(detection.state, SlipState::kStill);
  EXPECT_GT(detection.confidence, 0.8);
  EXPECT_TRUE(detection.motion.refValid);
  EXPECT_NEAR(detection.motion.refDx, 0.0, 0.02);
}

// The windows use a contact from its 9th frame on; the sequential test needs no settled contact.
TEST(SlipDetector, FindsASlipThatBeginsWithTheContact) {
  SlipDetector detector(MatrixLayout::full(14, 6, 3.4));
  SlipDetector resting(MatrixLayout::full(14, 6, 3.4));
  SlipRuleOptions windowsOnly;
  windowsOnly.sequence.threshold = 1e9;
  SlipDetector without(MatrixLayout::full(14, 6, 3.4), {.rule = windowsOnly});
  SyntheticSlip slip(SyntheticSensor{}, 5);
  SyntheticSlip rest(SyntheticSensor{}, 6);
  MatrixValues moving(14, 6);
  MatrixValues still(14, 6);
  bool found = false;
  for (int i = 0; i < 8; ++i) {
    slip.read({.y = 3.0 + 0.7 * i}, MatrixMap(moving.data(), 14, 6));
    rest.read({.y = 3.0}, MatrixMap(still.data(), 14, 6));
    const ConstMatrixMap view(moving.data(), 14, 6);
    const SlipDetection& detection = detector.update(view, (i + 1) * 31'500);
    EXPECT_EQ(detection.slipping, detection.state == SlipState::kSlip) << i;
    found = found || detection.slipping;
    EXPECT_FALSE(without.update(view, (i + 1) * 31'500).slipping) << i;
    EXPECT_FALSE(resting.update(ConstMatrixMap(still.data(), 14, 6), (i + 1) * 31'500).slipping)
        << i;
  }
  EXPECT_TRUE(found);
}

TEST(SlipDetector, FlagsSlipWithinThreeFramesAndHoldsIt) {
  Watch watch;
  watch.rest(40);
  int first = -1;
  for (int i = 1; i <= 8; ++i) {
    const SlipDetection& detection = watch.read({.y = 6.5 + 0.2 * i});
    if (detection.slipping && first < 0) first = i;
    if (first > 0) {
      EXPECT_TRUE(detection.slipping) << i;
      EXPECT_EQ(detection.indicator, SlipIndicator::kSlipping);
      EXPECT_EQ(detection.state, SlipState::kSlip);
    }
  }
  EXPECT_GE(first, 1);
  EXPECT_LE(first, 3);
  EXPECT_NEAR(watch.detector.last().motion.refDy, 1.6, 0.1);
  // The motion ends: the contact is at rest after the windows have passed, and a new reference is
  // taken.
  bool again = false;
  for (int i = 0; i < 40; ++i) again |= watch.read({.y = 8.1}).newReference;
  EXPECT_TRUE(again);
  EXPECT_FALSE(watch.detector.last().slipping);
  EXPECT_NEAR(watch.detector.last().motion.refDy, 0.0, 0.05);
}

TEST(SlipDetector, StepsAddUpToTheWay) {
  SlipDetectorOptions options;
  options.reference = SlipReference::kFirst;
  Watch watch(options);
  watch.rest(30);
  double way = 0.0;
  const double before = watch.detector.last().motion.refDx;
  for (int i = 1; i <= 20; ++i) way += watch.read({.x = 2.5 + 0.05 * i}).motion.dx;
  EXPECT_NEAR(way, watch.detector.last().motion.refDx - before, 1e-9);
  EXPECT_NEAR(way, 1.0, 0.1);
}

TEST(SlipDetector, CallsATiltALoadShiftNotSlip) {
  SlipDetectorOptions options;
  options.rule.stepTaxels = 0.1;  // so that the shift of the centroid, 0.23 taxel, would be enough
  Watch watch(options);
  watch.rest(40, {.shape = SlipShape::kBar});
  std::set<SlipState> states;
  for (int i = 1; i <= 30; ++i) {
    const SlipDetection& detection =
        watch.read({.shape = SlipShape::kBar, .tiltY = 0.4 * std::min(1.0, i / 3.0)});
    states.insert(detection.state);
    EXPECT_FALSE(detection.slipping);
    EXPECT_LT(std::hypot(detection.motion.refDx, detection.motion.refDy), 0.1) << i;
  }
  EXPECT_TRUE(states.contains(SlipState::kLoadShift));
}

TEST(SlipDetector, CallsAShiftOfARisingLoadLoading) {
  Watch watch;
  watch.rest(40);
  std::set<SlipState> states;
  for (int i = 1; i <= 4; ++i) {  // 30 % per frame more, and 0.15 taxel
    const SlipDetection& detection =
        watch.read({.y = 6.5 + 0.15 * i, .peakCounts = 1500.0 * std::pow(1.2, i)});
    states.insert(detection.state);
    EXPECT_FALSE(detection.slipping);
  }
  EXPECT_TRUE(states.contains(SlipState::kLoading));
}

TEST(SlipDetector, ForgetsWhenContactIsLostAndRegained) {
  Watch watch;
  watch.rest(40);
  EXPECT_EQ(watch.nothing().indicator, SlipIndicator::kNotComputable);
  const SlipDetection& back = watch.read({.y = 9.0});
  EXPECT_FALSE(back.motion.valid);
  EXPECT_FALSE(back.motion.refValid);
  EXPECT_FALSE(back.slipping);
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(watch.read({.y = 9.0}).slipping);
  EXPECT_TRUE(watch.detector.last().motion.refValid);
  EXPECT_NEAR(watch.detector.last().motion.refDy, 0.0, 0.05);
}

TEST(SlipDetector, AGapIsNoSlip) {
  Watch watch;
  watch.rest(40);
  watch.timeUs += 147'000'000;
  const SlipDetection& detection = watch.read({.y = 8.5});
  EXPECT_TRUE(detection.motion.afterGap);
  EXPECT_FALSE(detection.motion.valid);
  EXPECT_FALSE(detection.slipping);
  EXPECT_EQ(detection.indicator, SlipIndicator::kNotComputable);
}

// 6 taxels per second are slip at any frame rate: 0.02 per frame at 300 Hz. At 0.3 Hz, 0.2 per
// frame are slip.
TEST(SlipDetector, WatchesAtAnyRate) {
  for (const auto& [rateHz, step] :
       {std::pair{0.3, 0.2}, {3.0, 0.2}, {31.7, 0.2}, {74.0, 0.081}, {300.0, 0.02}}) {
    Watch watch({}, static_cast<std::int64_t>(1e6 / rateHz));
    watch.rest(rateHz > 50.0 ? static_cast<int>(1.5 * rateHz) : 40);
    EXPECT_EQ(watch.detector.last().indicator, SlipIndicator::kReady) << rateHz;
    int first = -1;
    for (int i = 1; i * step <= 2.0; ++i)
      if (watch.read({.y = 6.5 + step * i}).slipping && first < 0) first = i;
    ASSERT_GT(first, 0) << rateHz;
    EXPECT_LE(first, rateHz > 50.0 ? static_cast<int>(0.12 * rateHz) : 3) << rateHz;
  }
}

TEST(SlipDetector, KnowsNothingOfTooLittle) {
  Watch watch;
  for (int i = 0; i < 60; ++i) {
    watch.values.setZero();
    watch.values(i % 14, 2) = 2000.0F;  // a single taxel that jumps
    const SlipDetection& detection = watch.next();
    EXPECT_FALSE(detection.motion.valid);
    EXPECT_EQ(detection.state, SlipState::kInvalid);
    EXPECT_FALSE(detection.slipping);
  }
}

TEST(SlipDetector, StandsSaturatedMaskedAndBrokenTaxels) {
  SyntheticSensor sensor;
  sensor.layout.staticMask[static_cast<std::size_t>(6 * 6 + 2)] = 0;
  sensor.layout.dynamicMask[static_cast<std::size_t>(8 * 6 + 3)] = 0;
  SlipDetectorOptions options;
  options.tracker.saturationCounts = 3500.0;
  options.windows.hypotheses.registration.saturationCounts = 3500.0;
  Watch watch(options, kFrameUs, sensor);
  for (int i = 0; i < 60; ++i) {
    const SlipDetection& detection = watch.read({.peakCounts = 9000.0});
    EXPECT_FALSE(detection.slipping) << i;
  }
  EXPECT_GT(watch.detector.last().motion.saturated, 0);
  watch.values(5, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(watch.next().motion.refDx));
}

TEST(SlipDetector, SeveralBlobsMoveAsOne) {
  Watch watch;
  watch.rest(40, {.shape = SlipShape::kTwoBlobs});
  bool slipping = false;
  for (int i = 1; i <= 4; ++i)
    slipping |= watch.read({.shape = SlipShape::kTwoBlobs, .y = 6.5 + 0.2 * i}).slipping;
  EXPECT_TRUE(slipping);
}

TEST(SlipDetector, SeesItTurn) {
  Watch watch;
  watch.rest(40, {.shape = SlipShape::kBar});
  bool rotating = false;
  for (int i = 1; i <= 12; ++i)
    rotating |= watch.read({.shape = SlipShape::kBar, .angleDeg = 1.5 * i}).rotating;
  EXPECT_TRUE(rotating);
  EXPECT_NEAR(watch.detector.last().motion.rotation.refRotationDeg, 18.0, 2.0);
}

TEST(SlipDetector, PlainThresholdsAreThoseOfTheStudy) {
  SlipDetectorOptions options;
  options.method = SlipMethod::kCentroid;
  options.reference = SlipReference::kFirst;
  options.hypothesisAlarm = false;
  Watch watch(options);
  watch.rest(10);
  EXPECT_EQ(watch.detector.last().state, SlipState::kStill);
  EXPECT_FALSE(watch.detector.last().pMoved);
  EXPECT_TRUE(watch.read({.y = 6.8}).slipping);  // a step of 0.3
  for (int i = 0; i < 4; ++i) watch.read({.y = 6.8});
  EXPECT_FALSE(watch.detector.last().slipping);
  bool slipping = false;  // 0.1 per frame, until it is over 1 in all
  for (int i = 1; i <= 9; ++i) slipping |= watch.read({.y = 6.8 + 0.1 * i}).slipping;
  EXPECT_TRUE(slipping);
}

TEST(SlipDetector, ReferencesAreAsAskedFor) {
  SlipDetectorOptions options;
  options.reference = SlipReference::kGiven;
  Watch watch(options);
  watch.rest(30);
  EXPECT_FALSE(watch.detector.last().motion.refValid);
  watch.detector.setReference();
  for (int i = 1; i <= 10; ++i) watch.read({.y = 6.5 + 0.1 * i});
  EXPECT_NEAR(watch.detector.last().motion.refDy, 1.0, 0.1);
  watch.detector.clearReference();
  EXPECT_FALSE(watch.read({.y = 7.5}).motion.refValid);
}

TEST(SlipDetector, RefusesOtherSizes) {
  Watch watch;
  const MatrixValues other = MatrixValues::Zero(13, 6);
  EXPECT_THROW(watch.detector.update(ConstMatrixMap(other.data(), 13, 6), 0),
               std::invalid_argument);
}

TEST(SlipDetector, AMatrixWithItsOwnFullScaleIsRelativeToThat) {
  HandDescription hand =
      describeHand(SensorLayout({SyntheticSensor{}.layout, SyntheticSensor{}.layout}), 0, 0);
  hand.maximumCounts = hand.saturationCounts = 4095.0F;
  hand.matrices[1].maximumCounts = 1023.75F;
  hand.matrices[1].saturationCounts = 1000.0F;
  EXPECT_EQ(withScaleOf(hand, 0, {}).countsScale, 1.0);
  EXPECT_EQ(withScaleOf(hand, 1, {}).countsScale, 4.0);
  EXPECT_EQ(withScaleOf(hand, 1, {}).tracker.saturationCounts, 4000.0);
  EXPECT_EQ(withScaleOf(hand, 1, {}).windows.hypotheses.registration.saturationCounts, 4000.0);
  const std::vector<SlipDetector> detectors = slipDetectors(hand);
  ASSERT_EQ(detectors.size(), 2U);
  EXPECT_EQ(detectors[0].options().countsScale, 1.0);
  EXPECT_EQ(detectors[1].options().countsScale, 4.0);
}

// The same contact on a hand with another full scale gives the same motion and the same alarm.
TEST(SlipDetector, ReadingsAreRelativeToTheFullScaleOfTheHand) {
  for (const float fullScale : {1023.0F, 40.0F, 65'535.0F}) {
    HandDescription hand = describeHand(SensorLayout({SyntheticSensor{}.layout}), 0, 0);
    hand.maximumCounts = hand.saturationCounts = fullScale;
    const SlipDetectorOptions options = withScaleOf(hand, 0, {});
    EXPECT_NEAR(options.tracker.saturationCounts, 4095.0, 1e-3);
    Watch usual;
    SlipDetector other(usual.slip.sensor().layout, options);
    bool alarmed = false;
    for (int i = 0; i < 60; ++i) {
      SyntheticContact contact;
      if (i > 40) contact.y -= 0.2 * (i - 40);
      const SlipDetection& expected = usual.read(contact);
      const MatrixValues scaled = usual.values * (fullScale / 4095.0F);
      const SlipDetection& found =
          other.update(ConstMatrixMap(scaled.data(), scaled.rows(), scaled.cols()), usual.timeUs);
      ASSERT_EQ(found.state, expected.state) << fullScale << " frame " << i;
      EXPECT_EQ(found.alarm, expected.alarm) << fullScale << " frame " << i;
      EXPECT_NEAR(found.motion.refDy, expected.motion.refDy, 1e-3) << i;
      EXPECT_NEAR(found.motion.sum / static_cast<double>(fullScale),
                  expected.motion.sum / 4095.0,
                  1e-4 * expected.motion.sum / 4095.0);
      alarmed = alarmed || found.alarm;
    }
    EXPECT_TRUE(alarmed);
  }
  SlipDetectorOptions options;
  options.countsScale = 0.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::slip_detector_test
