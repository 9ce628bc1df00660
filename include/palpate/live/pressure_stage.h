// Live stage that computes pressures and forces if a calibration is chosen. By default none is
// chosen, and the results contain no pressures.
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

// Fills LiveResults::pressure from the unfiltered frame, because the calibration was made with
// unfiltered frames. setCalibration(), assumptions() and problem() may be called from any thread.
class PressureStage final : public Stage {
 public:
  // Returns the present settings of the matrices, one each; empty when unknown, and the settings of
  // the calibration are assumed then. Called on the processing thread at the begin and after an
  // event "settings" without JSON. May throw Error.
  using AskSettings = std::function<std::vector<SensorSettings>()>;

  PressureStage(HandDescription hand, AskSettings askSettings);

  // Takes effect with the next frame; empty switches pressures off. Throws std::invalid_argument
  // when the calibration contains no P(K, T).
  void setCalibration(const std::optional<Calibration>& calibration);
  // The assumptions behind the pressures, one sentence each, to be shown to the user; empty without
  // a calibration.
  std::vector<std::string> assumptions() const;
  // Reason why there are no pressures although a calibration is chosen; empty when there are.
  std::string problem() const;

  void reset() override;
  void onFrame(LiveResults& results, std::vector<Event>& out) override;
  void onEvent(const Event& event) override;

 private:
  void useSettings();  // requires mutex_
  std::vector<SensorSettings> settingsNow() const;

  const HandDescription hand_;
  const AskSettings askSettings_;
  mutable std::mutex mutex_;
  std::unique_ptr<PressureMap> map_;  // null: no calibration
  bool settingsChanged_ = true;
  // JSON of the event that reported the settings; empty when they must be requested.
  std::string lastSettingsJson_;
  std::string problem_;
};

}  // namespace palpate
