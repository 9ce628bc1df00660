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
  EXPECT_EQ(late[0].hostUs, 120'000);
  ASSERT_EQ(late[0].rows.size(), 7u);
  EXPECT_DOUBLE_EQ(late[0].rows[2].sum, 4.0);
  EXPECT_DOUBLE_EQ(late[0].rows[6].sum, 8.0);
  EXPECT_TRUE(history.after(150'000).empty());
}

TEST(SignalHistory, KeepsSecondsAndSamplesAsAsked) {
  SignalHistory seconds({.keepS = 1.0, .keepSamples = 1000});
  for (int i = 0; i <= 100; ++i) seconds.add(resultsAt(i * 100'000));
  EXPECT_EQ(seconds.size(), 11u);  // 9.0 .. 10.0 s
  EXPECT_EQ(seconds.after(0).front().hostUs, 9'000'000);
  SignalHistory samples({.keepS = 1000.0, .keepSamples = 7});
  for (int i = 0; i <= 100; ++i) samples.add(resultsAt(i * 100'000));
  EXPECT_EQ(samples.size(), 7u);
}

TEST(SignalHistory, MarksWhatComesAfterAGap) {
  SignalHistory history;
  for (int i = 0; i < 10; ++i) history.add(resultsAt(i * 30'000));
  history.add(resultsAt(270'000 + 990'000));      // below a second: late, no gap
  history.add(resultsAt(1'260'000 + 1'010'000));  // above
  const auto all = history.after(-1);
  ASSERT_EQ(all.size(), 12u);
  EXPECT_FALSE(all[0].afterGap);
  EXPECT_FALSE(all[10].afterGap);
  EXPECT_TRUE(all[11].afterGap);
}

TEST(SignalHistory, ASlowStreamHasNoGapsOfItsOwn) {
  SignalHistory history;
  for (int i = 0; i < 10; ++i) history.add(resultsAt(i * 3'000'000));  // one in 3 s
  const auto all = history.after(-1);
  // The first interval has no earlier interval to be compared with.
  for (std::size_t i = 2; i < all.size(); ++i) EXPECT_FALSE(all[i].afterGap) << i;
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
}

}  // namespace
}  // namespace palpate::signal_history_test
