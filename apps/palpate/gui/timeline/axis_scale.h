// How a vertical axis of the timeline is scaled: to its curves or by hand, linear or logarithmic.
#pragma once

#include <QSettings>
#include <QString>
#include <map>

class QCPAxis;

namespace palpate::gui {

struct AxisScale {
  bool automatic = true;
  // The range when it is set by hand, in the unit of the axis; low < high.
  double low = 0.0;
  double high = 1000.0;
  // Values of 0 and below lie under the axis.
  bool logarithmic = false;
  bool operator==(const AxisScale&) const = default;
};
// By unit; an axis without an entry is automatic and linear.
using AxisScales = std::map<QString, AxisScale>;

// Scales the axis. `low` and `high`: range of its curves, used when the scale is automatic. A
// logarithmic axis begins three decades below its end where the range reaches 0 or below.
void applyAxisScale(QCPAxis& axis, const AxisScale& scale, double low, double high);

// The scales as they are remembered; an unreadable entry is left out.
AxisScales savedAxisScales(const QSettings& settings);
void saveAxisScales(const AxisScales& scales, QSettings& settings);

}  // namespace palpate::gui
