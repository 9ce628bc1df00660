// Return and Enter press the button that has the focus, as in a dialogue, everywhere else in the
// window, too. Space marks the moment or plays: it never presses a button that moves the hand.
#pragma once

#include <QObject>

namespace palpate::gui {

// The property of buttons that move the hand.
inline constexpr const char* kMovesHand = "movesHand";

class ButtonKeys : public QObject {
 public:
  explicit ButtonKeys(QObject* parent);

 protected:
  // Of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpate::gui
