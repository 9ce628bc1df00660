// A slider and a number field that show the same value. chosen() comes when the slider is released
// or the field is left; values in between aren't sent to a hand.
#pragma once

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

namespace palpate::gui {

class SecondsField;

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
  // The unit in texts, as written after a number ("°"); empty: `unit`.
  QString saidUnit = {};
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
  // Shows that what it stands for has different values. A value is chosen as otherwise; the least
  // one only in the field.
  void showDiffering();
  QDoubleSpinBox* field() const noexcept;
  QSlider* slider() const noexcept { return slider_; }

 signals:
  void chosen(double value);

 private:
  void choose();
  int ticksOf(double value) const;

  const SliderRange range_;
  QSlider* slider_;
  SecondsField* field_;
  // The value that was shown or chosen last.
  double shown_ = 0.0;
  bool differing_ = false;
  // Whether a number was typed, and not yet accepted, in place of differing values.
  bool edited_ = false;
};

}  // namespace palpate::gui
