#include "palpate/core/bounded_queue.h"

#include <memory>
#include <thread>

#include "testing/testing.h"

namespace palpate::bounded_queue_test {
namespace {

TEST(BoundedQueue, HandsOutInOrderAndCounts) {
  BoundedQueue<int> queue(3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.tryPush(i));
  EXPECT_FALSE(queue.tryPush(3));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(queue.tryPop(), i);
  EXPECT_EQ(queue.tryPop(), std::nullopt);
  const QueueStats stats = queue.stats();
  EXPECT_EQ(stats.pushes, 3u);
  EXPECT_EQ(stats.pops, 3u);
  EXPECT_EQ(stats.overflows, 1u);
  EXPECT_EQ(stats.highWater, 3u);
}

TEST(BoundedQueue, CloseEndsWaitingAndStillHandsOutTheRest) {
  BoundedQueue<int> queue(2);
  queue.push(1);
  queue.close();
  EXPECT_FALSE(queue.push(2));
  EXPECT_FALSE(queue.tryPush(2));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, CloseWakesAWaitingReaderAndAWaitingWriter) {
  BoundedQueue<int> empty(1);
  std::jthread reader([&] { EXPECT_EQ(empty.pop(), std::nullopt); });
  BoundedQueue<int> full(1);
  full.push(1);
  std::jthread writer([&] { EXPECT_FALSE(full.push(2)); });
  empty.close();
  full.close();
}

TEST(BoundedQueue, LosesNothingBetweenThreads) {
  constexpr int kItems = 20'000;
  BoundedQueue<std::unique_ptr<int>> queue(7);  // move-only items, far fewer places than items
  std::jthread writer([&] {
    for (int i = 0; i < kItems; ++i) queue.push(std::make_unique<int>(i));
    queue.close();
  });
  int expected = 0;
  while (auto item = queue.pop()) ASSERT_EQ(**item, expected++);
  EXPECT_EQ(expected, kItems);
  const QueueStats stats = queue.stats();
  EXPECT_EQ(stats.pushes, static_cast<std::uint64_t>(kItems));
  EXPECT_EQ(stats.pops, stats.pushes);
  EXPECT_LE(stats.highWater, 7u);
}

TEST(BoundedQueue, RefusesToHoldNothing) {
  EXPECT_THROW(BoundedQueue<int>(0), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::bounded_queue_test
