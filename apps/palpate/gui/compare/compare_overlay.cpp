#include "gui/compare/compare_overlay.h"

#include <cmath>

#include <palpate/core/number_text.h>

namespace palpate::gui {

QString nameOf(CompareOverlay overlay) {
  switch (overlay) {
    case CompareOverlay::kRecordings:
      return "all recordings";
    case CompareOverlay::kGraspsOfA:
      return "grasps of A";
    case CompareOverlay::kAllGrasps:
      return "all grasps";
    case CompareOverlay::kPair:
      break;
  }
  return "A and B";
}

QString nameOf(CompareBand band) {
  switch (band) {
    case CompareBand::kStandardDeviation:
      return "mean ± sd";
    case CompareBand::kPercentiles:
      return "median, 10–90 %";
    case CompareBand::kNone:
      break;
  }
  return "no average";
}

TextTable averageTable(const ComparedCurves& compared, const QString& unit) {
  const bool percentiles = compared.band == CompareBand::kPercentiles;
  const std::string inUnit = " [" + unit.toStdString() + "]";
  TextTable table{.header = {"time_s",
                             "from_contact_s",
                             "curves",
                             (percentiles ? "median" : "mean") + inUnit,
                             (percentiles ? "p10" : "low") + inUnit,
                             (percentiles ? "p90" : "high") + inUnit}};
  if (!compared.average) return table;
  const std::shared_ptr<const AverageCurve> average = compared.average;
  auto columns = std::make_shared<std::vector<std::vector<double>>>();
  for (const OverlaidCurve& each : compared.curves) {
    table.header.push_back(each.name.toStdString() + inUnit);
    columns->push_back(alignedValues(each.curve, average->timeS));
  }
  table.numRows = average->timeS.size();
  table.row = [average, columns, zeroS = compared.zeroS](std::size_t i) {
    const auto cell = [](double value) {
      return std::isfinite(value) ? numberText(value) : std::string();
    };
    std::vector<std::string> cells = {numberText(average->timeS[i] + zeroS),
                                      numberText(average->timeS[i]),
                                      std::to_string(average->count[i]),
                                      cell(average->middle[i]),
                                      cell(average->low[i]),
                                      cell(average->high[i])};
    for (const auto& column : *columns) cells.push_back(cell(column[i]));
    return cells;
  };
  return table;
}

}  // namespace palpate::gui
