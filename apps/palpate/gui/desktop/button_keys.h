// Makes Return and Enter press the button that has the focus, everywhere in the window and in
// dialogues. Space marks a moment or plays; it never presses a button that moves the hand.
#pragma once

#include <QObject>

namespace palpate::gui {

// Name of the property that marks buttons that move the hand.
inline constexpr const char* kMovesHand = "movesHand";

class ButtonKeys : public QObject {
 public:
  explicit ButtonKeys(QObject* parent);

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpate::gui
