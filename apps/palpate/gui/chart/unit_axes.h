// The vertical axes of a chart over time: one per unit of its curves, the first on the left, all
// others on the right. Each range is automatic, or set by hand: the wheel over an axis zooms it, a
// drag moves it, a double click makes it automatic again. Each axis is linear or logarithmic.
#pragma once

#include <QObject>
#include <QPointer>
#include <QString>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <palpate/signals/axis_range.h>

#include "gui/appearance/theme.h"
#include "gui/chart/plotted_curve.h"

class QCPAxis;
class QCPItemText;
class QCustomPlot;
class QMouseEvent;
class QWheelEvent;

namespace palpate::gui {

// Ranges that were set by hand, by unit.
using RangesByHand = std::map<QString, AxisRange>;

class UnitAxes : public QObject {
  Q_OBJECT
 public:
  // `plot` must outlive this object.
  explicit UnitAxes(QCustomPlot& plot);

  // Makes the axes of these curves; the chart must have no graph. Ranges by hand stay.
  void rebuild(const std::vector<PlottedCurve>& curves);
  // Names the axes, as the height of the chart permits: in a low one the units stand in the corners
  // of the plot. An axis that was set by hand says so.
  void nameAxes();
  // The axis of a unit of the curves.
  QCPAxis* of(const QString& unit) const;
  // In the order of the curves.
  std::vector<QString> units() const;
  // "mean in counts"; the unit where several quantities share it.
  QString nameOf(const QString& unit) const;
  // From the base unit to that of the axis.
  UnitConversion conversionOf(const QString& unit) const;
  // Whether all curves of the unit count from 0: signals, taxels and forces do, angles and
  // temperatures don't.
  bool fromZero(const QString& unit) const;
  // AxisRangeOptions::minExtent in the base unit: that of angles and temperatures, whose sensors
  // are noisy; other series may have values of any size.
  double minExtent(const QString& unit) const;

  // The curves of this unit are in lanes: its axis is left to chart/lanes.h, and the mouse doesn't
  // change it. Nothing: none are.
  void leaveToLanes(const std::optional<QString>& unit) { laneUnit_ = unit; }
  // Sets the range of an axis unless it is set by hand.
  void setAutomatic(const QString& unit, const AxisRange& range);
  const RangesByHand& byHand() const noexcept { return byHand_; }
  void setByHand(const RangesByHand& ranges);
  // Nothing: automatic. A range that isn't ascending and finite is ignored.
  void setByHand(const QString& unit, const std::optional<AxisRange>& range);

  // A logarithmic axis shows values above 0: it begins three decades below its end where its range
  // reaches 0 or below.
  const std::set<QString>& logarithmic() const noexcept { return logarithmic_; }
  void setLogarithmic(const std::set<QString>& units);
  void setLogarithmic(const QString& unit, bool on);

  // The unit of the axis at a place of the chart.
  std::optional<QString> unitAt(const QPointF& at) const;
  // Mouse events of the chart; true: it was for an axis.
  bool wheel(const QWheelEvent& event);
  bool press(const QMouseEvent& event);
  bool move(const QMouseEvent& event);
  bool release();
  bool doubleClick(const QMouseEvent& event);

 signals:
  // A range was set by hand, or made automatic again.
  void byHandChanged();
  void logarithmicChanged();

 private:
  struct Axis {
    QString unit;
    QString name;
    bool fromZero = true;
    QCPAxis* axis = nullptr;
    UnitConversion conversion = {};
    double minExtent = 0.0;
  };
  const Axis* find(const QString& unit) const;
  // Sets the kind of scale and the range.
  void scale(const Axis& axis, const AxisRange& range);

  // Shows a text in a corner of the plot; an empty one removes it.
  void showInCorner(QPointer<QCPItemText>& word, const QString& text, Qt::Alignment corner);

  QCustomPlot& plot_;
  QPointer<QCPItemText> atLeft_, atRight_;
  std::vector<Axis> axes_;
  RangesByHand byHand_;
  std::set<QString> logarithmic_;
  std::optional<QString> laneUnit_;
  // The axis that the mouse drags, and its range and the place when that began.
  QString dragged_;
  AxisRange draggedFrom_;
  double pressedY_ = 0.0;
};

}  // namespace palpate::gui
