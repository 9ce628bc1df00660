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
  // True while the frame rate is measured at the begin, for about 1 s.
  bool measuring = false;
  bool setting = false;  // commands are being executed
  // Reason why the wanted settings can't be applied now, one line; empty when they can.
  std::string waiting;
  // Error message of the last command; empty after success.
  std::string failure;
  NoiseThresholdStatus noise;  // for high sensitivity
  double sensitivity = 0.0;    // for adaptive sensitivity: present value
  bool settled = false;        // no higher sensitivity is left to try
  bool highest = false;        // the present value is as high as any that is tried
  bool saturated = false;      // no lower sensitivity is left to try
};

// Belongs to one controlling thread, which calls step() several times a second. Session and control
// must outlive it.
class SensitivityControl {
 public:
  SensitivityControl(CaptureSession& session,
                     GraspControl& control,
                     const Clock& clock = systemClock());

  // Start a mode and replace the running one. Throw std::invalid_argument (options; noise lines of
  // a hand with more matrices).
  void beginHighSensitivity(const NoiseFloor& floor, const NoiseThresholdOptions& options = {});
  void beginAdaptiveSensitivity(const SensitivitySearchOptions& options = {});
  // Ends the mode; the settings stay.
  void endMode();
  // Ends the mode and restores the settings at power-up (0.5; SDH-2: 150 proximal, 300 distal).
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
  std::shared_ptr<CaptureQueue> queue_;  // null without a mode
  std::vector<CaptureItem> items_;
  std::optional<NoiseFloor> floor_;
  NoiseThresholdOptions highOptions_;
  std::optional<NoiseThresholds> high_;  // created once the usual frame rate is known
  std::optional<SensitivitySearch> search_;
  SensitivitySearchOptions searchOptions_;
  std::optional<TactileSettings> wanted_;  // settings to be applied
  std::vector<std::shared_future<CommandAnswer>> pending_;
  // Stamps of the newest frames since the last setting [us since 1970].
  std::deque<std::int64_t> stampsUs_;
  // Frames before this time were scanned with other settings.
  std::int64_t settledFromUs_ = 0;
  std::vector<double> degC_;  // empty before the first temperatures
  double begunS_ = 0.0;
};

}  // namespace palpate
