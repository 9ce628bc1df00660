#include "gui/calibrate/calibration_cache.h"

#include "gui/calibrate/applied_calibration.h"

namespace palpate::gui {

void CalibrationCache::renew(const QString& path) {
  auto& reading = readings_[path];
  if (!reading) reading = std::make_unique<FileReading>(this);
  const auto know = [this, path](const Known& known) {
    known_[path] = known;
    emit changed(path);
  };
  if (known_.erase(path) > 0) emit changed(path);
  reading->start(
      [know, path]() -> FileReading::Take {
        return [know, calibration = usableCalibration(path)] { know({calibration, {}}); };
      },
      [know](const QString& problem) {
        know({std::nullopt, problem});
      });
}

const CalibrationCache::Known* CalibrationCache::find(const QString& path) {
  if (const auto found = known_.find(path); found != known_.end()) return &found->second;
  if (!readings_.contains(path)) renew(path);
  return nullptr;
}

}  // namespace palpate::gui
