#include "palpate/emulator/paced_line.h"

#include <gtest/gtest.h>

namespace palpate::paced_line_test {
namespace {

LineMessage message(std::size_t bytes, std::optional<std::uint64_t> frame = {}) {
  LineMessage made;
  for (std::size_t i = 0; i < bytes; ++i) made.bytes.push_back(static_cast<std::byte>(i));
  made.frame = frame;
  return made;
}

TEST(PacedLine, EachByteLeavesAtItsTime) {
  PacedLine line(100.0);
  EXPECT_FALSE(line.nextDueUs());
  line.push(message(10), 5000);
  EXPECT_EQ(line.freeAtUs(), 6000);
  EXPECT_EQ(line.nextDueUs(), 6000);  // a short message is one chunk
  EXPECT_TRUE(line.due(5999).empty());
  EXPECT_EQ(line.due(6000).size(), 10u);
}

TEST(PacedLine, LongMessagesLeaveInEqualPieces) {
  PacedLine line(100.0);
  line.push(message(120), 0);
  EXPECT_EQ(line.nextDueUs(), 6000);
  EXPECT_EQ(line.due(6000).size(), 60u);
  std::vector<SentMessage> ended;
  line.pass(60, false, ended);
  EXPECT_TRUE(ended.empty());
  EXPECT_EQ(line.nextDueUs(), 12'000);
  EXPECT_EQ(line.due(12'000).size(), 60u);
  EXPECT_EQ(line.due(12'000)[0], std::byte{60});
}

TEST(PacedLine, TheNextMessageWaitsForTheLine) {
  PacedLine line(100.0);
  line.push(message(10, 1), 0);
  line.push(message(10, 2), 500);   // the line is busy until 1000
  line.push(message(10, 3), 9000);  // and idle from 2000 on
  EXPECT_EQ(line.due(2000).size(), 20u);
  EXPECT_EQ(line.due(9999).size(), 20u);
  EXPECT_EQ(line.due(10'000).size(), 30u);
  std::vector<SentMessage> ended;
  line.pass(15, false, ended);
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(ended[0].frame, 1u);
  EXPECT_FALSE(ended[0].lost);
  EXPECT_EQ(line.pendingBytes(), 15u);
}

TEST(PacedLine, LostBytesMarkTheirMessage) {
  PacedLine line(100.0);
  LineMessage damaged = message(10, 2);
  damaged.damaged = true;
  line.push(message(10, 1), 0);
  line.push(damaged, 0);
  line.push(message(10, 3), 0);
  std::vector<SentMessage> ended;
  line.pass(5, false, ended);
  line.pass(5, true, ended);
  line.pass(10, false, ended);
  line.clear(ended);
  ASSERT_EQ(ended.size(), 3u);
  EXPECT_TRUE(ended[0].lost);
  EXPECT_FALSE(ended[0].damaged);
  EXPECT_FALSE(ended[1].lost);
  EXPECT_TRUE(ended[1].damaged);
  EXPECT_TRUE(ended[2].lost);
  EXPECT_EQ(ended[2].bytes, 10u);
  EXPECT_EQ(line.pendingBytes(), 0u);
  EXPECT_FALSE(line.nextDueUs());
}

TEST(PacedLine, WithoutPacingAllIsDueAtOnce) {
  PacedLine line(0.0);
  line.push(message(1000, 1), 77);
  line.push(message(1000, 2), 78);
  EXPECT_EQ(line.freeAtUs(), 0);
  EXPECT_EQ(line.due(0).size(), 2000u);
}

// 985 bytes at 115200 baud, over and over: 11.7 a second.
TEST(PacedLine, CarriesTheBaudRateWithoutDrift) {
  PacedLine line(kSerialByteUs);
  for (int i = 0; i < 1000; ++i) line.push(message(985), 0);
  EXPECT_EQ(line.freeAtUs(), 85'503'473);  // 985000 * 10 / 115200 s
  std::vector<SentMessage> ended;
  std::size_t passed = 0;
  for (std::int64_t t = 0; line.pendingBytes() > 0; t += 1000) {
    const std::size_t due = line.due(t).size();
    passed += due;
    // Never ahead of the line, and at most one chunk (64 bytes) and one step behind it.
    ASSERT_LE(double(passed), double(t) / kSerialByteUs);
    ASSERT_GE(double(passed) + 76.0, std::min(985'000.0, double(t) / kSerialByteUs));
    line.pass(due, false, ended);
  }
  EXPECT_EQ(ended.size(), 1000u);
}

TEST(PacedLine, TakesEmptyMessagesAndTooLargeCounts) {
  PacedLine line(100.0);
  std::vector<SentMessage> ended;
  line.push({}, 0);
  EXPECT_FALSE(line.nextDueUs());
  line.pass(10, false, ended);
  EXPECT_TRUE(ended.empty());
}

}  // namespace
}  // namespace palpate::paced_line_test
