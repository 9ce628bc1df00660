// A slider and a field that show the same number. It is chosen when the slider is let go or the
// field is left: what is on the way isn't sent to a hand.
#pragma once

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

namespace palpate::gui {

struct SliderRange {
  double least = 0.0;
  double most = 1.0;        // of the field
  double sliderMost = 1.0;  // of the slider: the part that is of use
  double step = 0.05;
  int decimals = 2;
  QString unit = {};  // "deg/s"; may be a blank
};

class ValueSlider : public QWidget {
  Q_OBJECT
 public:
  ValueSlider(const QString& name, const SliderRange& range, QWidget* parent);
  double value() const;
  // Shows a value; nothing is chosen by that. While the user is at it, nothing is changed.
  void showValue(double value);
  void showUnknown();  // a dash
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
  double shown_ = 0.0;  // what was shown or chosen last
};

}  // namespace palpate::gui
