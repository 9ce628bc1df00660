// The full-screen window for an audience: the hand with its heat maps at the left, the answer at
// the right. With a connected hand it names only what is held now. While a hand is connected that
// can be moved, a row below the answer has a large button Stop and what the hand does; the keys of
// its motions work here, too. Esc or the key that opened it closes it.
#pragma once

#include <QStringList>
#include <QTimer>
#include <QWidget>

#include "gui/recognise/recognition_controller.h"
#include "gui/window_state/hand_commands.h"

class QBoxLayout;
class QLabel;
class QPushButton;

namespace palpate::gui {

class AnswerView;
class GuessingGame;

class PresentationWindow : public QWidget {
  Q_OBJECT
 public:
  // `hand` must outlive this.
  PresentationWindow(RecognitionController& controller,
                     HandCommands& hand,
                     bool live,
                     QWidget* parent = nullptr);
  AnswerView& view() noexcept { return *view_; }
  // Shows this at the left of the answer.
  void setScene(QWidget* scene);
  // `live`: a connected hand is shown, so that answers about recordings are left out.
  void setLive(bool live);
  // Why nothing arrives from the hand; the answer is greyed and stays so long. Empty: frames
  // arrive.
  void setSilence(const QString& why);

 signals:
  void asked();
  void closed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  QWidget* makeHandRow();
  void showAnswer();
  // Begins the guessing game, or ends it.
  void play();
  // Shows why a key was refused, for some seconds; otherwise what the hand does.
  void showHand();

  RecognitionController& controller_;
  HandCommands& hand_;
  bool live_;
  QBoxLayout* row_;
  AnswerView* view_;
  GuessingGame* game_;
  QLabel* before_;
  QStringList sure_;  // the last sure answers, the newest first
  QWidget* handRow_;
  QLabel* handState_;
  QString refused_;
  QTimer refusedTimer_;
};

}  // namespace palpate::gui
