#include "palpate/recording/recording_losses.h"

#include <gtest/gtest.h>

namespace palpate::recording_losses_test {
namespace {

Event gap(std::int64_t fromUs, std::int64_t toUs, const char* json) {
  return {fromUs, toUs, "gap", {}, "lost", json};
}

TEST(RecordingLosses, AreCountedForEachStream) {
  const std::vector<Event> events = {
      gap(1'000'000, 1'250'000, R"({"stream":"angles","lost":9,"reason":"damage"})"),
      gap(2'000'000, 2'100'000, R"({"stream":"angles","lost":3,"reason":"damage"})"),
      gap(3'000'000, 6'200'000, R"({"seconds":3.2,"lost":101,"estimated":true})"),
      {0, 0, "label", {}, "touch", R"({"stream":"angles","lost":9})"}};
  const auto losses = lossesOf(events);
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0].stream, "tactile");
  EXPECT_EQ(losses[0].text(), "101 frames in 1 span, 3.20 s");
  EXPECT_EQ(losses[1].stream, "angles");
  EXPECT_EQ(losses[1].spans, 2u);
  EXPECT_EQ(losses[1].lost, 12u);
  EXPECT_TRUE(losses[1].counted);
  EXPECT_EQ(losses[1].text(), "12 angle samples in 2 spans, 0.35 s");
}

TEST(RecordingLosses, OfSeriesStandBehindTheOthersByTheirNames) {
  const auto losses =
      lossesOf(std::vector{gap(0, 500'000, R"({"stream":"wrist","lost":1})"),
                           gap(0, 500'000, R"({"stream":"events","lost":2})"),
                           gap(500'000, 600'000, R"({"stream":"wrist","lost":4})")});
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0].stream, "events");
  EXPECT_EQ(losses[1].text(), "5 wrist samples in 2 spans, 0.60 s");
}

TEST(RecordingLosses, ASilenceWithoutALossIsNone) {
  EXPECT_TRUE(
      lossesOf(std::vector{gap(0, 700'000, R"({"seconds":0.7,"lost":0,"estimated":false})")})
          .empty());
}

TEST(RecordingLosses, SayWhatIsNotKnown) {
  const auto unknown = lossesOf(std::vector{gap(0, 500'000, ""), gap(1, 1, "{damaged")});
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_EQ(unknown[0].text(), "frames, how many is not known, in 2 spans, 0.50 s");
  const auto partly =
      lossesOf(std::vector{gap(0, 500'000, "{}"), gap(0, 500'000, R"({"lost":4})")});
  EXPECT_EQ(partly.at(0).text(), "at least 4 frames in 2 spans, 1.00 s");
  EXPECT_TRUE(lossesOf({}).empty());
}

}  // namespace
}  // namespace palpate::recording_losses_test
