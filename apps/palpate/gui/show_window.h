// The show mode: the answer alone, as large as the screen, for an audience. Any of Esc and its own key close it.
#pragma once

#include <QWidget>

#include "gui/recognise_desk.h"

namespace palpate::gui {

class AnswerView;

class ShowWindow : public QWidget {
  Q_OBJECT
 public:
  ShowWindow(RecogniseDesk& desk, Theme theme, QWidget* parent = nullptr);
  AnswerView& view() noexcept { return *view_; }

 signals:
  void asked();
  void closed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  AnswerView* view_;
};

}  // namespace palpate::gui
