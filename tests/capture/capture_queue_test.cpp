#include "palpate/capture/capture_queue.h"

#include <thread>

#include "palpate/core/json.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::capture_queue_test {
namespace {
using namespace testing;

CaptureItem frameAt(std::int64_t hostUs) {
  return std::make_shared<const TactileFrame>(numberedFrame(0, hostUs));
}

CaptureQueueOptions small(std::size_t items) {
  CaptureQueueOptions options;
  options.tactileItems = options.motionItems = options.eventItems = items;
  return options;
}

std::vector<CaptureItem> taken(CaptureQueue& queue) {
  std::vector<CaptureItem> items;
  queue.take(items);
  return items;
}

TEST(CaptureQueue, handsOutInOrderOfTimeWhateverThePort) {
  CaptureQueue queue("nobody");
  queue.put(frameAt(20));
  queue.put(frameAt(40));
  queue.put(Sample{10, {1.0}});
  queue.put(Sample{40, {2.0}});
  queue.put(Sample{40, {30.0}, kTemperatureSeries});
  queue.put(Event{30, 30, "label", {}, "x", ""});
  std::vector<std::int64_t> stamps;
  std::vector<CaptureStream> streams;
  for (const CaptureItem& item : taken(queue)) {
    stamps.push_back(stampOf(item));
    streams.push_back(streamOf(item));
  }
  EXPECT_EQ(stamps, (std::vector<std::int64_t>{10, 20, 30, 40, 40, 40}));
  // The angles that belong to a frame are the last ones at or before it, so they precede it.
  EXPECT_EQ(streams[3], CaptureStream::kTemperatures);
  EXPECT_EQ(streams[4], CaptureStream::kAngles);
  EXPECT_EQ(streams[5], CaptureStream::kTactile);
  EXPECT_TRUE(taken(queue).empty());
}

TEST(CaptureQueue, whatDoesNotFitIsOneGapOverExactlyTheLostSpan) {
  CaptureQueue queue("the test", small(3));
  for (std::int64_t t = 1; t <= 8; ++t) EXPECT_EQ(queue.put(frameAt(t)), t <= 3);
  EXPECT_EQ(queue.stats().lost[0], 5u);
  EXPECT_EQ(queue.stats().tactile.depth, 3u);
  EXPECT_EQ(queue.stats().tactile.highWater, 3u);
  EXPECT_EQ(taken(queue).size(), 3u);  // the gap is still open
  EXPECT_TRUE(queue.put(frameAt(9)));
  const auto items = taken(queue);
  ASSERT_EQ(items.size(), 2u);
  const auto& gap = std::get<Event>(items[0]);
  EXPECT_EQ(gap.kind, "gap");
  EXPECT_EQ(gap.tUs, 4);
  EXPECT_EQ(gap.t1Us, 8);
  EXPECT_EQ(Json::parse(gap.json).at("lost").asInteger(), 5);
  EXPECT_EQ(Json::parse(gap.json).at("stream").asString(), "tactile");
  EXPECT_EQ(gap.text, "5 frames lost: the test could not keep up");
  EXPECT_EQ(stampOf(items[1]), 9);
  EXPECT_TRUE(taken(queue).empty());
}

TEST(CaptureQueue, onePortThatOverflowsCostsTheOtherNothing) {
  CaptureQueue queue("the test", small(2));
  for (std::int64_t t = 1; t <= 5; ++t) queue.put(Sample{t, {0.0}});
  EXPECT_TRUE(queue.put(frameAt(6)));
  EXPECT_TRUE(queue.put(Event{7, 7, "mark", {}, "", ""}));
  const auto lost = queue.stats().lost;
  EXPECT_EQ(lost[static_cast<std::size_t>(CaptureStream::kAngles)], 3u);
  EXPECT_EQ(std::count(lost.begin(), lost.end(), 0u), static_cast<std::ptrdiff_t>(lost.size() - 1));
  std::vector<CaptureItem> open;
  queue.takeOpenGaps(open);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(std::get<Event>(open[0]).text, "3 angle samples lost: the test could not keep up");
  queue.takeOpenGaps(open);
  EXPECT_EQ(open.size(), 1u);  // reported once
}

TEST(CaptureQueue, everyItemIsEitherHandedOutOrInAGap) {
  CaptureQueue queue("the test", small(7));
  std::uint64_t got = 0;
  std::uint64_t gone = 0;
  const auto count = [&](std::vector<CaptureItem> items) {
    for (const CaptureItem& item : items) {
      if (const auto* event = std::get_if<Event>(&item))
        gone += static_cast<std::uint64_t>(Json::parse(event->json).at("lost").asInteger());
      else
        ++got;
    }
  };
  for (std::int64_t t = 1; t <= 1000; ++t) {
    queue.put(frameAt(t));
    if (t * t % 11 == 0) count(taken(queue));
  }
  count(taken(queue));
  std::vector<CaptureItem> open;
  queue.takeOpenGaps(open);
  count(open);
  EXPECT_GT(gone, 0u);
  EXPECT_EQ(got + gone, 1000u);
  EXPECT_EQ(queue.stats().lost[0], gone);
}

TEST(CaptureQueue, aReplayWaitsForRoomAndLosesNothing) {
  CaptureQueueOptions options = small(4);
  options.blockWhenFull = true;
  CaptureQueue queue("the test", options);
  std::jthread producer([&queue] {
    for (std::int64_t t = 1; t <= 500; ++t) queue.put(frameAt(t));
  });
  std::int64_t expected = 1;
  while (expected <= 500) {
    queue.wait(std::chrono::seconds(1));
    for (const CaptureItem& item : taken(queue)) ASSERT_EQ(stampOf(item), expected++);
  }
  EXPECT_EQ(queue.stats().lost[0], 0u);
}

TEST(CaptureQueue, closingEndsAllWaiting) {
  CaptureQueueOptions options = small(1);
  options.blockWhenFull = true;
  CaptureQueue queue("the test", options);
  ASSERT_TRUE(queue.put(frameAt(1)));
  std::atomic<bool> refused = false;
  std::jthread producer([&] { refused = !queue.put(frameAt(2)); });
  queue.close();
  producer.join();
  EXPECT_TRUE(refused);
  queue.wait(std::chrono::hours(1));  // returns at once
  EXPECT_FALSE(queue.put(frameAt(3)));
  EXPECT_EQ(taken(queue).size(), 1u);
}

TEST(CaptureQueue, needsRoomForOneItem) {
  EXPECT_THROW(CaptureQueue("x", small(0)), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::capture_queue_test
