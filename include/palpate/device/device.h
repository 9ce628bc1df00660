// Interface of every source that delivers frames and takes commands: a live hand on its ports
// (LiveHand) or the replay of a recording (Replay). Capture sessions work on this interface.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <palpate/device/port_probe.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/series.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Kinds of events that devices tell of: "gap" (no frames arrived in between), "link" (connected,
// lost, restored), "settings" (the stream was paused to change settings), "clock" (the wall clock
// jumped), "motion" (a command to the joints), "alarm".
//
// The JSON of "gap" is {"seconds": 3.2, "lost": 101, "estimated": true}. The lost frames are
// counted by the controller's clock if that clock continued; otherwise they are estimated from the
// usual frame rate and "estimated" is true. "lost" is absent where no rate was known.
//
// That of a series beside those of the hand has its name, too: {"stream": "wrist", ..}; "lost" are
// samples then.
//
// The JSON of "settings" contains all settings that hold from then on: {"matrices":
// [{"sensitivity": 0.5, "threshold_counts": 150, "dynamic_mask": "FFFF..0F"}, ..]}. The mask is
// written in capital hexadecimal digits, two per byte. Bit i % 8 (least significant first) of byte
// i / 8 belongs to the place i = y * columns + x; it is 1 where the taxel is scanned (as in the
// protocol).

// Receiver of what a device delivers. It is called from the device's threads, one per port, so
// frames and angles may arrive at the same time. Its functions must return soon: while they run,
// unread bytes collect in the port's buffer.
class DeviceSink {
 public:
  virtual ~DeviceSink() = default;
  virtual void onFrame(TactileFrame&& frame) = 0;
  virtual void onSample(Sample&& sample) = 0;
  virtual void onEvent(Event&& event) = 0;
};

enum class PortState {
  // Not started, or stopped.
  kClosed,
  // The device is being looked for.
  kConnecting,
  // Data are arriving.
  kStreaming,
  // The port is open, but no data arrived for 500 ms (or three periods, if longer).
  kSilent,
  // The port is gone; the device waits for its return.
  kLost,
  // The program failed at this port (out of memory, a bug); the port was closed and is tried again.
  kFault,
};

// State and counts of one port since start(). A snapshot.
struct PortStatus {
  // Name of the port as the caller gave it.
  std::string port;
  PortState state = PortState::kClosed;
  // One line that says what is wrong and what to do; empty when nothing is wrong.
  std::string message;
  // With kLost: whether the port itself has disappeared (unplugged). Otherwise it is there, but the
  // device does not answer, or its answers are not valid.
  bool unplugged = false;
  // The device found at this port instead of the expected one, that is, the hand's other
  // controller. Empty while the expected device answers or nothing is known yet.
  std::optional<PortAnswer> found = {};
  // Number of frames or angle samples delivered.
  std::uint64_t items = 0;
  std::uint64_t bytes = 0;         // bytes read from the port
  std::uint64_t badChecksums = 0;  // packets or answers with a wrong checksum
  // Packets with a correct checksum but implausible content; they are dropped.
  std::uint64_t suspect = 0;
  // Frames of a stream with a value outside of the description of the hand; they are delivered.
  std::uint64_t outOfRange = 0;
  std::uint64_t skippedBytes = 0;  // bytes outside of any packet
  // Number of frames that were sent but never received completely, counted by the device clock.
  // During a gap without device times the number is estimated from the usual rate; estimatedLost
  // counts the frames estimated in this way.
  std::uint64_t lost = 0;
  std::uint64_t estimatedLost = 0;
  std::uint64_t reconnects = 0;
  // Host time of the newest frame or angle sample [us since 1970]; 0 before the first one.
  std::int64_t lastItemUs = 0;
  // Delay of the newest frame, compared with the frame that arrived fastest [ms].
  double ageMs = 0.0;
  std::uint64_t retries = 0;  // requests sent again
  // Host time when the hand was stopped because it moved when it was connected, watched by nobody
  // [us since 1970]; 0: it was not. Of the motion port.
  std::int64_t foundMovingUs = 0;
};

struct DeviceStatus {
  PortStatus tactile;
  // Absent when no motion port was named.
  std::optional<PortStatus> motion;
};

// Commands to a device. Tactile commands pause the stream themselves and cause a "settings" event.
// `matrix` is the index of a matrix; empty for all matrices.
struct SetThreshold {
  std::optional<int> matrix;
  int counts = 0;  // 0..4095
};
struct SetSensitivity {
  std::optional<int> matrix;
  double sensitivity = 0.5;  // 0 (least) .. 1
};
struct SetDynamicMask {
  int matrix = 0;
  Mask mask;  // rows * columns values
};
// Moves all axes so that they arrive together. Every axis must be named.
struct MoveJoints {
  std::vector<double> targetDeg;  // one per axis
  // One velocity per axis; empty leaves the velocities as they are.
  std::vector<double> velocityDegPerS;
  // Velocity profile: true for a ramp, false for sin-square.
  bool ramp = false;
  // Longest time for which the controller's answers may be missing or not valid until the axes are
  // at rest, 0.1..3 [s]. Then the hand is stopped without waiting for an answer, and the port is
  // opened again.
  double answerLimitS = 0.5;
  // Whether this limit also holds once the axes are at rest, since the hand holds an object then.
  bool limitsAnswersAtRest = false;
};
// Stops a motion; the axes stay powered. This command is executed before all waiting commands.
struct StopMotion {};
struct SetPower {
  bool on = false;  // applies to all axes
};
using DeviceCommand =
    std::variant<SetThreshold, SetSensitivity, SetDynamicMask, MoveJoints, StopMotion, SetPower>;

struct CommandAnswer {
  // For MoveJoints: duration announced by the controller [s].
  double durationS = 0.0;
};

// Settings and properties that the controllers reported; empty before the first connection.
struct MatrixSettings {
  double sensitivity = 0.5;
  int thresholdCounts = 0;
  bool operator==(const MatrixSettings&) const = default;
};
struct DeviceInfo {
  // Serial number of the tactile controller, such as "1D9B0057".
  std::string serial;
  // Firmware of the tactile controller.
  std::string firmware;
  // Firmware of the motion controller, such as "0.0.3.3".
  std::string motionFirmware;
  // Settings as last read back from the controller.
  std::vector<MatrixSettings> matrices;
  // Properties of the sensor, in contrast to its controller; empty or 0 when not reported.
  std::string sensorSerial;  // such as "1D9B0057"
  // Revision of the tool that wrote the sensor's description ("generated_by" in a .dsa file).
  int sensorRevision = 0;
  int sensorHardwareRevision = 0;
};

class Device {
 public:
  virtual ~Device() = default;  // stops the device
  // The hand whose frames are delivered. Changes only by a mask command or a reconnection.
  virtual HandDescription hand() const = 0;
  virtual DeviceInfo info() const = 0;
  // The series beside those of the hand that it delivers, in the order of their indexes from
  // kHandSeries on.
  virtual std::vector<SeriesDescription> series() const { return {}; }
  // Starts delivering to `sink`, which must stay valid until stop() returns. Throws
  // std::logic_error when already started. A port that can't be opened causes no exception here:
  // the device looks for it until stop(), and status() reports it.
  virtual void start(DeviceSink& sink) = 0;
  // Ends delivery within 2 s; when it returns, no thread of the device is running.
  virtual void stop() noexcept = 0;
  virtual DeviceStatus status() const = 0;
  // Hands a command to the thread that owns the port; safe from any thread, never waits. The future
  // holds the answer, a DeviceError, or std::invalid_argument (a value was out of range and nothing
  // was sent).
  virtual std::future<CommandAnswer> submit(DeviceCommand command) = 0;
  // True for a controller, which scans at its own rate, given by its layout. False for the replay
  // of a recording, which delivers frames at their recorded times.
  virtual bool isFreeRunning() const { return false; }
  // The event "gap" of a time without frames that has not ended, as if it ended at `untilUs` [us
  // since 1970]; empty: frames come, or their absence is no gap. Its frames are not in the counts
  // of status() yet. Safe from any thread.
  virtual std::optional<Event> openGap(std::int64_t untilUs) const {
    static_cast<void>(untilUs);
    return std::nullopt;
  }
  // Latest axis states (SDH-2: 0 idle, 1 positioning, 2 speed mode, 3 not initialised, 4 and 5
  // blocked, 6 disabled, 7 limit reached); empty where unknown. They are polled while a motion
  // runs; from the motion command until the first poll the state is "positioning".
  virtual std::vector<int> axisStates() const { return {}; }
};

}  // namespace palpate
