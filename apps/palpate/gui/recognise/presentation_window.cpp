#include "gui/recognise/presentation_window.h"

#include <QCloseEvent>
#include <QKeyEvent>
#include <QVBoxLayout>

#include "gui/recognise/answer_view.h"

namespace palpate::gui {

PresentationWindow::PresentationWindow(RecognitionController& controller,
                                       bool live,
                                       Theme theme,
                                       QWidget* parent)
    : QWidget(parent, Qt::Window), controller_(controller), live_(live) {
  setObjectName("showWindow");
  setWindowTitle("What is it? – Palpate");
  setAttribute(Qt::WA_DeleteOnClose);
  QPalette plain = palette();
  plain.setColor(QPalette::Window, colorsOf(theme).window);
  setPalette(plain);
  setAutoFillBackground(true);
  view_ = new AnswerView(controller.photos(), 0.0, this);
  view_->setObjectName("showAnswer");
  view_->setTheme(theme);
  showAnswer();
  connect(&controller, &RecognitionController::answered, this, &PresentationWindow::showAnswer);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(view_);
}

void PresentationWindow::setLive(bool live) {
  if (live == live_) return;
  live_ = live;
  showAnswer();
}

void PresentationWindow::showAnswer() {
  RecognitionAnswer answer = controller_.answer();
  const bool ofNow = answer.of.isEmpty() || answer.of == kHeldNow;
  if (answer.of == kLastGrasp || (live_ && !ofNow)) answer = {};
  answer.of.clear();
  // The audience needs no hint about buttons.
  if (answer.kind == RecognitionAnswer::Kind::kNothing)
    answer.text = "Put an object into the hand.";
  view_->setAnswer(answer);
}

void PresentationWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Q && event->modifiers() == Qt::NoModifier) return emit asked();
  if (event->key() == Qt::Key_Escape || event->key() == Qt::Key_Q) {
    close();
    return;
  }
  QWidget::keyPressEvent(event);
}

void PresentationWindow::closeEvent(QCloseEvent* event) {
  emit closed();
  event->accept();
}

}  // namespace palpate::gui
