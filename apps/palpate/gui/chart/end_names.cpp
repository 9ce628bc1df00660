#include "gui/chart/end_names.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/chart/plot.h"

namespace palpate::gui {
namespace {

constexpr int kBeforeName = 5;        // [px]
constexpr int kChartPerName = 6;      // width of a chart that has room for names [of a name]
constexpr double kLineHeight = 0.95;  // of names below one another [of the line spacing]

struct EndName {
  QPointF at;  // left end of the middle of the name
  const PlottedCurve* curve = nullptr;
};

int widestName(const QWidget& plot, const std::vector<PlottedCurve>& curves) {
  int widest = 0;
  for (const PlottedCurve& curve : curves)
    widest = std::max(widest, plot.fontMetrics().horizontalAdvance(curve.name));
  return widest;
}

double lineHeight(const QWidget& plot) { return kLineHeight * plot.fontMetrics().lineSpacing(); }

}  // namespace

int roomForEndNames(const QCustomPlot& plot, const std::vector<PlottedCurve>& curves) {
  const bool oneUnit =
      !curves.empty() && std::all_of(curves.begin(), curves.end(), [&](const PlottedCurve& curve) {
        return curve.unit == curves.front().unit;
      });
  const int widest = widestName(plot, curves);
  // Half of the height is the axis of time, in the lowest charts.
  const bool fits = plot.width() >= kChartPerName * widest &&
                    plot.height() / 2.0 >= lineHeight(plot) * static_cast<double>(curves.size());
  return oneUnit && fits ? widest + 2 * kBeforeName : 0;
}

void paintEndNames(QPainter& painter, QCustomPlot& plot, const std::vector<PlottedCurve>& curves) {
  if (roomForEndNames(plot, curves) == 0) return;
  const QRect room = plot.axisRect()->rect();
  std::vector<EndName> names;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const QCPGraph* graph = plot.graph(static_cast<int>(i));
    if (!graph || graph->data()->isEmpty()) continue;
    const QCPGraphData last = *(graph->data()->constEnd() - 1);
    if (!std::isfinite(last.value)) continue;
    const double x = graph->keyAxis()->coordToPixel(last.key);
    const double y = graph->valueAxis()->coordToPixel(last.value);
    names.push_back({{std::min(x, room.right() + 1.0) + kBeforeName,
                      std::clamp(y, room.top() + 0.0, room.bottom() + 0.0)},
                     &curves[i]});
  }
  std::stable_sort(names.begin(), names.end(), [](const EndName& a, const EndName& b) {
    return a.at.y() < b.at.y();
  });
  // Each at its end or below the one before; then from below, so that the lowest ones stay inside.
  const double apart = lineHeight(plot);
  for (std::size_t i = 1; i < names.size(); ++i)
    names[i].at.setY(std::max(names[i].at.y(), names[i - 1].at.y() + apart));
  double lowest = room.bottom();
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    name->at.setY(std::min(name->at.y(), lowest));
    lowest = name->at.y() - apart;
  }
  painter.setFont(plot.font());
  for (const EndName& name : names) {
    painter.setPen(name.curve->pen.color());
    painter.drawText(QRectF(name.at.x(), name.at.y() - apart, plot.width(), 2.0 * apart),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     name.curve->name);
  }
}

}  // namespace palpate::gui
