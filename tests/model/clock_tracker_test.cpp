// The judgement of single stamps.
#include "model/clock_tracker.h"

#include <gtest/gtest.h>

namespace palpate::clock_tracker_test {
namespace {

using Verdict = ClockTracker::Verdict;
constexpr std::int64_t kTurnUs = std::int64_t{1} << 32;

// The last judgement of each item.
std::vector<ClockTracker::Judged> judge(const std::vector<ClockStamp>& stamps) {
  std::vector<ClockTracker::Judged> judged, byItem(stamps.size());
  ClockTracker tracker;
  for (const ClockStamp& stamp : stamps) tracker.push(stamp, judged);
  tracker.finish(judged);
  for (const auto& each : judged) byItem.at(each.item) = each;
  return byItem;
}

TEST(ClockTracker, UnwrapsACounter) {
  const auto judged = judge({{0, kTurnUs - 4'000}, {10'000, 6'000}, {20'000, 16'000}});
  EXPECT_EQ(judged[1].deviceUs, kTurnUs + 6'000);
  EXPECT_EQ(judged[2].deviceUs, kTurnUs + 16'000);
  for (const auto& each : judged) EXPECT_EQ(each.verdict, Verdict::kGood);
}

TEST(ClockTracker, ARestartNeedsAnItemThatGoesOn) {
  const auto judged = judge({{0, 50'000'000}, {3'000'000, 1'000}, {3'010'000, 11'000}});
  EXPECT_EQ(judged[1].verdict, Verdict::kRestart);
  EXPECT_EQ(judged[1].deviceUs, 1'000);
  EXPECT_EQ(judged[2].verdict, Verdict::kGood);
  EXPECT_EQ(judge({{0, 50'000'000}, {3'000'000, 1'000}})[1].verdict, Verdict::kUnusable);
}

TEST(ClockTracker, ASingleWrongStampIsUnusable) {
  for (const std::int64_t wrong : {std::int64_t{3}, std::int64_t{9'000'000'000}, INT64_MAX}) {
    const auto judged =
        judge({{0, 1'000'000}, {10'000, 1'010'000}, {20'000, wrong}, {30'000, 1'030'000}});
    EXPECT_EQ(judged[2].verdict, Verdict::kUnusable);
    EXPECT_EQ(judged[3].verdict, Verdict::kGood);
    EXPECT_EQ(judged[3].deviceUs, 1'030'000);
  }
}

// It is believed at first: it is not far enough ahead.
TEST(ClockTracker, AStampThatWasALittleAheadIsTakenBack) {
  const auto judged =
      judge({{0, 1'000'000}, {10'000, 1'010'000}, {20'000, 1'500'000}, {30'000, 1'030'000}});
  EXPECT_EQ(judged[2].verdict, Verdict::kUnusable);
  EXPECT_EQ(judged[3].verdict, Verdict::kGood);
}

}  // namespace
}  // namespace palpate::clock_tracker_test
