#include "palpate/live/signal_history.h"

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::signal_history_test {
namespace {

LiveResults resultsAt(std::int64_t hostUs, double sum = 1.0) {
  auto frame = std::make_shared<TactileFrame>(sdh2().layout);
  frame->hostUs = hostUs;
  LiveResults results;
  results.frame = std::move(frame);
  results.matrixSignals.resize(6);
  results.matrixSignals[2].sum = sum;
  results.wholeSignals.sum = 2.0 * sum;
  return results;
}

TEST(SignalHistory, GivesWhatIsLaterThanAStamp) {
  SignalHistory history;
  for (int i = 1; i <= 5; ++i) history.add(resultsAt(i * 30'000, i));
  EXPECT_EQ(history.after(0).size(), 5u);
  const auto late = history.after(90'000);
  ASSERT_EQ(late.size(), 2u);
  EXPECT_EQ(late[0]->hostUs, 120'000);
  ASSERT_EQ(late[0]->rows.size(), 7u);
  EXPECT_DOUBLE_EQ(late[0]->rows[2].sum, 4.0);
  EXPECT_DOUBLE_EQ(late[0]->rows[6].sum, 8.0);
  EXPECT_TRUE(history.after(150'000).empty());
}

TEST(SignalHistory, KeepsSecondsAndSamplesAsAsked) {
  SignalHistory seconds({.keepS = 1.0, .keepSamples = 1000});
  for (int i = 0; i <= 100; ++i) seconds.add(resultsAt(i * 100'000));
  EXPECT_EQ(seconds.size(), 11u);  // 9.0 .. 10.0 s
  EXPECT_EQ(seconds.after(0).front()->hostUs, 9'000'000);
  SignalHistory samples({.keepS = 1000.0, .keepSamples = 7});
  for (int i = 0; i <= 100; ++i) samples.add(resultsAt(i * 100'000));
  EXPECT_EQ(samples.size(), 7u);
}

TEST(SignalHistory, TakesNoMoreMemoryThanAllowed) {
  SignalHistory history({.keepS = 1e6, .keepSamples = 1'000'000, .keepBytes = 100'000});
  for (int i = 1; i <= 1000; ++i) history.add(resultsAt(i * 30'000));
  EXPECT_LE(history.bytes(), 100'000u);
  EXPECT_GT(history.bytes(), 90'000u);
  EXPECT_EQ(history.after(0).back()->hostUs, 30'000'000);
  EXPECT_EQ(history.oldestUs(), history.after(0).front()->hostUs);
  // One sample is kept however large it is.
  SignalHistory tiny({.keepS = 1.0, .keepSamples = 10, .keepBytes = 1});
  tiny.add(resultsAt(1));
  EXPECT_EQ(tiny.size(), 1u);
}

TEST(SignalHistory, TenMinutesOfAFullHandFitIntoItsMemory) {
  // Half of all taxels are active: that is much for a grasp.
  auto frame = std::make_shared<TactileFrame>(sdh2().layout);
  for (std::size_t i = 0; i < frame->values.size(); i += 2) frame->values[i] = 100.0F;
  LiveResults results = resultsAt(1);
  results.frame = frame;
  results.angles = Sample{1, std::vector<double>(7)};
  results.temperatures = Sample{1, std::vector<double>(9), kTemperatureSeries};
  SignalHistory history;
  history.add(results);
  EXPECT_LT(static_cast<double>(history.bytes()) * 600.0 * 31.7,
            static_cast<double>(history.options().keepBytes));
}

TEST(SignalHistory, KeepsTaxelsSparselyOrAll) {
  std::vector<float> values(100, 0.0F);
  values[3] = 4.0F;
  values[50] = 8.0F;
  const KeptTaxels few(values);
  EXPECT_EQ(few.bytes(), 2 * 8u);
  std::vector<bool> chosen(100, false);
  chosen[3] = chosen[4] = chosen[50] = chosen[51] = true;
  EXPECT_DOUBLE_EQ(few.meanOf(chosen, 4), 3.0);
  EXPECT_DOUBLE_EQ(few.meanOf({}, 0), 0.0);
  const std::vector<float> full(100, 2.5F);
  const KeptTaxels all(full);
  EXPECT_EQ(all.bytes(), 400u);
  EXPECT_DOUBLE_EQ(all.meanOf(chosen, 4), 2.5);
}

TEST(SignalHistory, MarksWhatComesAfterAGap) {
  SignalHistory history;
  for (int i = 0; i < 10; ++i) history.add(resultsAt(i * 30'000));
  history.add(resultsAt(270'000 + 990'000));      // below a second: late, no gap
  history.add(resultsAt(1'260'000 + 1'010'000));  // above
  const auto all = history.after(-1);
  ASSERT_EQ(all.size(), 12u);
  EXPECT_FALSE(all[0]->afterGap);
  EXPECT_FALSE(all[10]->afterGap);
  EXPECT_TRUE(all[11]->afterGap);
}

TEST(SignalHistory, ASlowStreamHasNoGapsOfItsOwn) {
  SignalHistory history;
  for (int i = 0; i < 10; ++i) history.add(resultsAt(i * 3'000'000));  // one in 3 s
  const auto all = history.after(-1);
  // The first interval has no earlier interval to be compared with.
  for (std::size_t i = 2; i < all.size(); ++i) EXPECT_FALSE(all[i]->afterGap) << i;
}

TEST(SignalHistory, LeavesOutWhatIsNotLater) {
  SignalHistory history;
  history.add(resultsAt(100));
  history.add(resultsAt(100));
  history.add(resultsAt(50));
  EXPECT_EQ(history.size(), 1u);
  history.clear();
  EXPECT_EQ(history.size(), 0u);
  history.add(resultsAt(50));
  EXPECT_EQ(history.size(), 1u);
}

TEST(SignalHistory, RefusesOptionsWithoutRoom) {
  EXPECT_THROW(SignalHistory({.keepS = 0.0, .keepSamples = 1}), std::invalid_argument);
  EXPECT_THROW(SignalHistory({.keepS = 1.0, .keepSamples = 0}), std::invalid_argument);
  EXPECT_THROW(SignalHistory({.keepS = 1.0, .keepSamples = 1, .keepBytes = 0}),
               std::invalid_argument);
}

FurtherSample furtherSample(std::int64_t hostUs, std::vector<Column> columns = {{"fz", "N"}}) {
  const std::vector<double> values(columns.size(), static_cast<double>(hostUs));
  return {std::make_shared<const SeriesDescription>(
              SeriesDescription{"wrist", "", std::move(columns), ""}),
          {hostUs, values, kHandSeries}};
}

TEST(SignalHistory, KeepsEveryRowOfAFurtherSeries) {
  SignalHistory history({.keepS = 1.0});
  for (std::int64_t us = 0; us < 3'000'000; us += 1000) history.add(furtherSample(us));
  history.add(furtherSample(2'000'000));  // not later
  const ColumnRows rows = history.column("wrist", "fz", 0);
  ASSERT_EQ(rows.hostUs.size(), 1001u);
  EXPECT_EQ(rows.hostUs.front(), 1'999'000);
  EXPECT_EQ(rows.values.back(), 2'999'000.0);
  EXPECT_TRUE(rows.afterGaps.empty());
  EXPECT_EQ(rows.gapUs, 1'000'000);
  EXPECT_EQ(history.column("wrist", "fz", 2'997'000).hostUs,
            (std::vector<std::int64_t>{2'998'000, 2'999'000}));
  EXPECT_TRUE(history.column("wrist", "fx", 0).hostUs.empty());
  EXPECT_TRUE(history.column("ankle", "fz", 0).hostUs.empty());
  history.add(furtherSample(3'500'000));
  EXPECT_TRUE(history.column("wrist", "fz", 2'999'000).afterGaps.empty());
  history.add(furtherSample(4'500'001));
  EXPECT_EQ(history.column("wrist", "fz", 3'500'000).afterGaps, std::vector<std::size_t>{0});
  // Other columns: those before are dropped.
  history.add(furtherSample(4'600'000, {{"a", ""}, {"b", ""}}));
  EXPECT_TRUE(history.column("wrist", "fz", 0).hostUs.empty());
  EXPECT_EQ(history.column("wrist", "b", 0).values, std::vector<double>{4'600'000.0});
  history.clear();
  EXPECT_TRUE(history.column("wrist", "b", 0).hostUs.empty());
}

TEST(SignalHistory, FurtherSeriesCountAsMemory) {
  SignalHistory history({.keepBytes = 1700});
  history.add(furtherSample(1));
  EXPECT_EQ(history.bytes(), 2 * sizeof(double) + 1);
  for (std::int64_t us = 2; us <= 1000; ++us) history.add(furtherSample(us));
  EXPECT_EQ(history.bytes(), 1700u);
  EXPECT_EQ(history.column("wrist", "fz", 0).hostUs.front(), 901);
}

}  // namespace
}  // namespace palpate::signal_history_test
