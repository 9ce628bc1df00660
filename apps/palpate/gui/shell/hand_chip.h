// The chip in the tool bar that tells the condition of the connected hand by a word and a colour;
// while a task moves the hand, the word is that of the task, also when the hand rests. Its sentence
// is the tool tip; a click shows it, too, and acknowledges that a protection ended.
#pragma once

#include <QPushButton>

#include "gui/appearance/theme.h"
#include "gui/window_state/hand_commands.h"

class QAction;

namespace palpate::gui {

class HandChip : public QPushButton {
  Q_OBJECT
 public:
  // `acknowledge`: enabled while there is something to acknowledge; must outlive this.
  HandChip(QAction& acknowledge, QWidget* parent);
  // The width stays the same: no button beside it moves.
  void setCondition(const ExplainedCondition& condition, const HandTask& task);
  // Where there is no room for the word: its colour alone.
  void setNarrow(bool on);

 private:
  void fit();
  void style();
  void explain();

  QAction& acknowledge_;
  // Where a hand that rests during a task counts as moving.
  HandCondition condition_ = HandCondition::kReady;
  QString word_;
  QString sentence_;
  bool narrow_ = false;
};

}  // namespace palpate::gui
