// A recording as a device: delivers its frames, angles, temperatures and events again, in order of
// time, with their own stamps and values, bit by bit.
//
// At equal times events come first, then temperatures, angles and the frame, so that the samples
// that belong to a frame (the last ones at or before it) precede it. Gaps are replayed, too.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/device/device.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>

namespace palpate {

enum class ReplayPace {
  kRecorded,  // by its stamps, times speed, on a thread of its own
  kUnpaced,   // without pauses, on a thread of its own: for a sink that can wait
  kManual,    // by calls of advance(), without a thread
};

struct ReplayOptions {
  ReplayPace pace = ReplayPace::kRecorded;
  double speed = 1.0;  // 0.1..16; used by kRecorded
};

class Replay : public Device {
 public:
  // The clock must outlive the replay. Throws std::invalid_argument (speed).
  explicit Replay(Profile profile,
                  const ReplayOptions& options = {},
                  std::vector<Event> events = {},
                  const Clock& clock = systemClock());
  ~Replay() override;
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  HandDescription hand() const override;
  DeviceInfo info() const override;
  std::vector<SeriesDescription> series() const override;
  // Starts at the beginning. A sample that, or whose time, can't be read is counted as lost
  // and skipped; the first such sample causes an event "alarm". At the end comes an event "link".
  // Any other exception in the delivering thread, also one of the sink, ends the replay with an
  // event "alarm" and the state kFault; it never leaves the thread.
  void start(DeviceSink& sink) override;
  void stop() noexcept override;
  DeviceStatus status() const override;
  // A recording accepts no command: the future holds a DeviceError kUnsupported.
  std::future<CommandAnswer> submit(DeviceCommand command) override;

  // Throws std::invalid_argument outside 0.1..16. Safe at any time.
  void setSpeed(double factor);
  // For kManual: delivers the items of the next `recordedUs` of the recording's time [us, >= 0].
  // The first item is at 0. Throws std::logic_error when not started or with another pace.
  void advance(std::int64_t recordedUs);
  // True when everything was delivered.
  bool finished() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
