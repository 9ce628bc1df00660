// Driver of the SDH-2's motion controller: asks and sets its seven axes. Synchronous; the one
// thread that owns the port uses it.
//
// Every value that is sent is checked before the first byte leaves (std::invalid_argument names
// axis, value and range; nothing was sent), and every set names all seven axes: none becomes 0 by
// omission. `grip` and `selgrip` aren't here: the hand is deaf to a stop until they end. All calls
// are bounded in time (5 s, a reference run 20 s) and throw DeviceError: kSilent (no answer),
// kRefused (error code, with its meaning), kProtocol (answers arrive damaged), kUnsupported
// (firmware too old), kDisconnected; SdhInterrupted (see SdhControllerOptions::urgent).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>

namespace palpate {

// An exchange was given up because a stop was urgent. `stop` is on the wire; stop() confirms it.
class SdhInterrupted : public DeviceError {
 public:
  explicit SdhInterrupted(const std::string& port)
      : DeviceError(DeviceFault::kSilent, port, "given up for a stop") {}
};

struct SdhControllerOptions {
  // True as long as a stop waits for this thread. Asked before an exchange, between its tries, and
  // while it waits longer than 10 ms (every 4 ms; ByteChannel::interrupt() shortens that): then
  // `stop` goes out and the call ends with SdhInterrupted. Every call but stop() does so until it
  // is false again, so whoever answers it must call stop(). A reference run is not given up: the
  // hand is deaf until it ends.
  std::function<bool()> urgent;
};

struct SdhControllerInfo {
  std::string firmware;  // "0.0.3.3"
  std::string date;      // of the firmware
  std::string soc;       // FPGA design
  std::string serial;    // of the hand; the last three are empty where the hand doesn't tell
  std::string id;
  std::vector<double> maximumVelocity;      // per axis, as the hand says; else the model's [deg/s]
  std::vector<double> maximumAcceleration;  // per axis, likewise [deg/s^2]
  int controller = 0;                       // 0 pose, 1 velocity, 2 velocity with ramp
};

// Counts since construction.
struct SdhStats {
  std::uint64_t exchanges = 0;  // questions
  std::uint64_t retries = 0;    // questions asked again
  std::uint64_t resyncs = 0;    // the line was brought back into step
  std::uint64_t badChecksums = 0;
  std::uint64_t suspect = 0;       // right form, impossible content: dropped
  std::uint64_t strayReplies = 0;  // answers nobody waited for
  std::uint64_t debugLines = 0;    // beginning with @
  std::uint64_t skippedBytes = 0;  // outside of any answer
  std::uint64_t bytesRead = 0;
  std::uint64_t bytesWritten = 0;
  std::uint64_t stops = 0;  // times `stop` was sent
};

enum class SdhCurrent { kMotion, kGrip, kHold };          // ilim, igrip, ihold
enum class SdhSoftLimit { kMinimum, kMaximum, kOffset };  // p_min, p_max, p_offset

class SdhLink;
struct SdhRetryPolicy;
struct SdhQuantity;

class SdhController {
 public:
  using Values = std::vector<double>;  // one per axis

  // The channel must outlive the driver.
  explicit SdhController(ByteChannel& channel,
                         const Clock& clock = systemClock(),
                         SdhControllerOptions options = {});
  ~SdhController();
  SdhController(const SdhController&) = delete;
  SdhController& operator=(const SdhController&) = delete;

  // Finds the controller and asks what it is. Besides the above: kWrongDevice (a tactile controller
  // sends here: ports swapped; or the hand has not seven axes). An idle tactile controller is
  // kSilent.
  const SdhControllerInfo& open();
  const SdhControllerInfo& facts() const noexcept { return facts_; }
  SdhStats stats() const noexcept;

  // What the axes do.
  Values angles();               // [deg]
  Values velocities();           // [deg/s]
  Values referenceVelocities();  // of controller 2 [deg/s]; firmware 0.0.2.6
  std::vector<int> states();     // Device::axisStates()
  Values temperatures();         // nine: motors 0..6, FPGA, circuit board [deg C]

  // Targets. Angles move nothing until move(); velocities move at once unless the controller is 0.
  Values targets();           // [deg]
  Values targetVelocities();  // [deg/s]
  Values accelerations();     // [deg/s^2]
  Values setTargets(const Values& deg);
  Values setVelocities(const Values& degPerS);
  Values setAccelerations(const Values& degPerS2);
  // All seven are read, one is changed, all seven are written.
  Values setTarget(std::size_t axis, double deg);
  Values setVelocity(std::size_t axis, double degPerS);
  Values setAcceleration(std::size_t axis, double degPerS2);
  // Target and actual value in one round trip; returns what velocities() or angles() would.
  Values setTargetsGetAngles(const Values& deg);
  Values setVelocitiesGetVelocities(const Values& degPerS);

  Values power();  // 0 or 1 per axis
  Values setPower(const Values& onOff);
  Values setPower(bool on);
  Values setAxisPower(std::size_t axis, bool on);

  // Starts the motion to the targets; all axes arrive together. Returns at once, with the announced
  // duration [s]: poll states() until none is 1.
  double move();
  // Duration of the motion that move() would start [s].
  double pendingDuration();
  // Stops a motion, power stays on. Goes out at once, whatever was going on before.
  void stop();

  int controller();  // firmware 0.0.2.6
  void setController(int controller);
  int profile();  // of `m`: 0 sin-square, 1 ramp (can be retargeted in motion without a jerk)
  void setProfile(int profile);

  Values velocityLimits();                                       // firmware 0.0.2.1 [deg/s]
  Values accelerationLimits();                                   // firmware 0.0.2.7 [deg/s^2]
  Values currentLimits(SdhCurrent of);                           // [A]
  Values setCurrentLimits(SdhCurrent of, const Values& ampere);  // 0..1
  Values softLimits(SdhSoftLimit which);                         // [deg]
  Values setSoftLimits(SdhSoftLimit which, const Values& deg);
  double velocityGain(std::size_t axis);
  void setVelocityGain(std::size_t axis, double gain);
  std::array<double, 3> pid(std::size_t axis);
  void setPid(std::size_t axis, const std::array<double, 3>& gains);
  // Moves axes without absolute encoder to a stop: 0 not, 1 to the positive one, 2 to the negative
  // one. Blocks up to 15 s, and the hand is deaf to stop() until it ends: warn the user before.
  void referenceRun(const std::vector<int>& direction);
  // Stores the actual angle in the hand's flash where the value is 1.
  void savePositions(const std::vector<int>& axes);

 private:
  // One vector command: all seven values in, all seven out. `values` empty: get.
  Values exchange(const SdhQuantity& quantity, const Values& values);
  Values withAxis(std::size_t axis, Values values, double value) const;
  std::string word(const std::string& command, const SdhRetryPolicy& retryPolicy);
  // The number(s) of the answer NAME=.. or NAME(axis)=.. to a request.
  Values numbers(const std::string& request,
                 std::string_view name,
                 std::optional<int> axis,
                 const SdhQuantity& quantity,
                 std::size_t count,
                 const SdhRetryPolicy& retryPolicy);
  void readInfo();
  void needFirmware(const std::string& what, int a, int b, int c, int d) const;
  Values checkedVelocities(const Values& degPerS) const;

  std::unique_ptr<SdhLink> link_;
  SdhControllerInfo facts_;
  bool binary_ = false;  // records, not lines, where both exist
};

}  // namespace palpate
