// The timeline of a recording: the chart and, below it, the rows of events on the same time scale.
// The rows are scrolled where the chart would become too low.
#pragma once

#include <QScrollArea>
#include <QWidget>

#include "gui/timeline/event_rows.h"
#include "gui/timeline/timeline_chart.h"

namespace palpate::gui {

class TimelinePanel : public QWidget {
  Q_OBJECT
 public:
  explicit TimelinePanel(QWidget* parent = nullptr);
  TimelineChart& chart() noexcept { return *chart_; }
  EventRows& rows() noexcept { return *rows_; }

 private:
  void fitRows();

  TimelineChart* chart_;
  EventRows* rows_;
  QScrollArea* rowsScroll_;
};

}  // namespace palpate::gui
