#include "gui/timeline/series_store.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include <gtest/gtest.h>

#include <palpate/core/number_text.h>
#include <palpate/emulator/synthetic_profile.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recording/recording.h>

#include "gui/testing/sample_profiles.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/timeline/curve_table.h"
#include "testing/damaged_profile.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::gui::series_store_test {
namespace {

using Kind = SeriesChoice::Kind;

DecimationOptions seen(double from, double to) { return {.from = from, .to = to, .columns = 500}; }

class SeriesStoreTest : public ::testing::Test {
 protected:
  // Two minutes with four grasps; as a file, so that it has a summary. Opened as if it were one of
  // hours.
  OpenedRecordingPtr longOne() {
    const auto path = folder_ / "long.palpate";
    saveRecording(synthesize({.durationS = 120.0, .grasps = 4}), {}, path);
    return makeOpenedRecording(path, openRecording(path), {}, 100);
  }
  testing::TemporaryFolder folder_;
  SeriesStore store_;
};

TEST_F(SeriesStoreTest, OfAShortRecordingEverythingIsThereAtOnce) {
  const auto recording = makeOpenedRecording("x.dsa", synthesize({.durationS = 4.0, .grasps = 1}));
  ASSERT_FALSE(recording->isLong());
  store_.setRecording(recording);
  const SeriesChoice maximum{Kind::kMatrix, 1, SignalKind::kMaximum};
  const SeriesChoice joint{.kind = Kind::kAngle, .index = 1};
  store_.setWanted({maximum, joint});
  ASSERT_TRUE(store_.samples(maximum));
  ASSERT_TRUE(store_.samples(joint));
  EXPECT_EQ(store_.samples(maximum)->values.size(), recording->profile.numFrames());
  EXPECT_EQ(store_.samples(joint)->values.size(), recording->profile.numAngles());
  EXPECT_EQ(store_.progress(), 1.0);
  EXPECT_FALSE(store_.points(joint, seen(0.0, 4.0)).empty());
  EXPECT_EQ(store_.extremes(maximum)->second, recording->maximum);
  const std::size_t frame = 40;
  EXPECT_EQ(store_.valueAt(maximum, recording->timeS[frame] + 0.001),
            recording->table.at(frame, 1).maximum);
  EXPECT_FALSE(store_.valueAt(maximum, -1.0));
}

TEST_F(SeriesStoreTest, WhatTheRecordingHasNotIsLeftOut) {
  store_.setRecording(makeOpenedRecording("x.dsa", twentyFrames()));
  const SeriesChoice joint{.kind = Kind::kAngle, .index = 1};
  store_.setWanted({joint, {.kind = Kind::kTaxels}, {Kind::kMatrix, 99}});
  EXPECT_TRUE(store_.points(joint, seen(0.0, 1.0)).empty());
  EXPECT_FALSE(store_.valueAt(joint, 0.5));
  EXPECT_FALSE(store_.samples(joint));
  store_.setRecording(nullptr);
  store_.setWanted({joint});
  EXPECT_EQ(store_.progress(), 1.0);
}

TEST_F(SeriesStoreTest, NoLineGoesOverAGap) {
  store_.setRecording(makeOpenedRecording("x.dsa", profileWithStamps({0, 50, 100, 9'000, 9'050})));
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMaximum};
  store_.setWanted({choice});
  int breaks = 0;
  for (const SeriesPoint& point : store_.points(choice, seen(0.0, 10.0)))
    breaks += std::isnan(point.y) ? 1 : 0;
  EXPECT_EQ(breaks, 1);
  EXPECT_FALSE(store_.valueAt(choice, 4.0)) << "nothing was recorded there";
  EXPECT_EQ(store_.valueAt(choice, 9.01), 40.0);
}

TEST_F(SeriesStoreTest, ALongRecordingIsReadBesideTheWindow) {
  const auto recording = longOne();
  ASSERT_TRUE(recording->isLong());
  EXPECT_TRUE(recording->table.numFrames() == 0) << "not read through";
  EXPECT_TRUE(recording->touched[1]) << "its summary says so";
  store_.setRecording(recording);
  TaxelSelection taxels(recording->profile.layout());
  taxels.addAll(1);
  const SeriesChoice maximum{Kind::kMatrix, 1, SignalKind::kMaximum};
  const SeriesChoice group{.kind = Kind::kTaxels, .taxels = taxels};
  const SeriesChoice joint{.kind = Kind::kAngle, .index = 2};
  store_.setWanted({maximum, group, joint});
  store_.waitUntilRead();
  EXPECT_EQ(store_.progress(), 1.0);
  // Against every sample, read the plain way.
  for (const SeriesChoice& choice : {maximum, group, joint}) {
    const Series all = readSeries(recording->profile, choice, -1.0, 1e6);
    double low = INFINITY, high = -INFINITY;
    for (const double value : all.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
    EXPECT_NEAR(store_.extremes(choice)->first, low, 1e-3);
    EXPECT_NEAR(store_.extremes(choice)->second, high, 1e-3);
    double top = -INFINITY;
    for (const SeriesPoint& point : store_.points(choice, seen(0.0, 120.0)))
      if (!std::isnan(point.y)) top = std::max(top, point.y);
    EXPECT_NEAR(top, high, 1e-3) << "no peak is lost, however far zoomed out";
  }
}

TEST_F(SeriesStoreTest, ZoomedInEverySampleIsShown) {
  const auto recording = longOne();
  store_.setRecording(recording);
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMean};
  store_.setWanted({choice});
  store_.setVisibleRange(20.0, 30.0);
  store_.waitUntilRead();
  const auto samples = store_.samples(choice);
  ASSERT_TRUE(samples);
  const Series all = readSeries(recording->profile, choice, 20.0, 30.0);
  const auto points = store_.points(choice, {.from = 20.0, .to = 30.0, .columns = 100'000});
  std::size_t found = 0;
  for (std::size_t i = 0; i < all.timeS.size(); ++i)
    for (const SeriesPoint& point : points)
      if (point.x == all.timeS[i] && point.y == all.values[i]) {
        ++found;
        break;
      }
  EXPECT_GE(found + 2, all.timeS.size()) << "all but the neighbours outside";
}

// The value of a signal is read from the file; a filter would have to be computed from gap to gap.
TEST_F(SeriesStoreTest, OneValueOfAFilterIsNotComputedWhileTheWindowWaits) {
  const auto recording = longOne();
  store_.setRecording(recording);
  const SeriesChoice plain{Kind::kMatrix, 1, SignalKind::kMean};
  SeriesChoice filtered;
  filtered.kind = Kind::kFormula;
  filtered.formula = "lowpass(m1_mean, 2)";
  store_.setVisibleRange(20.0, 30.0);
  store_.setWanted({plain, filtered});
  store_.waitUntilRead();
  for (const SeriesChoice& choice : {plain, filtered}) {
    EXPECT_TRUE(store_.holds(choice, 21.0, 29.0));
    EXPECT_FALSE(store_.holds(choice, 21.0, 80.0));
    EXPECT_TRUE(store_.valueAt(choice, 25.0));
  }
  EXPECT_TRUE(store_.valueAt(plain, 80.0));
  EXPECT_FALSE(store_.valueAt(filtered, 80.0));
}

TEST_F(SeriesStoreTest, TheFirstLookComesBeforeTheWholeIsRead) {
  const auto recording = longOne();
  store_.setRecording(recording);
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMean};
  store_.setWanted({choice});
  store_.waitForFirstLook();
  EXPECT_GT(store_.points(choice, seen(0.0, 120.0)).size(), 50u);
  store_.setRecording(nullptr);  // ends what is still at work
}

TEST_F(SeriesStoreTest, TheOverviewTellsTheExactFacts) {
  const auto recording = longOne();
  EXPECT_FALSE(recording->saturatedFramesNow());
  store_.setRecording(recording);
  store_.setWanted({});
  store_.waitUntilRead();
  const auto whole = makeOpenedRecording(recording->path, recording->profile);
  EXPECT_EQ(recording->saturatedFramesNow(), whole->saturatedFrames);
  EXPECT_EQ(recording->maximumNow(), whole->maximum);
  EXPECT_EQ(recording->timingNow().rateHz, whole->timing.rateHz);
  EXPECT_EQ(recording->timingNow().gaps.size(), whole->timing.gaps.size());
  EXPECT_EQ(recording->at(77, 1).mean, whole->at(77, 1).mean);
  EXPECT_NEAR(recording->timeAt(77), whole->timeAt(77), 1e-9);
}

// what a file claims of its matrices is bounded before anything is drawn.
TEST_F(SeriesStoreTest, OfManyMatricesOrPlacesFewerFramesAreLong) {
  const auto opened = [](std::vector<MatrixLayout> matrices, int frames) {
    const auto layout = std::make_shared<const SensorLayout>(std::move(matrices));
    ProfileBuilder builder(layout);
    const std::vector<float> values(layout->numCells(), 7.0F);
    for (int i = 0; i < frames; ++i) builder.addFrame(1 + i * 30'000LL, values);
    return makeOpenedRecording("none.palpate", builder.finish({}));
  };
  const MatrixLayout single = MatrixLayout::full(1, 1, 3.4);
  EXPECT_FALSE(opened({single}, 25'000)->isLong());
  const auto many = opened(std::vector<MatrixLayout>(64, single), 25'000);
  ASSERT_TRUE(many->isLong()) << "a table of 64 signals of each frame would take 90 MB";
  EXPECT_EQ(many->table.numFrames(), 0u);
  EXPECT_EQ(many->at(3, 5).sum, 7.0);
  EXPECT_NEAR(many->timingNow().meanRateHz, 1e6 / 30'000.0, 0.01);
  EXPECT_TRUE(opened({MatrixLayout::full(256, 256, 3.4)}, 1500)->isLong());
}

class DamagedSeriesStoreTest : public SeriesStoreTest {
 protected:
  static constexpr std::size_t kFirst = 1500, kLast = 1999;
  DamagedSeriesStoreTest() {
    const auto path = folder_ / "long.palpate";
    const Profile sound = synthesize({.durationS = 120.0, .grasps = 4});
    saveRecording(sound, {}, path);
    recording_ = makeOpenedRecording(path, testing::withDamage(sound, kFirst, kLast), {}, 100);
    store_.setRecording(recording_);
  }
  double timeS(std::size_t frame) const { return recording_->timeAt(frame); }
  OpenedRecordingPtr recording_;
};

TEST_F(DamagedSeriesStoreTest, TheOverviewEndsAndCountsWhatCannotBeRead) {
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMaximum};
  SeriesChoice formula;
  formula.kind = Kind::kFormula;
  formula.formula = "2 * m1_max";
  TaxelSelection taxels(recording_->profile.layout());
  taxels.addAll(1);
  const SeriesChoice group{.kind = Kind::kTaxels, .taxels = taxels};
  store_.setWanted({choice, formula, group});
  store_.waitUntilRead();
  EXPECT_EQ(store_.progress(), 1.0);
  EXPECT_FALSE(store_.busy());
  EXPECT_EQ(recording_->unreadableNow().count, kLast - kFirst + 1);
  EXPECT_TRUE(recording_->saturatedFramesNow());
  EXPECT_TRUE(recording_->unreadableAt(timeS(kFirst)));
  EXPECT_TRUE(recording_->unreadableAt(timeS(kLast)));
  EXPECT_FALSE(recording_->unreadableAt(timeS(kFirst - 1)));
  EXPECT_FALSE(recording_->unreadableAt(timeS(kLast + 1)));
  for (const SeriesChoice& each : {choice, formula, group}) {
    bool before = false, behind = false;
    for (const SeriesPoint& point : store_.points(each, seen(0.0, 120.0))) {
      if (std::isnan(point.y)) continue;
      before |= point.x < timeS(kFirst) - 1.0;
      behind |= point.x > timeS(kLast) + 1.0;
      EXPECT_FALSE(point.x > timeS(kFirst) + 1.0 && point.x < timeS(kLast) - 1.0) << point.x;
    }
    EXPECT_TRUE(before && behind);
  }
}

// F6: what was read of another span is not shown as the values of the damaged one.
TEST_F(DamagedSeriesStoreTest, ADamagedSpanHasNoValuesOfAnother) {
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMean};
  store_.setVisibleRange(5.0, 10.0);  // first: of all of it every sample would be read at once
  store_.setWanted({choice});
  store_.waitUntilRead();
  ASSERT_TRUE(store_.valueAt(choice, 7.0));
  const double from = timeS(kFirst + 100), to = timeS(kLast - 100);
  store_.setVisibleRange(from, to);
  store_.waitUntilRead();
  EXPECT_FALSE(store_.valueAt(choice, (from + to) / 2));
  for (const SeriesPoint& point : store_.points(choice, seen(from, to)))
    EXPECT_TRUE(std::isnan(point.y) || point.x < timeS(kFirst) || point.x > timeS(kLast));
  // At the edge of the damage each side has its own values.
  store_.setVisibleRange(timeS(kFirst - 50), timeS(kFirst + 50));
  store_.waitUntilRead();
  const Series sound = readSeries(recording_->profile, choice, 0.0, timeS(kFirst - 2));
  EXPECT_EQ(store_.valueAt(choice, timeS(kFirst - 2)), sound.values[kFirst - 2]);
  EXPECT_FALSE(store_.valueAt(choice, timeS(kFirst)));
}

TEST_F(SeriesStoreTest, HasColumnsOfFurtherSeries) {
  const SeriesChoice fx{.kind = Kind::kColumn, .series = "wrist", .column = "fx"};
  const Profile profile = testing::withWrist(synthesize({.durationS = 4.0, .grasps = 1}), 60);
  const auto path = folder_ / "wrist.palpate";
  saveRecording(profile, {}, path);
  for (const std::size_t longFrom : {std::size_t{100'000}, std::size_t{50}}) {
    store_.setRecording(makeOpenedRecording(path, openRecording(path), {}, longFrom));
    store_.setWanted({fx, {.kind = Kind::kColumn, .series = "ankle", .column = "fx"}});
    store_.waitUntilRead();
    EXPECT_EQ(store_.extremes(fx), std::pair(0.5, 59.5)) << longFrom;
    EXPECT_EQ(store_.valueAt(fx, 1.0), 19.5) << longFrom;
    EXPECT_EQ(store_.valueAt(fx, 0.01), std::nullopt) << "before its first sample";
  }
}

// Cells are those of the frames: the last sample at or before each.
TEST(CurveTable, HasColumnsOfFurtherSeries) {
  const auto recording = makeOpenedRecording(
      "x.palpate", testing::withWrist(synthesize({.durationS = 2.0, .grasps = 0}), 10));
  const Profile& profile = recording->profile;
  const std::vector<PlottedCurve> curves = {columnCurve(testing::wristSeries(), 0, 0),
                                            columnCurve(testing::wristSeries(), 1, 1),
                                            angleCurve(profile.hand(), 1)};
  const TextTable table = curveTable(recording, curves, {0, profile.numFrames() - 1});
  EXPECT_EQ(table.header.at(3), "wrist fx [N]");
  EXPECT_EQ(table.header.at(4), "wrist fz [N]");
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const std::vector<std::string> cells = table.row(i);
    const std::int64_t sinceUs = profile.frameTimeUs(i) - profile.frameTimeUs(0) - 30'000;
    const std::int64_t last = std::min<std::int64_t>(sinceUs / 50'000, 9);
    EXPECT_EQ(cells.at(3), sinceUs < 0 ? "" : std::to_string(last) + ".5") << i;
    EXPECT_EQ(cells.at(4), sinceUs < 0 || last == 3 ? "" : std::to_string(-2 * last)) << i;
    EXPECT_EQ(cells.at(5), numberText(profile.anglesAtFrame(i)->values.at(1)));
  }
  const SelectedCurves selected = selectedCurves(recording, curves, {0, profile.numFrames() - 1});
  const std::vector<std::string> row = statisticsTable(selected).row(0);
  EXPECT_EQ(row.at(0), "wrist fx");
  EXPECT_EQ(row.at(6), "9.5") << "the largest";
}

}  // namespace
}  // namespace palpate::gui::series_store_test
