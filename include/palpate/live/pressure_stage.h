// The stage that tells pressures and forces where a calibration is chosen: none is default, and
// without one the results have none.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/live/stage.h>
#include <palpate/model/hand_description.h>

namespace palpate {

// Fills LiveResults::pressure, of the frame as it came and never of a filtered one: that is what
// was calibrated. setCalibration(), assumptions() and trouble() may be called from any thread.
class PressureStage final : public Stage {
 public:
  // What the matrices are set to now, one each; empty: not known, so that the settings of the
  // calibration are assumed. Asked on the processing thread, at the beginning and after an event
  // "settings" that doesn't say it. May throw Error.
  using AskSettings = std::function<std::vector<SensorSettings>()>;

  PressureStage(HandDescription hand, AskSettings askSettings);

  // From the next frame on; nothing: no pressures. Throws std::invalid_argument: no P(K, T) in it.
  void setCalibration(const std::optional<Calibration>& calibration);
  // What a reader must know of, a sentence each; empty without a calibration.
  std::vector<std::string> assumptions() const;
  // Why there are no pressures though a calibration is chosen; empty: nothing is wrong.
  std::string problem() const;

  void reset() override;
  void onFrame(LiveResults& results, std::vector<RecordingEvent>& out) override;
  void onEvent(const RecordingEvent& event) override;

 private:
  void useSettings();  // under mutex_
  std::vector<SensorSettings> settingsNow() const;

  const HandDescription hand_;
  const AskSettings askSettings_;
  mutable std::mutex mutex_;
  std::unique_ptr<PressureMap> map_;  // null: no calibration
  bool settingsChanged_ = true;
  // JSON of the event that told the settings; empty: to be asked for
  std::string lastSettingsJson_;
  std::string problem_;
};

}  // namespace palpate
