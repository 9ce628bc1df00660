// Curves of each finger in a lane of their own, one above another on one scale: curves that would
// cover one another are seen side by side.
#pragma once

#include <QString>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/signals/axis_range.h>

#include "gui/chart/plotted_curve.h"

class QCPAxis;

namespace palpate::gui {

class Lanes {
 public:
  // A lane for each finger of the curves of matrices, and one for all others of their unit; the
  // first finger is at the top. Of a single lane, or without a hand: none.
  void set(const std::vector<PlottedCurve>& curves, const HandDescription* hand);
  bool any() const noexcept { return numLanes_ > 1; }
  std::size_t size() const noexcept { return numLanes_; }
  // The unit of the curves in lanes; other curves have no lane.
  const QString& unit() const noexcept { return unit_; }
  // What each lane shows, from its lower to its upper end.
  void setRange(const AxisRange& range) { range_ = range; }
  // Where a value of a curve is on the axis, which counts lanes from the lowest one.
  double placed(std::size_t curve, double value) const;
  // Makes it the axis of the lanes: both ends of the range are named at each.
  void scale(QCPAxis& axis) const;

 private:
  std::size_t numLanes_ = 0;
  std::vector<int> laneOf_;  // per curve, from the lowest one; below 0: none
  QString unit_;
  AxisRange range_{0.0, 1.0};
};

}  // namespace palpate::gui
