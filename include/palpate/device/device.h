// What delivers frames and takes commands: a live hand over its ports, or the replay of a
// recording.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <palpate/device/port_probe.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/hand_state.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Something that happened on the line, at a host time or over a span. Kinds: "gap" (no frames came
// in between), "link" (connected, lost, restored), "settings" (stream paused to change them),
// "clock" (the wall clock jumped), "motion" (a command to the joints), "alarm". JSON of "gap":
// {"seconds": 3.2, "lost": 101, "estimated": true}; lost is counted by the controller's clock where
// that went on, else estimated (true) by the usual rate; absent where no rate was known. JSON of
// "settings", all that holds from then on: {"matrices": [{"sensitivity": 0.5, "threshold_counts":
// 150, "dynamic_mask": "FFFF..0F"}, ..]}; the mask in capital hexadecimal digits, two per byte, the
// bit i % 8 of byte i / 8 (least first) is place i = y * columns + x: 1 where the taxel is scanned
// (as on the wire).
struct DeviceEvent {
  std::int64_t tUs = 0;   // [us since 1970]
  std::int64_t t1Us = 0;  // end; equals tUs for a moment
  std::string kind;
  std::optional<int> matrix;
  std::string text;  // one line for a person
  std::string json;  // more of it, one JSON object; may be empty
};

// Who takes what a device delivers. Called from the device's threads, one per port (so frames and
// angles may come at the same time); must return soon: a slow sink makes the port's buffer grow.
class DeviceSink {
 public:
  virtual ~DeviceSink() = default;
  virtual void onFrame(TactileFrame&& frame) = 0;
  virtual void onAngles(JointAngles&& angles) = 0;
  virtual void onTemperatures(Temperatures&& temperatures) = 0;
  virtual void onEvent(DeviceEvent&& event) = 0;
};

enum class PortState {
  // not started, or stopped
  kClosed,
  // looking for the device
  kConnecting,
  // data come
  kStreaming,
  // open, but no data for 500 ms (or three periods, if longer)
  kSilent,
  // the port is gone; looking for its return
  kLost,
  // the program failed at this port (out of memory, a bug); it was closed and is tried anew
  kFault,
};

// Counts since start(). A snapshot.
struct PortStatus {
  std::string port;  // as named by the caller
  PortState state = PortState::kClosed;
  std::string message;  // what is wrong and what to do, one line; empty: nothing
  // What was found there instead, where it is known: the hand's other controller. Nothing: what
  // belongs there, or nobody knows yet.
  std::optional<PortAnswer> found = {};
  std::uint64_t items = 0;         // frames or angle samples delivered
  std::uint64_t bytes = 0;         // read from the port
  std::uint64_t badChecksums = 0;  // packets or answers with a wrong checksum
  std::uint64_t suspect = 0;       // right checksum, implausible content: dropped
  std::uint64_t skippedBytes = 0;  // outside of any packet
  // Number of frames that were sent but never received completely, counted by the device clock.
  // During a gap without device times it is estimated from the usual rate (estimatedLost of them).
  std::uint64_t lost = 0;
  std::uint64_t estimatedLost = 0;
  std::uint64_t reconnects = 0;
  std::int64_t lastItemUs = 0;  // host time of the newest item [us since 1970]; 0: none yet
  double ageMs = 0.0;           // how late the newest frame came, against the fastest one [ms]
  std::uint64_t retries = 0;    // questions asked again
};

struct DeviceStatus {
  PortStatus tactile;
  std::optional<PortStatus> motion;  // absent: no motion port was named
};

// The commands. Tactile ones pause the stream by themselves and leave a "settings" event.
// matrix: an index, or nothing for all.
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
  Mask mask;  // rows * columns
};
// All axes move so that they arrive together. Never partial: all axes are named.
struct MoveJoints {
  std::vector<double> targetDeg;        // one per axis
  std::vector<double> velocityDegPerS;  // one per axis; empty: as they are
  bool ramp = false;                    // velocity profile: ramp instead of sin-square
};
// Stops a motion; the axes stay powered. Goes ahead of everything that waits.
struct StopMotion {};
struct SetPower {
  bool on = false;  // all axes
};
using DeviceCommand =
    std::variant<SetThreshold, SetSensitivity, SetDynamicMask, MoveJoints, StopMotion, SetPower>;

struct CommandAnswer {
  double durationS = 0.0;  // MoveJoints: announced by the controller [s]
};

// What the controllers said about themselves; empty before the first connection.
struct MatrixSettings {
  double sensitivity = 0.5;
  int thresholdCounts = 0;
  bool operator==(const MatrixSettings&) const = default;
};
struct DeviceInfo {
  std::string serial;                    // tactile controller, "1D9B0057"
  std::string firmware;                  // tactile controller
  std::string motionFirmware;            // "0.0.3.3"
  std::vector<MatrixSettings> matrices;  // as last read back
  // Of the sensor, beside its controller; empty, 0: not told.
  std::string sensorSerial;  // "1D9B0057"
  int sensorRevision = 0;    // of the tool that wrote its description ("generated_by" in a .dsa)
  int sensorHardwareRevision = 0;  //
};

class Device {
 public:
  virtual ~Device() = default;  // stops
  // The hand it delivers. Changes only by a mask command or a reconnection.
  virtual HandDescription hand() const = 0;
  virtual DeviceInfo facts() const = 0;
  // Starts delivering to `sink`, which must outlive stop(). Throws std::logic_error when started. A
  // port that can't be opened doesn't throw here: it is looked for until stop(), status() says so.
  virtual void start(DeviceSink& sink) = 0;
  // Ends delivery; when it returns no thread of the device is left. Bounded: under 2 s.
  virtual void stop() noexcept = 0;
  virtual DeviceStatus status() const = 0;
  // Hands a command to the thread that owns the port; safe from any thread, never waits. The future
  // holds the answer or a DeviceError / std::invalid_argument (value out of range: nothing was
  // sent).
  virtual std::future<CommandAnswer> submit(DeviceCommand command) = 0;
  // A controller scans by itself, at a rate that its layout tells; the replay of a recording comes
  // as that came.
  virtual bool isFreeRunning() const { return false; }
  // Latest axis states (SDH-2: 0 idle, 1 positioning, 2 speed mode, 3 not initialised, 4, 5
  // blocked, 6 disabled, 7 limit reached); empty where unknown. Polled while a motion runs;
  // "positioning" from its command on until the hand was asked.
  virtual std::vector<int> axisStates() const { return {}; }
};

}  // namespace palpate
