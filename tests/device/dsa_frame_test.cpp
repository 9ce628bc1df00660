#include "palpate/device/dsa_frame.h"

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "device/dsa_wire.h"

namespace palpate::testing::dsa_frame_test {
namespace {

std::optional<DsaFrame> decode(const Bytes& payload, std::vector<float>& counts) {
  counts.assign(sdh2().layout->numCells(), -1.0F);
  return decodeDsaFrame(payload, *sdh2().layout, true, counts);
}

// Example of the protocol document, without its framing: "texels 121 and 122 = 1200, rest 0, t =
// 0x12345 ms".
TEST(DsaFrame, DecodesTheExampleOfTheDocument) {
  Bytes payload = bytesOf("45 23 01 00 01");
  for (int i = 0; i < 8; ++i) payload.insert(payload.end(), {std::byte{0x00}, std::byte{0xF0}});
  for (const char* unit : {"00 10", "B0 24"})
    for (const std::byte b : bytesOf(unit)) payload.push_back(b);
  for (int i = 0; i < 24; ++i) payload.insert(payload.end(), {std::byte{0x00}, std::byte{0xF0}});
  payload.insert(payload.end(), {std::byte{0x00}, std::byte{0x30}});
  ASSERT_EQ(payload.size(), 0x4Bu);
  std::vector<float> counts;
  const auto frame = decode(payload, counts);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stampMs, 0x12345u);
  EXPECT_TRUE(frame->runLength);
  EXPECT_EQ(frame->packetBytes, 83u);
  for (std::size_t i = 0; i < counts.size(); ++i)
    EXPECT_EQ(counts[i], i == 121 || i == 122 ? 1200.0F : 0.0F) << i;
}

TEST(DsaFrame, RawAndRunLengthGiveTheSame) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const auto sent = graspCounts(random);
    std::vector<float> runs, raw;
    ASSERT_TRUE(decode(framePayload(7, sent, true), runs));
    const auto frame = decode(framePayload(7, sent, false), raw);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->packetBytes, 985u);
    EXPECT_EQ(runs, raw);
    EXPECT_EQ(raw, std::vector<float>(sent.begin(), sent.end()));
  }
}

// Protocol document, 1.6.1 (real hand): 31.7 frames/s with all taxels, 55 to 58 with one matrix of
// 78, 76 with two taxels.
TEST(DsaFrame, RatesAreThoseOfAHandBySettings) {
  EXPECT_NEAR(dsaScanRateHz(456), 31.7, 0.05);
  EXPECT_GT(dsaScanRateHz(68), 55.0);
  EXPECT_LT(dsaScanRateHz(68), 58.0);
  EXPECT_NEAR(dsaScanRateHz(2), 76.0, 0.5);
  EXPECT_EQ(dsaScanRateHz(0), dsaScanRateHz(2));
  EXPECT_EQ(dsaScanRateHz(1000), dsaScanRateHz(456));
  for (std::size_t n = 3; n <= 456; ++n) EXPECT_LT(dsaScanRateHz(n), dsaScanRateHz(n - 1)) << n;
  // Section 3.1: packets of 79 bytes (nothing touched) 146 frames/s, of 985 bytes (486 runs) 11.7.
  EXPECT_NEAR(dsaLineRateHz(33), 146.0, 0.5);
  EXPECT_NEAR(dsaLineRateHz(486), 11.7, 0.05);
  TactileFrame frame(sdh2().layout);
  EXPECT_EQ(dsaRunsOf(frame), 33u);  // 486 zeros in runs of 15
  for (std::size_t i = 0; i < frame.values.size(); ++i) frame.values[i] = static_cast<float>(i);
  EXPECT_EQ(dsaRunsOf(frame), 486u);
}

TEST(DsaFrame, WhatIsNoFrameIsRefused) {
  std::vector<float> counts;
  const std::vector<unsigned> zero(486, 0);
  const Bytes good = framePayload(1024, zero, true);
  ASSERT_TRUE(decode(good, counts));
  Bytes bad = good;
  bad[4] = std::byte{3};  // unknown flag
  EXPECT_FALSE(decode(bad, counts));
  bad = good;
  bad.resize(bad.size() - 2);  // the runs are too short in sum
  EXPECT_FALSE(decode(bad, counts));
  bad = good;
  bad.insert(bad.end(), {std::byte{0}, std::byte{0x10}});  // the runs are one too long in sum
  EXPECT_FALSE(decode(bad, counts));
  bad.back() = std::byte{0};  // a run of length 0
  EXPECT_FALSE(decode(bad, counts));
  bad = framePayload(1, zero, false);
  bad[5 + 2 * 40 + 1] = std::byte{0x10};  // 4096
  EXPECT_FALSE(decode(bad, counts));
  bad.resize(bad.size() - 2);
  EXPECT_FALSE(decode(bad, counts));
  for (std::size_t size = 0; size <= 5; ++size) EXPECT_FALSE(decode(Bytes(size), counts)) << size;
}

TEST(DsaFrame, ACountWhereNoTaxelIsIsRefusedWhenTheMaskIsKnown) {
  std::vector<unsigned> sent(486, 0);
  sent[84] = 5;  // the cut corner of matrix 1
  const Bytes payload = framePayload(1, sent, true);
  std::vector<float> counts;
  EXPECT_FALSE(decode(payload, counts));
  EXPECT_TRUE(decodeDsaFrame(payload, *sdh2().layout, false, counts));
  counts.resize(7);
  EXPECT_THROW(decodeDsaFrame(payload, *sdh2().layout, false, counts), std::invalid_argument);
}

using FrameAcceptance = DsaClock::FrameAcceptance;

TEST(DsaClock, UnwrapsAt32Bits) {
  DsaClock clock;
  EXPECT_EQ(clock.checkStamp(0xFFFFFFF0u, 0), FrameAcceptance::kAccept);
  EXPECT_EQ(clock.deviceMs(), 0xFFFFFFF0ll);
  EXPECT_EQ(clock.checkStamp(0x0000000Fu, 31'000), FrameAcceptance::kAccept);
  EXPECT_EQ(clock.deviceMs(), 0x10000000Fll);
}

TEST(DsaClock, OneWrongStampIsDroppedAndTheNextGoodOneAccepted) {
  DsaClock clock;
  clock.checkStamp(1000, 0);
  EXPECT_EQ(clock.checkStamp(900, 31'000), FrameAcceptance::kHold);  // backwards
  EXPECT_EQ(clock.checkStamp(1063, 63'000), FrameAcceptance::kDropHeld);
  EXPECT_EQ(clock.checkStamp(1063, 94'000), FrameAcceptance::kHold);               // no advance
  EXPECT_EQ(clock.checkStamp(9'001'063, 126'000), FrameAcceptance::kReplaceHeld);  // hours ahead
  EXPECT_EQ(clock.checkStamp(1157, 157'000), FrameAcceptance::kDropHeld);
  EXPECT_EQ(clock.deviceMs(), 1157);
}

TEST(DsaClock, AControllerThatStartedAnewIsBelievedAtItsSecondFrame) {
  DsaClock clock;
  clock.checkStamp(500'000, 0);
  EXPECT_EQ(clock.checkStamp(9000, 12'000'000), FrameAcceptance::kHold);
  EXPECT_EQ(clock.checkStamp(9031, 12'031'000), FrameAcceptance::kRestarted);
  EXPECT_EQ(clock.heldMs(), 500'001);
  EXPECT_EQ(clock.deviceMs(), 500'032);
  EXPECT_EQ(clock.checkStamp(9063, 12'063'000), FrameAcceptance::kAccept);
  EXPECT_EQ(clock.deviceMs(), 500'064);
}

TEST(DsaClock, AnHourOfSilenceIsNoFault) {
  DsaClock clock;
  clock.checkStamp(1000, 0);
  EXPECT_EQ(clock.checkStamp(3'601'000, 3'600'000'000), FrameAcceptance::kAccept);
}

TEST(DsaLossEstimate, CountsWhatTheDeviceClockMisses) {
  DsaLossEstimate loss;
  std::int64_t ms = 0;
  // A period of 31.5 ms in whole-millisecond stamps that vary by a quarter.
  std::mt19937 random(5);
  std::uint64_t missing = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    ms = static_cast<std::int64_t>(frame * 31.5) + static_cast<int>(random() % 9);
    missing += loss.next(ms, 120);
  }
  EXPECT_EQ(missing, 0u);
  EXPECT_NEAR(loss.scanPeriodMs(), 31.5, 1.0);
  EXPECT_EQ(loss.next(ms + 32 * 4, 120), 3u);
}

TEST(DsaLossEstimate, FramesThatTheLineSlowsDownAreNotLost) {
  DsaLossEstimate loss;
  std::int64_t ms = 0;
  for (int frame = 0; frame < 100; ++frame) EXPECT_EQ(loss.next(ms += 31, 100), 0u);
  // 700 bytes take 60.8 ms on the line.
  for (int frame = 0; frame < 100; ++frame) EXPECT_EQ(loss.next(ms += 61, 700), 0u);
  EXPECT_EQ(loss.next(ms += 183, 700), 2u);
}

}  // namespace
}  // namespace palpate::testing::dsa_frame_test
