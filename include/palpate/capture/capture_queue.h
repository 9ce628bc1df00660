// Bounded queues from a capture session to one consumer (the recorder, live processing): one for
// tactile frames, one for the samples of series, one for events. They never make the device wait
// and never drop an item silently.
//
// Items that don't fit are lost. An event of kind "gap" then covers exactly the lost time span:
// stamps of the first and the last lost item, and their number.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <palpate/core/bounded_queue.h>
#include <palpate/model/event.h>
#include <palpate/model/series.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Frames are shared by all consumers and never changed.
using SharedFrame = std::shared_ptr<const TactileFrame>;
using CaptureItem = std::variant<SharedFrame, Sample, Event>;

// What an item belongs to: frames, a series (1 + its index), events.
enum class CaptureStream : std::uint8_t {
  kTactile = 0,
  kAngles = 1 + kAngleSeries,
  kTemperatures = 1 + palpate::kTemperatureSeries,
  kEvents = 1 + kMaxSeries
};
constexpr std::size_t kCaptureStreams = 2 + kMaxSeries;

CaptureStream streamOf(const CaptureItem& item) noexcept;
// The sample, if it is one of that series, otherwise null.
const Sample* sampleOf(const CaptureItem& item, std::size_t series) noexcept;
// Time stamp [us since 1970]; of an event its begin.
std::int64_t stampOf(const CaptureItem& item) noexcept;
// Whether the item may take a place of `used` of `most`: the series beside those of the hand, which
// others send as fast as they like, leave half of it to the hand.
bool leavesRoom(const CaptureItem& item, std::size_t used, std::size_t most) noexcept;
// Order by stamps; at equal times events, samples (the later series first), then the frame they
// belong to.
bool isEarlier(const CaptureItem& a, const CaptureItem& b) noexcept;

// Consecutive lost items of one stream.
struct CaptureLoss {
  std::int64_t firstUs = 0;  // stamp of the first one lost [us since 1970]
  std::int64_t lastUs = 0;
  std::uint64_t count = 0;
};
// The loss as an event of kind "gap": text for the user, json {"stream", "lost", "reason"}.
// `series`: the names of all series; may be empty.
Event gapEvent(CaptureStream stream,
               const CaptureLoss& loss,
               std::string_view reason,
               const std::vector<std::string>& series = {});

struct CaptureQueueOptions {
  // Capacity for frames: 27 s at 300 frames/s, 258 s at 31.7. An SDH-2's frame takes 2.1 kB: 17 MB
  // when full. An empty place takes 136 bytes.
  std::size_t tactileItems = 8192;
  // Capacity for the samples of all series: 73 s at 111/s; 0.2 kB each: 1.6 MB when full. Half of
  // it is for the hand's alone: the others have 4 s at 1 kHz.
  std::size_t motionItems = 8192;
  std::size_t eventItems = 1024;
  // True: the producer waits for room instead of losing items; only for a replay, which can wait.
  bool blockWhenFull = false;
  // A waiting consumer wakes when a queue contains this number of items; the recorder checks every
  // 80 ms in any case, every 100 ms without a recording.
  std::size_t wakeAtItems = 1;
  std::vector<std::string> series = {};  // the names of all series, for gaps; may be empty
  // A session leaves out the series beside those of the hand, and what their sources tell: for who
  // moves the hand.
  bool onlyHand = false;
};

struct CaptureQueueStats {
  struct Port {
    std::size_t depth = 0;      // items waiting now
    std::size_t highWater = 0;  // maximum so far
    std::size_t capacity = 0;
  };
  Port tactile;
  Port motion;
  Port events;
  std::array<std::uint64_t, kCaptureStreams> lost{};  // by CaptureStream, since construction
};

// Any number of threads may call put(); one consumer calls take().
class CaptureQueue {
 public:
  // `consumer` is named in the text of gaps ("the recorder"). Throws std::invalid_argument for a
  // capacity of 0.
  explicit CaptureQueue(std::string consumer, const CaptureQueueOptions& options = {});
  CaptureQueue(const CaptureQueue&) = delete;
  CaptureQueue& operator=(const CaptureQueue&) = delete;

  // The names of all series, for gaps. Safe from any thread.
  void nameSeries(std::vector<std::string> names);
  // Returns false when the item was lost (and counted) or the queue is closed.
  bool put(CaptureItem item);
  // Appends all waiting items to `out` in order of time (at equal times: events, temperatures,
  // angles, then the frame they belong to), including completed gaps. Never waits. Returns the
  // number of items. `ownGaps` receives copies of the gaps that this queue itself caused; gaps of
  // the device are only in `out`.
  std::size_t take(std::vector<CaptureItem>& out, std::vector<Event>* ownGaps = nullptr);
  // Completes the gaps that no later item has completed yet, and appends them.
  void takeOpenGaps(std::vector<CaptureItem>& out, std::vector<Event>* ownGaps = nullptr);
  // Waits for `wakeAtItems` items, wake(), close(), a stop request or the timeout.
  void wait(std::chrono::microseconds timeout, const std::stop_token& stop = {});
  void wake();
  // Ends all waiting; later items are rejected.
  void close();
  bool closed() const noexcept { return closed_.load(); }
  bool onlyHand() const noexcept { return options_.onlyHand; }
  CaptureQueueStats stats() const;

 private:
  BoundedQueue<CaptureItem>& queueOf(CaptureStream stream);

  const std::string consumer_;
  CaptureQueueOptions options_;
  BoundedQueue<CaptureItem> tactile_;
  BoundedQueue<CaptureItem> motion_;
  BoundedQueue<CaptureItem> events_;
  std::atomic<bool> closed_ = false;

  mutable std::mutex lossMutex_;
  std::array<std::optional<CaptureLoss>, kCaptureStreams> open_;
  std::vector<Event> ended_;  // gap events to be returned by take()
  std::array<std::uint64_t, kCaptureStreams> lost_{};

  std::mutex wakeMutex_;
  std::condition_variable_any wake_;
  bool woken_ = false;
};

}  // namespace palpate
