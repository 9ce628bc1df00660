#include "gui/chart/unit_axes.h"

#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/chart/chart_style.h"
#include "gui/chart/plot.h"

namespace palpate::gui {

UnitAxes::UnitAxes(QCustomPlot& plot) : plot_(plot) {}

const UnitAxes::Axis* UnitAxes::find(const QString& unit) const {
  const auto found =
      std::find_if(axes_.begin(), axes_.end(), [&](const Axis& axis) { return axis.unit == unit; });
  return found == axes_.end() ? nullptr : &*found;
}

void UnitAxes::rebuild(const std::vector<PlottedCurve>& curves) {
  QCPAxisRect& rect = *plot_.axisRect();
  while (rect.axisCount(QCPAxis::atRight) > 1) rect.removeAxis(rect.axis(QCPAxis::atRight, 1));
  plot_.yAxis2->setVisible(false);
  axes_.clear();
  for (const PlottedCurve& curve : curves) {
    const bool isNoisy = curve.choice.kind == SeriesChoice::Kind::kAngle ||
                         curve.choice.kind == SeriesChoice::Kind::kTemperature;
    const bool fromZero = !isNoisy && curve.choice.kind != SeriesChoice::Kind::kColumn;
    const double minExtent = isNoisy ? 1.0 : 0.0;
    const auto known = std::find_if(
        axes_.begin(), axes_.end(), [&](const Axis& axis) { return axis.unit == curve.unit; });
    if (known != axes_.end()) {
      // Several quantities share the unit.
      if (known->name != curve.axis) known->name = curve.unit;
      known->fromZero = known->fromZero && fromZero;
      known->minExtent = std::min(known->minExtent, minExtent);
      continue;
    }
    QCPAxis* axis = axes_.empty()       ? plot_.yAxis
                    : axes_.size() == 1 ? plot_.yAxis2
                                        : rect.addAxis(QCPAxis::atRight);
    axis->setVisible(true);
    axis->setTickLabels(true);
    if (axis != plot_.yAxis) styleExtraAxis(*axis, plot_);
    axes_.push_back({curve.unit, curve.axis, fromZero, axis, curve.conversion, minExtent});
    // The axis may have been that of another unit.
    scale(axes_.back(), {axis->range().lower, axis->range().upper});
  }
  if (axes_.empty()) plot_.yAxis->setRange(0.0, 1.0);
  for (const Axis& axis : axes_) {
    const auto own = byHand_.find(axis.unit);
    if (own != byHand_.end()) scale(axis, own->second);
  }
  nameAxes();
}

void UnitAxes::nameAxes() {
  plot_.yAxis->setLabel({});
  QStringList left, right;
  for (const Axis& axis : axes_) {
    const QString how = QString(byHand_.contains(axis.unit) ? ", by hand" : "") +
                        (logarithmic_.contains(axis.unit) ? ", log" : "");
    axis.axis->setLabel(fittingName(axis.name + how, axis.unit + how, plot_));
    axis.axis->setProperty(kWholeNameProperty, axis.name + how);
    if (axis.axis->label().isEmpty()) (axis.axis == plot_.yAxis ? left : right) << axis.unit + how;
  }
  showInCorner(atLeft_, left.join(", "), Qt::AlignLeft | Qt::AlignTop);
  showInCorner(atRight_, right.join(", "), Qt::AlignRight | Qt::AlignTop);
}

void UnitAxes::showInCorner(QPointer<QCPItemText>& word,
                            const QString& text,
                            Qt::Alignment corner) {
  if (word) plot_.removeItem(word);
  if (!text.isEmpty()) word = unitInCorner(plot_, text, corner);
}

QCPAxis* UnitAxes::of(const QString& unit) const {
  const Axis* found = find(unit);
  return found ? found->axis : plot_.yAxis;
}

std::vector<QString> UnitAxes::units() const {
  std::vector<QString> units;
  for (const Axis& axis : axes_) units.push_back(axis.unit);
  return units;
}

QString UnitAxes::nameOf(const QString& unit) const {
  const Axis* found = find(unit);
  return found ? found->name : unit;
}

UnitConversion UnitAxes::conversionOf(const QString& unit) const {
  const Axis* found = find(unit);
  return found ? found->conversion : UnitConversion();
}

bool UnitAxes::fromZero(const QString& unit) const {
  const Axis* found = find(unit);
  return !found || found->fromZero;
}

double UnitAxes::minExtent(const QString& unit) const {
  const Axis* found = find(unit);
  return found ? found->minExtent : 0.0;
}

void UnitAxes::setAutomatic(const QString& unit, const AxisRange& range) {
  const Axis* axis = find(unit);
  if (axis && !byHand_.contains(unit)) scale(*axis, range);
}

void UnitAxes::scale(const Axis& axis, const AxisRange& range) {
  constexpr double kDecades = 1e3;
  constexpr int kTicks = 4;
  if (axis.unit == laneUnit_) return;
  const bool log = logarithmic_.contains(axis.unit);
  const auto type = log ? QCPAxis::stLogarithmic : QCPAxis::stLinear;
  const bool wasOfLanes = !axis.axis->ticker().dynamicCast<QCPAxisTickerText>().isNull();
  if (axis.axis->scaleType() != type || wasOfLanes) {
    axis.axis->setScaleType(type);
    axis.axis->setTicker(log ? QSharedPointer<QCPAxisTicker>(new QCPAxisTickerLog)
                             : QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    axis.axis->ticker()->setTickCount(kTicks);
  }
  AxisRange shown = range;
  if (log && !(shown.to > 0.0)) shown.to = 1.0;
  if (log && !(shown.from > 0.0)) shown.from = shown.to / kDecades;
  axis.axis->setRange(shown.from, shown.to);
}

void UnitAxes::setLogarithmic(const std::set<QString>& units) {
  if (units == logarithmic_) return;
  logarithmic_ = units;
  for (const Axis& axis : axes_) scale(axis, {axis.axis->range().lower, axis.axis->range().upper});
  nameAxes();
  emit logarithmicChanged();
}

void UnitAxes::setLogarithmic(const QString& unit, bool on) {
  std::set<QString> units = logarithmic_;
  if (on)
    units.insert(unit);
  else
    units.erase(unit);
  setLogarithmic(units);
}

void UnitAxes::setByHand(const RangesByHand& ranges) {
  byHand_.clear();
  for (const auto& [unit, range] : ranges)
    if (std::isfinite(range.from) && std::isfinite(range.to) && range.from < range.to)
      byHand_[unit] = range;
  for (const Axis& axis : axes_) {
    const auto own = byHand_.find(axis.unit);
    if (own != byHand_.end()) scale(axis, own->second);
  }
  nameAxes();
  emit byHandChanged();
}

void UnitAxes::setByHand(const QString& unit, const std::optional<AxisRange>& range) {
  RangesByHand ranges = byHand_;
  if (!range)
    ranges.erase(unit);
  else if (std::isfinite(range->from) && std::isfinite(range->to) && range->from < range->to)
    ranges[unit] = *range;
  if (ranges != byHand_) setByHand(ranges);
}

std::optional<QString> UnitAxes::unitAt(const QPointF& at) const {
  const QRect plot = plot_.axisRect()->rect();
  if (at.y() < plot.top() || at.y() > plot.bottom()) return std::nullopt;
  if (at.x() >= plot.left() && at.x() <= plot.right()) return std::nullopt;
  for (const Axis& axis : axes_) {
    if (axis.unit == laneUnit_) continue;
    // The first axis also has the margin left of it.
    if (axis.axis == plot_.yAxis && at.x() < plot.left()) return axis.unit;
    if (axis.axis->selectTest(at, false) >= 0.0) return axis.unit;
  }
  return std::nullopt;
}

bool UnitAxes::wheel(const QWheelEvent& event) {
  const auto unit = unitAt(event.position());
  if (!unit) return false;
  const QCPAxis& axis = *of(*unit);
  const double factor = std::pow(kWheelZoom, -event.angleDelta().y() / kWheelNotch);
  const double pointed = axis.pixelToCoord(event.position().y());
  if (axis.scaleType() == QCPAxis::stLogarithmic) {
    setByHand(*unit,
              AxisRange{pointed * std::pow(axis.range().lower / pointed, factor),
                        pointed * std::pow(axis.range().upper / pointed, factor)});
    return true;
  }
  // The end of a range that begins at 0 stays there.
  const double fixed = axis.range().lower == 0.0 ? 0.0 : pointed;
  setByHand(*unit,
            AxisRange{fixed + (axis.range().lower - fixed) * factor,
                      fixed + (axis.range().upper - fixed) * factor});
  return true;
}

bool UnitAxes::press(const QMouseEvent& event) {
  if (event.button() != Qt::LeftButton) return false;
  const auto unit = unitAt(event.position());
  if (!unit) return false;
  dragged_ = *unit;
  draggedFrom_ = {of(*unit)->range().lower, of(*unit)->range().upper};
  pressedY_ = event.position().y();
  return true;
}

bool UnitAxes::move(const QMouseEvent& event) {
  if (dragged_.isEmpty()) return false;
  if (of(dragged_)->scaleType() == QCPAxis::stLogarithmic) {
    const double ratio =
        std::pow(draggedFrom_.to / draggedFrom_.from,
                 (event.position().y() - pressedY_) / std::max(1, plot_.axisRect()->height()));
    if (ratio != 1.0)
      setByHand(dragged_, AxisRange{draggedFrom_.from * ratio, draggedFrom_.to * ratio});
    return true;
  }
  const double perPixel =
      (draggedFrom_.to - draggedFrom_.from) / std::max(1, plot_.axisRect()->height());
  const double moved = (event.position().y() - pressedY_) * perPixel;
  if (moved != 0.0)
    setByHand(dragged_, AxisRange{draggedFrom_.from + moved, draggedFrom_.to + moved});
  return true;
}

bool UnitAxes::release() {
  if (dragged_.isEmpty()) return false;
  dragged_.clear();
  return true;
}

bool UnitAxes::doubleClick(const QMouseEvent& event) {
  const auto unit = unitAt(event.position());
  if (!unit) return false;
  dragged_.clear();
  setByHand(*unit, std::nullopt);
  return true;
}

}  // namespace palpate::gui
