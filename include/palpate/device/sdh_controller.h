// Driver of the SDH-2's motion controller: reads and sets its seven axes. All calls are synchronous
// and belong to the one thread that owns the port.
//
// Every value is checked before the first byte is sent (std::invalid_argument names axis, value and
// range; nothing was sent then). Every set command contains all seven axes, so that no axis becomes
// 0 by omission. `grip` and `selgrip` are not implemented, because the hand ignores a stop until
// they end. All calls are bounded in time (5 s, a reference run 20 s) and throw DeviceError:
// kSilent (no answer), kRefused (error code, with its meaning), kProtocol (answers arrive damaged),
// kUnsupported (firmware too old), kDisconnected; or SdhInterrupted (see
// SdhControllerOptions::urgent).
#pragma once

#include <array>
#include <chrono>
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

// An exchange was ended early for an urgent stop. `stop` has been sent; stop() confirms it.
class SdhInterrupted : public DeviceError {
 public:
  explicit SdhInterrupted(const std::string& port)
      : DeviceError(DeviceFault::kSilent,
                    port,
                    "this request wasn't finished: the stop of the hand came first") {}
};

struct SdhControllerOptions {
  // Returns true as long as a stop waits for this thread. It is called before an exchange, between
  // its tries, and every 4 ms while an exchange waits longer than 10 ms (ByteChannel::interrupt()
  // shortens that). When it returns true, `stop` is sent and the call ends with SdhInterrupted.
  // Every call except stop() does so until it returns false again, so its owner must call stop(). A
  // reference run is not ended early: the hand ignores all input until it ends.
  std::function<bool()> urgent;
};

struct SdhControllerInfo {
  std::string firmware;  // "0.0.3.3"
  std::string date;      // release date of the firmware
  std::string soc;       // version of the FPGA design
  // Serial number of the hand. Date, soc and serial are empty where the hand does not report them.
  std::string serial;
  std::string id;
  // Maximum velocity per axis as the hand reports it, otherwise from its description [deg/s].
  std::vector<double> maximumVelocity;
  // Maximum acceleration per axis, from the same source [deg/s^2].
  std::vector<double> maximumAcceleration;
  int controller = 0;  // 0 pose, 1 velocity, 2 velocity with ramp
};

// Counts since construction.
struct SdhStats {
  std::uint64_t exchanges = 0;  // requests with their answers
  std::uint64_t retries = 0;    // requests sent again
  // Number of resynchronisations of the line, after lost or damaged bytes.
  std::uint64_t resyncs = 0;
  std::uint64_t badChecksums = 0;
  // Replies with a correct form but impossible content; they are dropped.
  std::uint64_t suspect = 0;
  std::uint64_t strayReplies = 0;  // answers to no pending request
  std::uint64_t debugLines = 0;    // lines that begin with @
  std::uint64_t skippedBytes = 0;  // bytes outside of any answer
  std::uint64_t bytesRead = 0;
  std::uint64_t bytesWritten = 0;
  std::uint64_t stops = 0;  // times `stop` was sent
};

enum class SdhCurrent { kMotion, kGrip, kHold };          // commands ilim, igrip, ihold
enum class SdhSoftLimit { kMinimum, kMaximum, kOffset };  // commands p_min, p_max, p_offset

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

  // Finds the controller and reads its properties. In addition to the faults above it throws
  // kWrongDevice (a tactile controller sends at this port: ports swapped; or the hand does not have
  // seven axes). An idle tactile controller causes kSilent.
  const SdhControllerInfo& open();
  // From now on, answers of the hand may be missing or not valid for at most `limit` (0: no limit
  // but those of each call): requests are repeated within it, also those that the hand refuses, and
  // the call in which it is exceeded throws. The limit begins with the first such answer; a single
  // one does not exceed it. For a hand that may be moving.
  void limitBadAnswers(std::chrono::milliseconds limit) noexcept;
  const SdhControllerInfo& info() const noexcept { return info_; }
  SdhStats stats() const noexcept;

  // Actual state of the axes.
  Values angles();      // [deg]
  Values velocities();  // [deg/s]
  // Reference velocities of controller 2 [deg/s]; requires firmware 0.0.2.6.
  Values referenceVelocities();
  std::vector<int> states();  // values as in Device::axisStates()
  Values temperatures();      // nine: motors 0..6, FPGA, circuit board [deg C]

  // Targets. Target angles cause no motion until move(); target velocities act at once unless the
  // controller is 0.
  Values targets();           // [deg]
  Values targetVelocities();  // [deg/s]
  Values accelerations();     // [deg/s^2]
  Values setTargets(const Values& deg);
  Values setVelocities(const Values& degPerS);
  Values setAccelerations(const Values& degPerS2);
  // These read all seven values, change one and write all seven.
  Values setTarget(std::size_t axis, double deg);
  Values setVelocity(std::size_t axis, double degPerS);
  Values setAcceleration(std::size_t axis, double degPerS2);
  // Sets the target and reads the actual value in one round trip; returns the same as angles() or
  // velocities().
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
  // Stops a motion; power stays on. The command is sent at once, even during another exchange. It
  // is confirmed by STOP, or by another line and valid states of axes that don't move.
  void stop();

  int controller();  // requires firmware 0.0.2.6
  void setController(int controller);
  // Velocity profile of `m`: 0 sin-square, 1 ramp (accepts a new target during motion without a
  // jerk).
  int profile();
  void setProfile(int profile);

  Values velocityLimits();              // requires firmware 0.0.2.1 [deg/s]
  Values accelerationLimits();          // requires firmware 0.0.2.7 [deg/s^2]
  Values currentLimits(SdhCurrent of);  // [A]
  Values setCurrentLimits(SdhCurrent of, const Values& ampere);  // 0..1
  Values softLimits(SdhSoftLimit which);                         // [deg]
  Values setSoftLimits(SdhSoftLimit which, const Values& deg);
  double velocityGain(std::size_t axis);
  void setVelocityGain(std::size_t axis, double gain);
  std::array<double, 3> pid(std::size_t axis);
  void setPid(std::size_t axis, const std::array<double, 3>& gains);
  // Moves axes without an absolute encoder to a mechanical stop. Values per axis: 0 does not move
  // it, 1 moves it to the positive stop, 2 to the negative one. Blocks up to 15 s, and the hand
  // ignores stop() until it ends: warn the user before.
  void referenceRun(const std::vector<int>& direction);
  // Stores the actual angle in the hand's flash for every axis whose value is 1.
  void savePositions(const std::vector<int>& axes);

 private:
  // Executes one command with seven values in and seven out. Empty `values` mean a read request.
  Values exchange(const SdhQuantity& quantity, const Values& values);
  Values exchange(const SdhQuantity& quantity,
                  const Values& values,
                  const SdhRetryPolicy& retryPolicy);
  Values withAxis(std::size_t axis, Values values, double value) const;
  std::string word(const std::string& command, const SdhRetryPolicy& retryPolicy);
  // The numbers of the answer NAME=.. or NAME(axis)=.. to a request.
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
  SdhControllerInfo info_;
  // True when binary records are used for the commands that exist in both forms.
  bool binary_ = false;
};

}  // namespace palpate
