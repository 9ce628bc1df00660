// What some parts of the window work out and others show with the frame: pressures, how contacts
// slip, matrices that can't feel the limit of a grasp.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include <palpate/calibration/pressure_reader.h>

#include "gui/window_state/hand_slip.h"

namespace palpate::gui {

class DerivedResults : public QObject {
  Q_OBJECT
 public:
  explicit DerivedResults(QObject* parent = nullptr) : QObject(parent) {}

  // Null: no calibration is applied, or it says nothing of this frame.
  const std::shared_ptr<const PressureFrame>& pressure() const noexcept { return pressure_; }
  void setPressure(std::shared_ptr<const PressureFrame> pressure) {
    pressure_ = std::move(pressure);
    emit pressureChanged();
  }
  // What values are told in beside counts: "none: values are counts", or the calibration's name.
  const QString& calibration() const noexcept { return calibration_; }
  void setCalibration(const QString& text) {
    if (text == calibration_) return;
    calibration_ = text;
    emit calibrationChanged();
  }
  const std::vector<HandSlip>& slips() const noexcept { return slips_; }
  void setSlips(std::vector<HandSlip> slips) {
    slips_ = std::move(slips);
    emit slipsChanged();
  }
  // Why matrices of the connected hand can't tell the limit that is chosen: one text per matrix,
  // empty: it can; none: all.
  const std::vector<QString>& unmeasurable() const noexcept { return unmeasurable_; }
  void setUnmeasurable(const std::vector<QString>& why) {
    unmeasurable_ = why;
    emit unmeasurableChanged();
  }

 signals:
  void pressureChanged();
  void calibrationChanged();
  void slipsChanged();
  void unmeasurableChanged();

 private:
  std::shared_ptr<const PressureFrame> pressure_;
  QString calibration_ = "none: values are counts";
  std::vector<HandSlip> slips_;
  std::vector<QString> unmeasurable_;
};

}  // namespace palpate::gui
