// Buttons that move the hand.
#pragma once

#include <QString>

#include <palpate/control/grasp_control.h>

class QPushButton;
class QWidget;

namespace palpate::gui {

// Takes neither Return in a dialog nor the focus by a click. `moves`: it moves the hand (see
// kMovesHand), else it stands among those that do.
QPushButton* motionButton(
    const QString& text, const QString& name, const QString& tip, bool moves, QWidget* parent);

// Enables or disables a button that moves the hand. One that has the focus of its window gives it
// to the part of the window around it that takes the focus by a click (the dock Hand), where Return
// does nothing: Qt would give it to the next button, and Return, pressed once more, would release
// what is held. Where there is no such part nobody has the focus. It gets the focus back when it is
// enabled again, unless another widget has it.
void enableMotionButton(QWidget& button, bool on);

// Why no motion can begin while another one runs, for the tool tips of the buttons: "A reactive
// grasp runs; Stop (Esc) ends it". Empty: the hand is free. A hand that holds without a request is
// one between the steps of a sequence.
QString busyText(const GraspStatus& status);

}  // namespace palpate::gui
