// The wheel scrolls; it changes a number, a slider or a choice only where the keyboard already is.
// Of the whole application: whoever scrolls over the settings of a hand sets nothing.
#pragma once

#include <QObject>

namespace palpate::gui {

// A slider with this property takes the wheel as its own: the bar that scrubs through a recording.
inline constexpr const char* kTakesWheel = "takesWheel";

class WheelGuard : public QObject {
 public:
  explicit WheelGuard(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpate::gui
