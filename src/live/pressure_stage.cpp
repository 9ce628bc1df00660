#include "palpate/live/pressure_stage.h"

#include <stdexcept>
#include <utility>

#include "palpate/calibration/force_series.h"
#include "palpate/core/error.h"

namespace palpate {

PressureStage::PressureStage(HandDescription hand, AskSettings askSettings)
    : hand_(std::move(hand)), askSettings_(std::move(askSettings)) {}

void PressureStage::setCalibration(const std::optional<Calibration>& calibration) {
  auto map = calibration ? std::make_unique<PressureMap>(*calibration, hand_) : nullptr;
  const std::lock_guard lock(mutex_);
  map_ = std::move(map);
  settingsChanged_ = true;
  trouble_.clear();
}

std::vector<std::string> PressureStage::assumptions() const {
  const std::lock_guard lock(mutex_);
  return map_ ? map_->assumptions() : std::vector<std::string>{};
}

std::string PressureStage::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void PressureStage::reset() {
  const std::lock_guard lock(mutex_);
  if (map_) map_->reset();
  settingsChanged_ = true;
  told_.clear();
}

void PressureStage::onEvent(const RecordingEvent& event) {
  if (event.kind != "settings") return;
  const std::lock_guard lock(mutex_);
  settingsChanged_ = true;
  told_ = event.json;
}

std::vector<SensorSettings> PressureStage::settingsNow() const {
  if (!told_.empty()) return reportedSettingsFrom(Json::parse(told_));
  return askSettings_ ? askSettings_() : std::vector<SensorSettings>{};
}

void PressureStage::useSettings() {
  settingsChanged_ = false;
  trouble_.clear();
  try {
    map_->setSettings(settingsNow());
  } catch (const Error& error) {
    trouble_ = error.what();
  } catch (const std::invalid_argument& error) {
    trouble_ = error.what();
  }
}

void PressureStage::onFrame(LiveResults& results, std::vector<RecordingEvent>&) {
  const std::lock_guard lock(mutex_);
  if (!map_) return;
  if (settingsChanged_) useSettings();
  const TactileFrame& frame = results.unfiltered ? *results.unfiltered : *results.frame;
  if (trouble_.empty() && frame.values.size() != hand_.layout->numPlaces())
    trouble_ = "the sensor isn't the one that was connected: connect anew";
  if (!trouble_.empty()) return;
  static const std::vector<double> kUnknown;
  auto pressure = std::make_shared<PressureFrame>();
  map_->apply(frame, results.temperatures ? results.temperatures->degC : kUnknown, *pressure);
  results.pressure = std::move(pressure);
}

}  // namespace palpate
