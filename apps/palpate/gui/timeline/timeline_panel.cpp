#include "gui/timeline/timeline_panel.h"

#include <QScrollArea>
#include <QVBoxLayout>

namespace palpate::gui {

TimelinePanel::TimelinePanel(QWidget* parent) : QWidget(parent) {
  chart_ = new TimelineChart(this);
  rows_ = new EventRows(this);
  rows_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(chart_, 1);
  column->addWidget(rows_);
  connect(chart_, &TimelineChart::seenChanged, this, [this] {
    const QRect plot = chart_->axisRect()->rect();
    rows_->setScale(chart_->seen().lower, chart_->seen().upper, plot.left(), plot.right() + 1);
  });
}

void TimelinePanel::setTheme(Theme theme) {
  chart_->setTheme(theme);
  rows_->setTheme(theme);
}

}  // namespace palpate::gui
