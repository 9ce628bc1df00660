// Buttons that move the hand.
#pragma once

class QWidget;

namespace palpate::gui {

// Enables or disables a button that moves the hand. One that has the focus of its window gives it
// to the part of the window around it that takes the focus by a click (the dock Hand), where Return
// does nothing: Qt would give it to the next button, and Return, pressed once more, would release
// what is held. Where there is no such part nobody has the focus. It gets the focus back when it is
// enabled again, unless another widget has it.
void enableMotionButton(QWidget& button, bool on);

}  // namespace palpate::gui
