#include "gui/timeline/timeline_panel.h"

#include <algorithm>

#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {

TimelinePanel::TimelinePanel(QWidget* parent) : QWidget(parent) {
  chart_ = new TimelineChart(this);
  rowsScroll_ = named(new QScrollArea(this), "eventRowsScroll");
  rowsScroll_->setFrameShape(QFrame::NoFrame);
  rowsScroll_->setFocusPolicy(Qt::NoFocus);
  rowsScroll_->setWidgetResizable(true);
  rowsScroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  rows_ = new EventRows;
  rowsScroll_->setWidget(rows_);
  rowsScroll_->hide();
  setLayout(inColumn({{chart_, 1}, rowsScroll_}, Space::kNone));
  fitToText(*rows_, [this] { fitRows(); });
  connect(rows_, &EventRows::marksChanged, this, &TimelinePanel::fitRows);
  connect(rows_, &EventRows::chosenChanged, this, [this] {
    if (!rows_->chosen()) return;
    const QRectF bar = rows_->barOf(*rows_->chosen());
    if (!bar.isEmpty())
      rowsScroll_->ensureVisible(0, qRound(bar.center().y()), 0, qRound(bar.height()));
  });
  connect(chart_, &TimelineChart::seenChanged, this, [this] {
    const QRect plot = chart_->axisRect()->rect();
    rows_->setScale(chart_->seen().lower, chart_->seen().upper, plot.left(), plot.right() + 1);
  });
}

void TimelinePanel::fitRows() {
  const int whole = rows_->sizeHint().height();
  rowsScroll_->setVisible(whole > 0);
  rowsScroll_->setMinimumHeight(std::min(whole, rows_->heightOfOne()));
  rowsScroll_->setMaximumHeight(whole);
}

}  // namespace palpate::gui
