// Event filter of the whole application: the mouse wheel changes a number, a slider or a choice
// only if that control has the keyboard focus; otherwise it scrolls. So scrolling over the settings
// of a hand doesn't change them.
#pragma once

#include <QObject>

namespace palpate::gui {

// Name of the property of sliders that always take the wheel: the position slider of the playback.
inline constexpr const char* kTakesWheel = "takesWheel";

class WheelGuard : public QObject {
 public:
  explicit WheelGuard(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpate::gui
