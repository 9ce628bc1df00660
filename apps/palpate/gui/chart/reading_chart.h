// A chart whose tool tip tells the values at the mouse, and that takes its style anew when the font
// changes.
#pragma once

#include <QPoint>
#include <QString>

#include "gui/chart/plot.h"

namespace palpate::gui {

class ReadingChart : public QCustomPlot {
  Q_OBJECT
 public:
  explicit ReadingChart(QWidget* parent = nullptr) : QCustomPlot(parent) {}

 protected:
  // The text of the tool tip at a place in the widget; empty: none.
  virtual QString readingAt(const QPoint& at) const = 0;
  // Applies theme and font.
  virtual void restyle() = 0;
  bool event(QEvent* event) override;
};

}  // namespace palpate::gui
