// A slider and a number field that show the same value. chosen() comes when the slider is released
// or the field is left; values in between aren't sent to a hand.
#pragma once

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

namespace palpate::gui {

struct SliderRange {
  double least = 0.0;
  // Largest value of the field.
  double most = 1.0;
  // Largest value of the slider: the useful part of the range.
  double sliderMost = 1.0;
  double step = 0.05;
  int decimals = 2;
  // "deg/s"; may be a blank.
  QString unit = {};
};

class ValueSlider : public QWidget {
  Q_OBJECT
 public:
  ValueSlider(const QString& name, const SliderRange& range, QWidget* parent);
  double value() const;
  // Shows a value without emitting chosen(). While the user is editing, nothing changes.
  void showValue(double value);
  // Shows a dash.
  void showUnknown();
  QDoubleSpinBox* field() const noexcept { return field_; }
  QSlider* slider() const noexcept { return slider_; }

 signals:
  void chosen(double value);

 private:
  void choose();
  int ticksOf(double value) const;

  const SliderRange range_;
  QSlider* slider_;
  QDoubleSpinBox* field_;
  // The value that was shown or chosen last.
  double shown_ = 0.0;
};

}  // namespace palpate::gui
