// The full-screen window that shows only the answer, for an audience. With a connected hand it
// names only what is held now. Esc or the key that opened it closes it.
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
  // `live`: a connected hand is shown, so that answers about recordings are left out.
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
