// The show mode: the answer alone, as large as the screen, for an audience. Of a connected hand it
// names what is held now, and nothing else. Any of Esc and its own key close it.
#pragma once

#include <QWidget>

#include "gui/recognise/recognition_controller.h"

namespace palpate::gui {

class AnswerView;

class PresentationWindow : public QWidget {
  Q_OBJECT
 public:
  PresentationWindow(RecognitionController& controller,
                     bool live,
                     Theme theme,
                     QWidget* parent = nullptr);
  AnswerView& view() noexcept { return *view_; }
  // A connected hand is shown: answers about recordings aren't for now.
  void setLive(bool live);

 signals:
  void asked();
  void closed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void showAnswer();

  RecognitionController& controller_;
  bool live_;
  AnswerView* view_;
};

}  // namespace palpate::gui
