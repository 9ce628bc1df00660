#include "gui/widgets/fitting_row.h"

#include <QEvent>
#include <QHBoxLayout>
#include <utility>

namespace palpate::gui {

FittingRow::FittingRow(QWidget* parent) : QWidget(parent), row_(new QHBoxLayout(this)) {
  // The layout must not ask for more than minimumSizeHint().
  row_->setSizeConstraint(QLayout::SetNoConstraint);
}

void FittingRow::setOptional(QList<QWidget*> controls) {
  optional_ = std::move(controls);
  fit();
}

int FittingRow::neededWidth(bool withOptional) const {
  const QMargins margins = row_->contentsMargins();
  int width = margins.left() + margins.right();
  bool first = true;
  for (int i = 0; i < row_->count(); ++i) {
    const QLayoutItem* item = row_->itemAt(i);
    if (const QWidget* control = item->widget()) {
      const bool optional = optional_.contains(const_cast<QWidget*>(control));
      if (optional ? !withOptional : control->isHidden()) continue;
      width += control->sizeHint()
                   .expandedTo(control->minimumSize())
                   .boundedTo(control->maximumSize())
                   .width();
    } else {
      width += item->minimumSize().width();
    }
    if (!first) width += row_->spacing();
    first = false;
  }
  return width;
}

void FittingRow::fit() {
  int needed = neededWidth(true);
  for (QWidget* control : std::as_const(optional_)) {
    const bool fits = needed <= width();
    if (!fits) needed -= control->sizeHint().width() + row_->spacing();
    if (control->isHidden() == fits) control->setVisible(fits);
  }
}

QSize FittingRow::minimumSizeHint() const {
  return {neededWidth(false), row_->minimumSize().height()};
}

void FittingRow::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fit();
}

bool FittingRow::event(QEvent* event) {
  const bool done = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest) {
    fit();
    updateGeometry();
  }
  return done;
}

}  // namespace palpate::gui
