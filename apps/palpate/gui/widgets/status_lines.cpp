#include "gui/widgets/status_lines.h"

#include <QFontMetrics>
#include <QScrollBar>

#include "gui/widgets/keep_keys.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

QString withoutDigits(QString text) {
  return text.removeIf([](QChar letter) { return letter.isDigit(); });
}

}  // namespace

StatusLines::StatusLines(int lines, const QString& name, QWidget* parent)
    : QScrollArea(parent), label_(new QLabel(this)), focusFrame_(new QFrame(this)) {
  label_->setObjectName(name);
  label_->setWordWrap(true);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFocusPolicy(Qt::NoFocus);
  setWidget(label_);
  focusFrame_->setObjectName("FocusFrame");
  focusFrame_->setAttribute(Qt::WA_TransparentForMouseEvents);
  focusFrame_->hide();
  connect(verticalScrollBar(), &QScrollBar::rangeChanged, this, [this](int, int last) {
    setFocusPolicy(last > 0 ? Qt::TabFocus : Qt::NoFocus);
    if (last <= 0) clearFocus();
  });
  // They scroll here, and have other meanings in the window.
  keepKeys(*this, {Qt::Key_Up, Qt::Key_Down, Qt::Key_PageUp, Qt::Key_PageDown});
  fitToText(*this, [this, lines] { setFixedHeight(lines * fontMetrics().lineSpacing() + 2); });
}

void StatusLines::setText(const QString& text, const QString& tip) {
  if (label_->text() != text) {
    const bool another = withoutDigits(label_->text()) != withoutDigits(text);
    label_->setText(text);
    if (another) verticalScrollBar()->setValue(0);
  }
  const QString wanted = tip.isEmpty() ? text : tip;
  if (label_->toolTip() != wanted) label_->setToolTip(wanted);
}

void StatusLines::focusInEvent(QFocusEvent* event) {
  QScrollArea::focusInEvent(event);
  focusFrame_->setGeometry(rect());
  focusFrame_->raise();
  focusFrame_->show();
}

void StatusLines::focusOutEvent(QFocusEvent* event) {
  QScrollArea::focusOutEvent(event);
  focusFrame_->hide();
}

void StatusLines::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  focusFrame_->setGeometry(rect());
}

}  // namespace palpate::gui
