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
  problem_.clear();
}

std::vector<std::string> PressureStage::assumptions() const {
  const std::lock_guard lock(mutex_);
  return map_ ? map_->assumptions() : std::vector<std::string>{};
}

std::string PressureStage::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void PressureStage::reset() {
  const std::lock_guard lock(mutex_);
  if (map_) map_->reset();
  settingsChanged_ = true;
  lastSettingsJson_.clear();
}

void PressureStage::onEvent(const Event& event) {
  if (event.kind != "settings") return;
  const std::lock_guard lock(mutex_);
  settingsChanged_ = true;
  lastSettingsJson_ = event.json;
}

std::vector<SensorSettings> PressureStage::settingsNow() const {
  if (!lastSettingsJson_.empty()) return reportedSettingsFrom(Json::parse(lastSettingsJson_));
  return askSettings_ ? askSettings_() : std::vector<SensorSettings>{};
}

void PressureStage::useSettings() {
  settingsChanged_ = false;
  problem_.clear();
  try {
    map_->setSettings(settingsNow());
  } catch (const Error& error) {
    problem_ = error.what();
  } catch (const std::invalid_argument& error) {
    problem_ = error.what();
  }
}

void PressureStage::onFrame(LiveResults& results, std::vector<Event>&) {
  const std::lock_guard lock(mutex_);
  if (!map_) return;
  if (settingsChanged_) useSettings();
  const TactileFrame& frame = results.unfiltered ? *results.unfiltered : *results.frame;
  if (problem_.empty() && frame.values.size() != hand_.layout->numCells())
    problem_ = "the sensor isn't the one that was connected: connect again";
  if (!problem_.empty()) return;
  static const std::vector<double> kUnknown;
  auto pressure = std::make_shared<PressureFrame>();
  map_->apply(frame, results.temperatures ? results.temperatures->values : kUnknown, *pressure);
  results.pressure = std::move(pressure);
}

}  // namespace palpate
