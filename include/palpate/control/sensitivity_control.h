// Controls sensitivity and thresholds of a hand. High sensitivity: thresholds just above the noise,
// which follow the temperatures and rise when noise overloads the link. Adaptive sensitivity: the
// highest sensitivity without saturation. The rules are in calibration/noise_threshold.h and
// sensitivity_search.h; this class applies them to the device. Each change pauses the stream for
// about 0.5 s; during a motion under tactile control no setting is changed, and pending changes
// wait.
#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/noise_threshold.h>
#include <palpate/calibration/sensitivity_search.h>
#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>
#include <palpate/control/tactile_settings.h>
#include <palpate/core/time.h>

namespace palpate {

enum class SensitivityMode { kManual, kHigh, kAdaptive };

struct SensitivityStatus {
  SensitivityMode mode = SensitivityMode::kManual;
  // Measures the frame rate first, for about 1 s.
  bool measuring = false;
  bool setting = false;  // commands are on their way
  // Reason why the wanted settings can't be applied now, one line; empty: they can.
  std::string waiting;
  std::string failure;         // what the hand said to the last command; empty: it did it
  NoiseThresholdStatus noise;  // of high sensitivity
  double sensitivity = 0.0;    // of adaptive sensitivity: present
  bool settled = false;        // nothing higher is left to try
  bool saturated = false;      // nothing lower is left to try
};

// Of one controlling thread, which calls step() several times a second. Session and control must
// outlive it.
class SensitivityControl {
 public:
  SensitivityControl(CaptureSession& session,
                     GraspControl& control,
                     const Clock& clock = systemClock());

  // Instead of what runs. Throw std::invalid_argument (options; noise lines of a hand with more
  // matrices).
  void beginHighSensitivity(const NoiseFloor& floor, const NoiseThresholdOptions& options = {});
  void beginAdaptiveSensitivity(const SensitivitySearchOptions& options = {});
  // Ends a mode; what is set stays.
  void endMode();
  // Ends a mode and brings the hand to what it has at power-up (0.5; SDH-2: 150 proximal, 300
  // distal).
  void reset();

  void step();
  const SensitivityStatus& status() const noexcept { return status_; }

 private:
  void begin(SensitivityMode mode, const std::string& text);
  void processFrames();
  void onFrame(const TactileFrame& frame);
  void pollReplies();
  void startHighSensitivity();
  void applyWantedSettings();
  double rateHz() const;
  double nowS() const;

  CaptureSession& session_;
  GraspControl& control_;
  const Clock& clock_;
  SensitivityStatus status_;
  std::shared_ptr<CaptureQueue> queue_;  // null: no mode
  std::vector<CaptureItem> items_;
  std::optional<NoiseFloor> floor_;
  NoiseThresholdOptions highOptions_;
  std::optional<NoiseThresholds> high_;  // once the usual rate is known
  std::optional<SensitivitySearch> search_;
  SensitivitySearchOptions searchOptions_;
  std::optional<TactileSettings> wanted_;  // to be set
  std::vector<std::shared_future<CommandAnswer>> pending_;
  // of the newest frames since the last setting [us since 1970]
  std::deque<std::int64_t> stampsUs_;
  std::int64_t settledFromUs_ = 0;  // frames before were made at other settings
  std::vector<double> degC_;        // empty: none came yet
  double begunS_ = 0.0;
};

}  // namespace palpate
