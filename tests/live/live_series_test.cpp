#include "palpate/live/live_series.h"

#include <cmath>

#include "palpate/calibration/pressure_map.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::live_series_test {
namespace {

constexpr std::int64_t kBeginUs = 1'400'000'000'000'000;

LiveResults resultsAt(double atS, double mean = 0.0) {
  auto frame = std::make_shared<TactileFrame>(sdh2().layout);
  frame->hostUs = kBeginUs + std::llround(atS * 1e6);
  LiveResults results;
  results.frame = std::move(frame);
  results.matrixSignals.resize(6);
  results.matrixSignals[2].mean = mean;
  results.wholeSignals.mean = mean / 2.0;
  return results;
}

SeriesChoice ofMatrix(std::size_t index) {
  return {.kind = SeriesChoice::Kind::kMatrix, .index = index, .signal = SignalKind::kMean};
}

TEST(LiveSeries, HasTheValuesOfEverySample) {
  SignalHistory history;
  LiveSeries series;
  series.setHistory(&history);
  series.setWanted({ofMatrix(2), ofMatrix(6)});
  for (int i = 0; i < 10; ++i) history.add(resultsAt(0.1 * i, i));
  EXPECT_EQ(series.update(), 10u);
  EXPECT_EQ(series.update(), 0u);
  EXPECT_EQ(series.numSamples(), 10u);
  EXPECT_DOUBLE_EQ(series.oldestS(), 0.0);
  EXPECT_NEAR(series.newestS(), 0.9, 1e-9);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 0.35), 3.0) << "the last one at or before";
  EXPECT_EQ(series.valueAt(ofMatrix(6), 0.35), 1.5);
  EXPECT_EQ(series.valueAt(ofMatrix(2), -0.1), std::nullopt);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 1.0), std::nullopt) << "not measured yet";
  EXPECT_EQ(series.valueAt(ofMatrix(3), 0.35), std::nullopt) << "not wanted";
  EXPECT_EQ(series.extremes(ofMatrix(2), 0.15, 0.55), std::pair(2.0, 5.0));
  EXPECT_EQ(series.extremes(ofMatrix(2), 5.0, 6.0), std::nullopt);
  EXPECT_EQ(series.points(ofMatrix(2), {.from = 0.0, .to = 1.0, .columns = 100}).size(), 10u);
}

TEST(LiveSeries, ACurveThatIsChosenLaterHasThePastToo) {
  SignalHistory history;
  LiveSeries series;
  series.setHistory(&history);
  TaxelSelection taxels(*sdh2().layout);
  taxels.add(1, 3, 2, 3, 3);  // two taxels
  for (int i = 0; i < 5; ++i) {
    LiveResults results = resultsAt(0.1 * i);
    auto frame = std::make_shared<TactileFrame>(*results.frame);
    frame->matrix(1)(3, 2) = static_cast<float>(10 * i);
    frame->matrix(2)(3, 2) = 999.0F;  // of another matrix
    results.frame = frame;
    results.angles = Sample{results.frame->hostUs, {1.0 * i, -2.0 * i}};
    results.temperatures = Sample{results.frame->hostUs, {0.0, 30.0 + i}, kTemperatureSeries};
    auto pressure = std::make_shared<PressureFrame>();
    pressure->matrices.resize(6);
    pressure->matrices[4].forceN = 0.5 * i;
    pressure->forceN = 0.75 * i;
    if (i > 0) results.pressure = pressure;
    history.add(results);
  }
  series.update();
  using Kind = SeriesChoice::Kind;
  const SeriesChoice chosen{.kind = Kind::kTaxels, .taxels = taxels};
  const SeriesChoice angle{.kind = Kind::kAngle, .index = 1};
  const SeriesChoice cold{.kind = Kind::kTemperature, .index = 0};
  const SeriesChoice warm{.kind = Kind::kTemperature, .index = 1};
  const SeriesChoice force{.kind = Kind::kForce, .index = 4};
  const SeriesChoice hand{.kind = Kind::kForce, .index = 6};
  const SeriesChoice noJoint{.kind = Kind::kAngle, .index = 9};
  series.setWanted({chosen, angle, cold, warm, force, hand, noJoint});
  EXPECT_EQ(series.valueAt(chosen, 0.3), 15.0) << "the mean of 30 and 0";
  EXPECT_EQ(series.valueAt(angle, 0.3), -6.0);
  EXPECT_EQ(series.valueAt(cold, 0.3), std::nullopt) << "not reported yet";
  EXPECT_EQ(series.valueAt(warm, 0.3), 33.0);
  EXPECT_EQ(series.valueAt(force, 0.3), 1.5);
  EXPECT_EQ(series.valueAt(hand, 0.3), 2.25);
  EXPECT_EQ(series.valueAt(force, 0.0), std::nullopt) << "no calibration was applied";
  EXPECT_EQ(series.valueAt(noJoint, 0.3), std::nullopt);
  // The same curves again, in another order, keep their values.
  series.setWanted({warm, chosen});
  EXPECT_EQ(series.valueAt(chosen, 0.3), 15.0);
  EXPECT_EQ(series.valueAt(warm, 0.3), 33.0);
}

TEST(LiveSeries, ManyActiveTaxelsAreKeptAsWell) {
  SignalHistory history;
  LiveSeries series;
  series.setHistory(&history);
  TaxelSelection taxels(*sdh2().layout);
  taxels.addAll(0);
  LiveResults results = resultsAt(0.0);
  auto frame = std::make_shared<TactileFrame>(*results.frame);
  for (float& value : frame->values) value = 7.0F;
  results.frame = frame;
  history.add(results);
  series.update();
  const SeriesChoice chosen{.kind = SeriesChoice::Kind::kTaxels, .taxels = taxels};
  series.setWanted({chosen});
  EXPECT_EQ(series.valueAt(chosen, 0.0), 7.0);
}

TEST(LiveSeries, GapsBreakTheLineAndHaveNoValue) {
  SignalHistory history;
  LiveSeries series;
  series.setHistory(&history);
  series.setWanted({ofMatrix(2)});
  for (int i = 0; i < 10; ++i) history.add(resultsAt(0.1 * i, 4.0));
  history.add(resultsAt(5.0, 4.0));
  series.update();
  ASSERT_EQ(series.gaps().size(), 1u);
  EXPECT_NEAR(series.gaps()[0].fromS, 0.9, 1e-9);
  EXPECT_NEAR(series.gaps()[0].toS, 5.0, 1e-9);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 2.0), std::nullopt);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 5.0), 4.0);
  ASSERT_TRUE(series.gapAt(2.0));
  EXPECT_FALSE(series.gapAt(0.5));
  EXPECT_FALSE(series.gapAt(5.0));
  const auto points = series.points(ofMatrix(2), {.from = 0.0, .to = 6.0, .columns = 100});
  EXPECT_TRUE(std::any_of(
      points.begin(), points.end(), [](const SeriesPoint& point) { return std::isnan(point.y); }));
}

// A connection that was lost for 0.8 s; the event comes before the sample behind it, or later.
TEST(LiveSeries, AGapThatAnEventTellsBreaksTheLineHoweverShortItIs) {
  for (const bool late : {false, true}) {
    SignalHistory history;
    LiveSeries series;
    series.setHistory(&history);
    series.setWanted({ofMatrix(2)});
    for (int i = 0; i < 10; ++i) history.add(resultsAt(0.1 * i, 4.0));
    series.update();
    const std::int64_t lastUs = resultsAt(0.9).frame->hostUs;
    if (!late) series.breakAfter(lastUs);
    for (int i = 17; i < 20; ++i) history.add(resultsAt(0.1 * i, 4.0));
    series.update();
    for (int time = 0; late && time < 2; ++time) series.breakAfter(lastUs);
    ASSERT_EQ(series.gaps().size(), 1u);
    EXPECT_NEAR(series.gaps()[0].fromS, 0.9, 1e-9);
    EXPECT_NEAR(series.gaps()[0].toS, 1.7, 1e-9);
    EXPECT_EQ(series.valueAt(ofMatrix(2), 1.2), std::nullopt);
  }
}

TEST(LiveSeries, ForgetsWhatTheHistoryDrops) {
  SignalHistory history({.keepS = 10.0});
  LiveSeries series;
  series.setHistory(&history);
  series.setWanted({ofMatrix(2)});
  for (int i = 0; i <= 6000; ++i) {
    history.add(resultsAt(0.01 * i, i));
    if (i % 100 == 0) series.update();
  }
  series.update();
  EXPECT_EQ(series.numSamples(), 1001u);
  EXPECT_NEAR(series.oldestS(), 50.0, 1e-6);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 50.0), 5000.0);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 49.9), std::nullopt);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 60.0), 6000.0);
  const auto extremes = series.extremes(ofMatrix(2), 0.0, 100.0);
  ASSERT_TRUE(extremes);
  EXPECT_EQ(extremes->first, 5000.0);
  series.setWanted({ofMatrix(6)});
  EXPECT_EQ(series.valueAt(ofMatrix(6), 55.0), 2750.0) << "chosen later";
  EXPECT_TRUE(series.gaps().empty());
}

TEST(LiveSeries, WhatWasNeverTakenIsAGap) {
  SignalHistory history({.keepS = 1.0});
  LiveSeries series;
  series.setHistory(&history);
  series.setWanted({ofMatrix(2)});
  history.add(resultsAt(0.0, 1.0));
  series.update();
  for (int i = 1; i <= 100; ++i) history.add(resultsAt(0.1 * i, 1.0));
  series.update();
  EXPECT_EQ(series.numSamples(), 11u);
  EXPECT_NEAR(series.oldestS(), 9.0, 1e-6);
}

TEST(LiveSeries, StepsFromSampleToSample) {
  SignalHistory history;
  LiveSeries series;
  EXPECT_EQ(series.sampleTimeAt(1.0), std::nullopt);
  series.setHistory(&history);
  for (int i = 0; i < 10; ++i) history.add(resultsAt(0.125 * i));
  series.update();
  EXPECT_EQ(series.sampleTimeAt(0.3), 0.25);
  EXPECT_EQ(series.sampleTimeAt(-5.0), 0.0);
  EXPECT_EQ(series.sampleTimeAt(50.0), 1.125);
  EXPECT_EQ(series.sampleTimeBeside(0.3, 1), 0.375);
  EXPECT_EQ(series.sampleTimeBeside(0.3, -1), 0.125);
  EXPECT_EQ(series.sampleTimeBeside(0.3, -10), 0.0);
  EXPECT_EQ(series.sampleTimeBeside(0.3, 100), 1.125);
  EXPECT_EQ(series.newestUs(), kBeginUs + 1'125'000);
  EXPECT_DOUBLE_EQ(series.secondsOf(kBeginUs + 500'000), 0.5);
}

TEST(LiveSeries, AnotherHistoryBeginsAnew) {
  SignalHistory first;
  SignalHistory second;
  LiveSeries series;
  series.setHistory(&first);
  series.setWanted({ofMatrix(2)});
  first.add(resultsAt(0.0, 1.0));
  series.update();
  second.add(resultsAt(100.0, 2.0));
  series.setHistory(&second);
  EXPECT_TRUE(series.empty());
  series.update();
  EXPECT_DOUBLE_EQ(series.newestS(), 0.0);
  EXPECT_EQ(series.valueAt(ofMatrix(2), 0.0), 2.0);
  series.setHistory(nullptr);
  EXPECT_EQ(series.update(), 0u);
  EXPECT_TRUE(series.points(ofMatrix(2), {}).empty());
}

TEST(LiveSeries, ColumnsOfFurtherSeriesAreFoundByName) {
  SignalHistory history;
  LiveSeries series;
  series.setHistory(&history);
  const SeriesChoice fz{.kind = SeriesChoice::Kind::kColumn, .series = "wrist", .column = "fz"};
  SeriesChoice other = fz;
  other.series = "ankle";
  series.setWanted({fz, other});
  const auto wrist = std::make_shared<const SeriesDescription>(
      SeriesDescription{"wrist", "", {{"fx", "N"}, {"fz", "N"}}, ""});
  const auto row = [&](double atS, double value) {
    history.add(FurtherSample{wrist, {resultsAt(atS).frame->hostUs, {0.0, value}, kHandSeries}});
  };
  for (int i = 0; i < 5; ++i) {
    // The first frame is before the first sample.
    if (i > 0) row(0.1 * i, -1.0 * i);
    history.add(resultsAt(0.1 * i));
  }
  series.update();
  EXPECT_EQ(series.valueAt(fz, 0.0), std::nullopt);
  EXPECT_EQ(series.valueAt(fz, 0.25), -2.0);
  EXPECT_EQ(series.extremes(fz, 0.0, 9.0), std::pair(-4.0, -1.0));
  EXPECT_EQ(series.valueAt(other, 0.25), std::nullopt);
}

// A frame every 100 ms, a row every 10 ms.
TEST(LiveSeries, AFasterSeriesHasEveryRow) {
  SignalHistory history({.keepS = 100.0});
  LiveSeries series;
  series.setHistory(&history);
  const SeriesChoice fz{.kind = SeriesChoice::Kind::kColumn, .series = "wrist", .column = "fz"};
  const SeriesChoice fx{.kind = SeriesChoice::Kind::kColumn, .series = "wrist", .column = "fx"};
  series.setWanted({fz});
  const auto wrist = std::make_shared<const SeriesDescription>(
      SeriesDescription{"wrist", "", {{"fx", "N"}, {"fz", "N"}}, ""});
  const auto row = [&](int i) {
    history.add(FurtherSample{
        wrist, {resultsAt(0.01 * i).frame->hostUs, {1.0 * i, -1.0 * i}, kHandSeries}});
  };
  for (int i = 0; i <= 100; ++i) {
    row(i);
    if (i % 10 == 0) {
      history.add(resultsAt(0.01 * i));
      series.update();
    }
  }
  EXPECT_EQ(series.numSamples(), 11u);
  EXPECT_EQ(series.valueAt(fz, 0.123), -12.0);
  EXPECT_EQ(series.points(fz, {.from = 0.0, .to = 1.0, .columns = 1000}).size(), 101u);
  series.setWanted({fx, fz});
  EXPECT_EQ(series.valueAt(fx, 0.123), 12.0) << "chosen later";
  EXPECT_EQ(series.valueAt(fz, 0.123), -12.0) << "kept";
  // It is silent from 1 s on: its value holds for 1 s, then it is a gap.
  for (int i = 11; i <= 40; ++i) history.add(resultsAt(0.1 * i));
  series.update();
  EXPECT_EQ(series.valueAt(fz, 1.5), -100.0);
  EXPECT_EQ(series.valueAt(fz, 2.5), std::nullopt);
  row(500);
  history.add(resultsAt(5.0));
  series.update();
  EXPECT_EQ(series.valueAt(fz, 1.5), std::nullopt);
  EXPECT_EQ(series.valueAt(fz, 5.0), -500.0);
  EXPECT_EQ(series.gaps().size(), 0u) << "frames came all the time";
}

}  // namespace
}  // namespace palpate::live_series_test
