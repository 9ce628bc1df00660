// What a capture session hands to one consumer (the recorder, live processing): bounded queues, one
// per port and one for events, that never make the device wait and never drop silently.
//
// What doesn't fit is lost, and comes out later as an event of kind "gap" over exactly the lost
// span: stamps of the first and the last lost item, and how many.
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
#include <palpate/model/hand_state.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/recording/recording_event.h>

namespace palpate {

// Frames are shared by all consumers: nobody changes one.
using SharedFrame = std::shared_ptr<const TactileFrame>;
using CaptureItem = std::variant<SharedFrame, JointAngles, Temperatures, RecordingEvent>;

// Which of them it is; the order of CaptureItem.
enum class CaptureStream : std::uint8_t { kTactile, kAngles, kTemperatures, kEvents };
constexpr std::size_t kCaptureStreams = 4;

CaptureStream streamOf(const CaptureItem& item) noexcept;
std::int64_t stampOf(const CaptureItem& item) noexcept;  // [us since 1970]; of an event its begin
// By their stamps; at one instant events, temperatures, angles, then the frame they belong to.
bool isEarlier(const CaptureItem& a, const CaptureItem& b) noexcept;

// Items of one stream that were lost one after the other.
struct CaptureLoss {
  std::int64_t firstUs = 0;  // stamp of the first one lost [us since 1970]
  std::int64_t lastUs = 0;
  std::uint64_t count = 0;
};
// As an event of kind "gap": text for a person, json {"stream", "lost", "reason"}.
RecordingEvent gapEvent(CaptureStream stream, const CaptureLoss& loss, std::string_view reason);

struct CaptureQueueOptions {
  // Frames that may wait: 27 s at 300 frames/s, 258 s at 31.7. An SDH-2's frame takes 2.1 kB: 17 MB
  // when full. The places themselves take 136 bytes each.
  std::size_t tactileItems = 8192;
  // Angles and temperatures: 73 s at 111/s; 0.2 kB each: 1.6 MB when full.
  std::size_t motionItems = 8192;
  std::size_t eventItems = 1024;
  // Who puts waits for room instead of losing: only for a replay, which can wait.
  bool blockWhenFull = false;
  // Wakes a wait()ing consumer when a queue holds as many; the recorder looks every 15 ms anyway.
  std::size_t wakeAtItems = 1;
};

struct CaptureQueueStats {
  struct Port {
    std::size_t depth = 0;      // items waiting now
    std::size_t highWater = 0;  // most ever
    std::size_t capacity = 0;
  };
  Port tactile;
  Port motion;
  Port events;
  std::array<std::uint64_t, kCaptureStreams> lost{};  // by CaptureStream, since construction
};

// Any number of threads may put; one consumer takes.
class CaptureQueue {
 public:
  // `consumer` is named in the text of gaps ("the recorder"). Throws std::invalid_argument for a
  // capacity of 0.
  explicit CaptureQueue(std::string consumer, const CaptureQueueOptions& options = {});
  CaptureQueue(const CaptureQueue&) = delete;
  CaptureQueue& operator=(const CaptureQueue&) = delete;

  // False: lost (and counted), or the feed is closed.
  bool put(CaptureItem item);
  // Appends what waits to `out`, in order of time (at one instant: events, temperatures, angles,
  // then the frame they belong to), ended gaps among them. Never waits. Returns how many.
  // `ownGaps`: takes copies of the gaps that this queue itself made; those of a device stand in
  // `out` alone.
  std::size_t take(std::vector<CaptureItem>& out, std::vector<RecordingEvent>* ownGaps = nullptr);
  // Ends gaps that no later item has ended yet, and appends them.
  void takeOpenGaps(std::vector<CaptureItem>& out, std::vector<RecordingEvent>* ownGaps = nullptr);
  // Waits until `wakeAtItems` are there, wake(), close(), a stop request or the timeout.
  void wait(std::chrono::microseconds timeout, const std::stop_token& stop = {});
  void wake();
  // Ends all waiting; what comes from now on is not taken.
  void close();
  bool closed() const noexcept { return closed_.load(); }
  CaptureQueueStats stats() const;

 private:
  BoundedQueue<CaptureItem>& queueOf(CaptureStream stream);

  const std::string consumer_;
  const CaptureQueueOptions options_;
  BoundedQueue<CaptureItem> tactile_;
  BoundedQueue<CaptureItem> motion_;
  BoundedQueue<CaptureItem> events_;
  std::atomic<bool> closed_ = false;

  mutable std::mutex lossMutex_;
  std::array<std::optional<CaptureLoss>, kCaptureStreams> open_;
  std::vector<RecordingEvent> ended_;  // gap events to hand out
  std::array<std::uint64_t, kCaptureStreams> lost_{};

  std::mutex wakeMutex_;
  std::condition_variable_any wake_;
  bool woken_ = false;
};

}  // namespace palpate
