#include "device/frame_numbers.h"

#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpate::frame_numbers_test {
namespace {

// What a receiver counts.
struct Receiver {
  void frame(std::uint32_t number, std::int64_t afterUs, bool mayBeLate = false) {
    nowUs += afterUs;
    const FrameNumbers::Step step = numbers.next(number, nowUs, mayBeLate);
    lost += step.missing.value_or(0);
    renumbered += step.renumbered;
    late += step.late;
  }
  FrameNumbers numbers;
  std::int64_t nowUs = 1'000'000;
  std::uint64_t lost = 0, renumbered = 0, late = 0;
};

TEST(FrameNumbers, AMissingNumberIsAMissingFrame) {
  Receiver receiver;
  for (const std::uint32_t n : {4'294'967'290U, 4'294'967'295U, 0U, 1U, 5U, 6U})
    receiver.frame(n, 10'000);
  EXPECT_EQ(receiver.lost, 4u + 3u);
  EXPECT_EQ(receiver.renumbered, 0u);
}

// Four of five frames are lost for a minute, at random.
TEST(FrameNumbers, HeavyLossIsCounted) {
  Receiver receiver;
  std::mt19937 random(1);
  std::uint32_t last = 0;
  std::uint64_t received = 0;
  std::int64_t sinceUs = 0;
  for (std::uint32_t n = 0; n < 6000; ++n) {
    sinceUs += 10'000;
    if (n > 0 && random() % 5 != 0) continue;
    receiver.frame(n, std::exchange(sinceUs, 0));
    last = n;
    ++received;
  }
  EXPECT_EQ(receiver.lost, last + 1 - received);
  EXPECT_EQ(receiver.renumbered, 0u);
}

TEST(FrameNumbers, ASilenceHoldsWhatTheSenderSentInIt) {
  Receiver receiver;
  for (std::uint32_t n = 0; n < 100; ++n) receiver.frame(n, 10'000);
  receiver.frame(100 + 3600 * 100, INT64_C(3'600'000'000));
  EXPECT_EQ(receiver.lost, 3600u * 100u);
  receiver.frame(100 + 3600 * 100 + 10'000, 10'000);  // 100 s of frames in 0.01 s
  EXPECT_EQ(receiver.lost, 3600u * 100u);
  EXPECT_EQ(receiver.renumbered, 1u);
}

// The program stood still for 20 s: the system kept 277 datagrams and dropped the rest.
TEST(FrameNumbers, LossBehindABufferBelongsToThePause) {
  Receiver receiver;
  std::uint32_t n = 0;
  for (; n < 1000; ++n) receiver.frame(n, 10'000);
  receiver.frame(n++, 20'000'000);
  for (int i = 0; i < 276; ++i) receiver.frame(n++, 20);
  n += 1723;
  for (int i = 0; i < 1000; ++i) receiver.frame(n++, 10'000);
  EXPECT_EQ(receiver.lost, 1723u);
  EXPECT_EQ(receiver.renumbered, 0u);
}

// The same, and the pause comes with the first frame, when no rate is known.
TEST(FrameNumbers, LossBehindAPauseAtTheBeginIsCounted) {
  Receiver receiver;
  std::uint32_t n = 0;
  receiver.frame(n++, 0);
  receiver.frame(n++, 2'000'000);
  for (int i = 0; i < 1000; ++i) receiver.frame(n++, 20);
  n += 15'000;
  for (int i = 0; i < 1000; ++i) receiver.frame(n++, 100);
  EXPECT_EQ(receiver.lost, 15'000u);
  EXPECT_EQ(receiver.renumbered, 0u);
}

// Two senders of 100 frames/s each, one number ahead of the other by `offset`.
TEST(FrameNumbers, TwoSendersLoseNothing) {
  for (const std::uint32_t offset : {200U, 500U, 12'000U, 1'000'000U, 2'000'000'000U}) {
    Receiver alternating;
    for (std::uint32_t n = 0; n < 6000; ++n) {
      alternating.frame(n, 5'000, true);
      alternating.frame(n + offset, 5'000, true);
    }
    EXPECT_EQ(alternating.lost, 0u) << offset;
    Receiver random;
    std::mt19937 order(2);
    for (std::uint32_t a = 0, b = offset; a < 6000;)
      random.frame(order() % 2 == 0 ? a++ : b++, 5'000, true);
    EXPECT_EQ(random.lost, 0u) << offset;
    // The second one joins after a minute.
    Receiver joined;
    for (std::uint32_t n = 0; n < 6000; ++n) joined.frame(n, 10'000, true);
    for (std::uint32_t n = 6000; n < 12'000; ++n) {
      joined.frame(n, 5'000, true);
      joined.frame(n + offset, 5'000, true);
    }
    EXPECT_EQ(joined.lost, 0u) << offset;
  }
}

// As in the attack: 34,000 frames/s in bursts, the numbers a few hundred to 20,000 apart. However
// close they are, no more is lost than a sender of this rate could have sent beside them.
TEST(FrameNumbers, AFloodOfTwoNumberingsLosesNoMoreThanItsTimeHolds) {
  for (const std::uint32_t offset : {2U, 20U, 64U, 300U, 12'000U, 20'000U}) {
    Receiver receiver;
    std::mt19937 order(3);
    std::uint32_t a = 0, b = offset;
    for (int i = 0; i < 169'500; ++i)
      receiver.frame(order() % 2 == 0 ? a++ : b++, i % 34 == 0 ? 1000 : 0, true);
    EXPECT_LE(receiver.lost, 169'500u) << offset;
  }
}

TEST(FrameNumbers, WithoutATimeAThousandMayBeMissing) {
  FrameNumbers numbers;
  numbers.next(0, std::nullopt, false);
  EXPECT_EQ(numbers.next(1000, std::nullopt, false).missing, 999u);
  EXPECT_EQ(numbers.next(3000, std::nullopt, false).missing, std::nullopt);
  EXPECT_EQ(numbers.next(3001, std::nullopt, false).missing, 0u);
}

TEST(FrameNumbers, OfASenderThatStopsCountingTwoFramesAreLeftOut) {
  FrameNumbers numbers;
  for (std::uint32_t n = 0; n < 10; ++n) numbers.next(n, std::nullopt, false);
  for (int i = 0; i < 1000; ++i)
    EXPECT_EQ(numbers.next(9, std::nullopt, false).repeated, i < 2) << i;
  EXPECT_EQ(numbers.next(10, std::nullopt, false).missing, 0u);
  EXPECT_TRUE(numbers.next(10, std::nullopt, false).repeated);
}

TEST(FrameNumbers, TimesOfAnySizeAreTaken) {
  FrameNumbers numbers;
  numbers.next(0, INT64_MIN, false);
  EXPECT_EQ(numbers.next(1, INT64_MAX, false).missing, 0u);
  EXPECT_EQ(numbers.next(2, INT64_MIN, false).missing, 0u);
  EXPECT_EQ(numbers.next(5, INT64_MIN + 1, false).missing, 2u);
}

}  // namespace
}  // namespace palpate::frame_numbers_test
