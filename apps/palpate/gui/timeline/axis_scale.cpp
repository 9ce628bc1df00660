#include "gui/timeline/axis_scale.h"

#include <QStringList>
#include <cmath>

#include "gui/chart/plot.h"

namespace palpate::gui {
namespace {

constexpr const char* kAxisScalesKey = "timeline/axes";
constexpr double kDecades = 1e3;
constexpr int kAxisTicks = 4;

}  // namespace

void applyAxisScale(QCPAxis& axis, const AxisScale& scale, double low, double high) {
  if (!scale.automatic) {
    low = scale.low;
    high = scale.high;
  }
  const bool log = axis.scaleType() == QCPAxis::stLogarithmic;
  if (log != scale.logarithmic) {
    axis.setScaleType(scale.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
    if (scale.logarithmic)
      axis.setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTickerLog));
    else
      axis.setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    axis.ticker()->setTickCount(kAxisTicks);
  }
  if (scale.logarithmic) {
    if (!(high > 0.0)) high = 1.0;
    if (!(low > 0.0)) low = high / kDecades;
  }
  axis.setRange(low, high);
}

// An entry is "unit|automatic|low|high|logarithmic".
AxisScales savedAxisScales(const QSettings& settings) {
  AxisScales scales;
  for (const QString& entry : settings.value(kAxisScalesKey).toStringList()) {
    const QStringList parts = entry.split('|');
    if (parts.size() != 5) continue;
    bool lowRead = false, highRead = false;
    const AxisScale scale{.automatic = parts[1] == "1",
                          .low = parts[2].toDouble(&lowRead),
                          .high = parts[3].toDouble(&highRead),
                          .logarithmic = parts[4] == "1"};
    if (lowRead && highRead && std::isfinite(scale.low) && std::isfinite(scale.high) &&
        scale.low < scale.high)
      scales[parts[0]] = scale;
  }
  return scales;
}

void saveAxisScales(const AxisScales& scales, QSettings& settings) {
  QStringList entries;
  for (const auto& [unit, scale] : scales)
    entries.append(QStringList{unit,
                               scale.automatic ? "1" : "0",
                               QString::number(scale.low, 'g', 17),
                               QString::number(scale.high, 'g', 17),
                               scale.logarithmic ? "1" : "0"}
                       .join('|'));
  settings.setValue(kAxisScalesKey, entries);
}

}  // namespace palpate::gui
