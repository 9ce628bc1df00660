// Computes pressures and forces of the shown frames, recorded or live, with the applied
// calibration, and puts them into DerivedResults for the other views.
#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include <palpate/calibration/pressure_reader.h>

#include "gui/calibrate/applied_calibration.h"
#include "gui/calibrate/calibration_cache.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class ForcePage;

class Pressures : public QObject {
  Q_OBJECT
 public:
  // The arguments must outlive this object.
  Pressures(WindowState& windowState, CalibrationCache& calibrations, ForcePage& page);

  // Sets what the shown recording contains about its sensor.
  void setKept(const KeptWithRecording& kept);
  // Call this when the recording, the source or the calibration may have changed; it does nothing
  // when none of them did.
  void renew();
  // Reads the calibration again, although its path is the same, because its content may have
  // changed.
  void reload();

 private:
  // What is known of the calibration of this file has changed.
  void take(const QString& path);
  // `text`: what is said of the calibration, unless it can't be used.
  void show(const std::optional<Calibration>& calibration, QString text);
  void renewRecording(const Calibration& calibration);
  void showFrame();
  void showLive(const LiveResults& results);

  WindowState& windowState_;
  CalibrationCache& calibrations_;
  ForcePage& page_;
  KeptWithRecording kept_;
  // Pressures of the shown recording; null when there are none.
  std::unique_ptr<PressureReader> reader_;
  // What other views compute forces of the recording with; null as reader_.
  std::shared_ptr<const ComputedOptions> forces_;
  // Identifies what the shown pressures were computed from.
  struct Of {
    // The recording or the history of the live source.
    const void* source = nullptr;
    // Path of the calibration.
    QString path;
    KeptWithRecording kept;
    bool operator==(const Of&) const = default;
  };
  std::optional<Of> of_;
};

}  // namespace palpate::gui
