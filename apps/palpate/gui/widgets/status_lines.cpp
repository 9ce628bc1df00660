#include "gui/widgets/status_lines.h"

#include <QFontMetrics>
#include <QScrollBar>

#include "gui/widgets/text_fit.h"

namespace palpate::gui {

StatusLines::StatusLines(int lines, const QString& name, QWidget* parent)
    : QScrollArea(parent), label_(new QLabel(this)) {
  label_->setObjectName(name);
  label_->setWordWrap(true);
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFocusPolicy(Qt::NoFocus);
  setWidget(label_);
  fitToText(*this, [this, lines] { setFixedHeight(lines * fontMetrics().lineSpacing() + 2); });
}

void StatusLines::setText(const QString& text, const QString& tip) {
  if (label_->text() != text) {
    label_->setText(text);
    verticalScrollBar()->setValue(0);
  }
  const QString wanted = tip.isEmpty() ? text : tip;
  if (label_->toolTip() != wanted) label_->setToolTip(wanted);
}

}  // namespace palpate::gui
