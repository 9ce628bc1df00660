#include "gui/chart/reading_chart.h"

#include <QHelpEvent>
#include <QToolTip>

namespace palpate::gui {

bool ReadingChart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), readingAt(help->pos()), this);
    return true;
  }
  if (event->type() == QEvent::FontChange) restyle();
  return QCustomPlot::event(event);
}

}  // namespace palpate::gui
