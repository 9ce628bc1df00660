// Collects the frames, angles and temperatures of a connected hand at rest for some seconds, as the
// device delivers them, without filters, and makes a profile of them. The tare and the noise floor
// of the connected hand are computed from such a profile as from a recording.
//
// The measurement fails when its frames can't be compared: the hand moves, its settings or its
// scanned taxels change, or the stream is interrupted. A failed measurement gives no profile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/tare.h>
#include <palpate/capture/capture_queue.h>
#include <palpate/model/gap_detector.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile_builder.h>

namespace palpate {

// ProfileInfo::format of a profile that was measured live.
inline constexpr const char* kLiveMeasurementFormat = "live";

struct LiveMeasurementOptions {
  // Time from the first frame to the last one [s], 1..3600.
  double seconds = 5.0;
  // The hand moves when a joint is further from its first angle [deg], > 0.
  double maxTravelDeg = 1.0;
  // The first frame must arrive within this time [s], > 0. After a change of settings the stream
  // pauses for half a second per matrix.
  double firstFrameWithinS = 5.0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Not thread-safe.
class LiveMeasurement {
 public:
  enum class State { kRunning, kComplete, kFailed };

  // `hand`: of the device whose items are added. Throws std::invalid_argument (options, a hand
  // without layout).
  explicit LiveMeasurement(HandDescription hand, const LiveMeasurementOptions& options = {});

  // Adds an item of the device, in the order of the queue. Has no effect unless running.
  void add(const CaptureItem& item);
  // To be called while no item arrives: the time since the last frame, or since the start [s].
  void noteSilence(double seconds);
  // Ends the measurement; `why` in one line. Has no effect unless running.
  void fail(std::string why);

  State state() const noexcept { return state_; }
  // Why it failed, in one line; empty unless failed.
  const std::string& failure() const noexcept { return failure_; }
  // Time still to be measured [s]; 0 when complete.
  double secondsLeft() const noexcept;
  std::size_t numFrames() const noexcept { return builder_.numFrames(); }
  // Taxels that exist and are scanned, over all matrices.
  std::size_t numScanned() const noexcept { return numScanned_; }
  // Frames that were sent but not received, as far as the device or the queue reported them.
  std::uint64_t numLost() const noexcept { return numLost_; }
  // Frames with a time that isn't later than the previous one, or a value that is no number.
  std::uint64_t numUnusable() const noexcept { return numUnusable_; }
  // What is missing in the profile, one line each; empty: nothing.
  std::vector<std::string> warnings() const;

  // Returns the profile. `info`: what is known of the device; format and warnings are set here.
  // Throws std::logic_error unless complete, and when called again.
  Profile takeProfile(ProfileInfo info = {});

 private:
  void addFrame(const TactileFrame& frame);
  void addAngles(const Sample& angles);
  void addTemperatures(const Sample& temperatures);
  void addEvent(const Event& event);

  const LiveMeasurementOptions options_;
  const HandDescription hand_;
  std::size_t numScanned_ = 0;
  ProfileBuilder builder_;
  GapDetector gaps_;
  State state_ = State::kRunning;
  bool taken_ = false;
  std::string failure_;
  std::int64_t firstUs_ = 0;  // stamps of the frames [us since 1970]
  std::int64_t lastUs_ = 0;
  std::vector<double> firstDeg_;
  std::uint64_t numLost_ = 0;
  std::uint64_t numUnusable_ = 0;
};

}  // namespace palpate
