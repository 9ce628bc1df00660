// Holds what some features compute and others show with the frame: pressures, slip of the contacts,
// the baseline in force, matrices that can't measure the limit chosen for a grasp.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include <palpate/calibration/pressure_reader.h>
#include <palpate/computed/computed_series.h>

#include "gui/window_state/hand_slip.h"

namespace palpate::gui {

class DerivedResults : public QObject {
  Q_OBJECT
 public:
  explicit DerivedResults(QObject* parent = nullptr) : QObject(parent) {}

  // Null: no calibration is applied, or it doesn't cover this frame.
  const std::shared_ptr<const PressureFrame>& pressure() const noexcept { return pressure_; }
  void setPressure(std::shared_ptr<const PressureFrame> pressure) {
    pressure_ = std::move(pressure);
    emit pressureChanged();
  }
  // The calibration as text: "none: values are counts", or its name.
  const QString& calibration() const noexcept { return calibration_; }
  void setCalibration(const QString& text) {
    if (text == calibration_) return;
    calibration_ = text;
    emit calibrationChanged();
  }
  // Over which baseline readings are seen: "taken 14:03:12", "of the recording", "none"; empty: the
  // hand sends no readings.
  const QString& baseline() const noexcept { return baseline_; }
  void setBaseline(const QString& text) {
    if (text == baseline_) return;
    baseline_ = text;
    emit baselineChanged();
  }
  // What forces of a recording are computed with: calibration, settings and tare. Null: no
  // calibration is applied to it, or it is another recording.
  std::shared_ptr<const ComputedOptions> forcesOf(const void* recording) const {
    return recording == forcesOf_ ? forces_ : nullptr;
  }
  void setForces(std::shared_ptr<const ComputedOptions> forces, const void* recording) {
    const bool none = !forces_ && !forces;
    forces_ = std::move(forces);
    forcesOf_ = recording;
    if (!none) emit forcesChanged();
  }
  const std::vector<HandSlip>& slips() const noexcept { return slips_; }
  void setSlips(std::vector<HandSlip> slips) {
    slips_ = std::move(slips);
    emit slipsChanged();
  }
  // One text per matrix of the connected hand: why the matrix can't measure the limit chosen for a
  // grasp; an empty text: it can. An empty vector: all matrices can.
  const std::vector<QString>& unmeasurable() const noexcept { return unmeasurable_; }
  void setUnmeasurable(const std::vector<QString>& why) {
    unmeasurable_ = why;
    emit unmeasurableChanged();
  }

 signals:
  void pressureChanged();
  void calibrationChanged();
  void baselineChanged();
  void forcesChanged();
  void slipsChanged();
  void unmeasurableChanged();

 private:
  std::shared_ptr<const PressureFrame> pressure_;
  QString calibration_ = "none: values are counts";
  QString baseline_;
  std::shared_ptr<const ComputedOptions> forces_;
  const void* forcesOf_ = nullptr;  // never dereferenced
  std::vector<HandSlip> slips_;
  std::vector<QString> unmeasurable_;
};

}  // namespace palpate::gui
