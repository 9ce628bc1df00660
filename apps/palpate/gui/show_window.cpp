#include "gui/show_window.h"

#include <QCloseEvent>
#include <QKeyEvent>
#include <QVBoxLayout>

#include "gui/answer_view.h"

namespace palpate::gui {

ShowWindow::ShowWindow(RecogniseDesk& desk, Theme theme, QWidget* parent)
    : QWidget(parent, Qt::Window) {
  setObjectName("showWindow");
  setWindowTitle("What is it? – Palpate");
  setAttribute(Qt::WA_DeleteOnClose);
  QPalette plain = palette();
  plain.setColor(QPalette::Window, colorsOf(theme).window);
  setPalette(plain);
  setAutoFillBackground(true);
  view_ = new AnswerView(desk.photos(), 0.0, this);
  view_->setObjectName("showAnswer");
  view_->setTheme(theme);
  const auto show = [this](RecognitionAnswer answer) {
    answer.of.clear();
    // An audience is asked for nothing.
    if (answer.kind == RecognitionAnswer::Kind::kNothing) answer.text = "Hold something.";
    view_->setAnswer(answer);
  };
  show(desk.answer());
  connect(&desk, &RecogniseDesk::answered, this, show);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(view_);
}

void ShowWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Q && event->modifiers() == Qt::NoModifier) return emit asked();
  if (event->key() == Qt::Key_Escape || event->key() == Qt::Key_Q) {
    close();
    return;
  }
  QWidget::keyPressEvent(event);
}

void ShowWindow::closeEvent(QCloseEvent* event) {
  emit closed();
  event->accept();
}

}  // namespace palpate::gui
