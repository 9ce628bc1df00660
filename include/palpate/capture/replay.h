// A recording as a device: its frames, angles, temperatures and events come again, in order of
// time, with their own stamps and values, bit by bit.
//
// At one instant events come first, then temperatures, angles and the frame: what belongs to a
// frame (the last sample at or before it) is there before it. Gaps are replayed, too.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/device/device.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_event.h>

namespace palpate {

enum class ReplayPace {
  kRecorded,  // by its stamps, times speed, on a thread of its own
  kUnpaced,   // one after the other, on a thread of its own: for a sink that can wait
  kManual,    // by advance(), no thread
};

struct ReplayOptions {
  ReplayPace pace = ReplayPace::kRecorded;
  double speed = 1.0;  // 0.1..16; of kRecorded
};

class Replay : public Device {
 public:
  // The clock must outlive the replay. Throws std::invalid_argument (speed).
  explicit Replay(Profile profile,
                  const ReplayOptions& options = {},
                  std::vector<RecordingEvent> events = {},
                  const Clock& clock = systemClock());
  ~Replay() override;
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  HandDescription hand() const override;
  DeviceInfo facts() const override;
  // From the beginning. A sample that can't be read (the file is damaged) is counted as lost and
  // passed over; the first one is told by an event "alarm". At the end comes an event "link". What
  // else goes wrong in the delivering thread, in the sink too, ends the replay with an event
  // "alarm" and the state kFault: it never leaves the thread.
  void start(DeviceSink& sink) override;
  void stop() noexcept override;
  DeviceStatus status() const override;
  // A recording takes no command: a DeviceError, kUnsupported.
  std::future<CommandAnswer> submit(DeviceCommand command) override;

  // Throws std::invalid_argument outside 0.1..16. Safe at any time.
  void setSpeed(double factor);
  // kManual: delivers what comes in the next `recordedUs` of the recording's time [us, >= 0]. The
  // first item comes at 0. Throws std::logic_error: not started, another pace.
  void advance(std::int64_t recordedUs);
  // Everything was delivered.
  bool finished() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
