// A selected span of a chart over time, or one end of it: a shade with a handle at each end, made
// of widgets over the curves, so that moving it redraws no curve.
#pragma once

#include <QRect>
#include <array>
#include <optional>

class QWidget;

namespace palpate::gui {

// Distance from a handle at which the mouse still takes it [px].
inline constexpr double kHandleReach = 6.0;

// Makes a hidden widget over a chart that lets all mouse events pass.
QWidget* overlayOn(QWidget* chart, const char* name);

class SpanOverlay {
 public:
  // The widgets belong to the chart.
  explicit SpanOverlay(QWidget* chart);
  // Takes the colours of the theme that is shown.
  void restyle();
  // Shows both ends, at these positions [px of the chart], in any order; nothing: no such end.
  // Parts outside of `plot` are hidden; the shade needs both ends.
  void place(const QRect& plot, std::optional<double> first, std::optional<double> second);

 private:
  QWidget* shade_;
  std::array<QWidget*, 2> handles_;
};

}  // namespace palpate::gui
