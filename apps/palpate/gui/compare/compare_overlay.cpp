#include "gui/compare/compare_overlay.h"

#include <cmath>

#include <palpate/core/number_text.h>

namespace palpate::gui {
namespace {

// The times of all averages, which have one step.
std::vector<double> commonTimes(const std::vector<OverlaidAverage>& averages) {
  const AverageCurve* first = averages.front().curve.get();
  const AverageCurve* last = first;
  for (const OverlaidAverage& each : averages) {
    if (each.curve->timeS.empty()) continue;
    if (first->timeS.empty() || each.curve->timeS.front() < first->timeS.front())
      first = each.curve.get();
    if (last->timeS.empty() || each.curve->timeS.back() > last->timeS.back())
      last = each.curve.get();
  }
  std::vector<double> timeS = first->timeS;
  if (timeS.empty()) return timeS;
  const double stepS = first->stepS;
  const auto end = std::llround(last->timeS.back() / stepS);
  for (auto k = std::llround(timeS.back() / stepS) + 1; k <= end; ++k)
    timeS.push_back(static_cast<double>(k) * stepS);
  return timeS;
}

}  // namespace

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

std::optional<std::size_t> placeIn(const AverageCurve& average, double timeS) {
  if (average.stepS <= 0.0 || average.timeS.empty()) return std::nullopt;
  const double step = std::round((timeS - average.timeS.front()) / average.stepS);
  if (step < 0.0 || step >= static_cast<double>(average.timeS.size())) return std::nullopt;
  return static_cast<std::size_t>(step);
}

TextTable averageTable(const ComparedCurves& compared, const QString& unit) {
  const bool percentiles = compared.band == CompareBand::kPercentiles;
  const std::string inUnit = " [" + unit.toStdString() + "]";
  const bool several = compared.averages.size() > 1;
  TextTable table{.header = {"time_s", "from_contact_s"}};
  for (const OverlaidAverage& each : compared.averages) {
    const std::string of = several ? each.of.toStdString() + " " : std::string();
    for (const std::string& name : {std::string("curves"),
                                    (percentiles ? "median" : "mean") + inUnit,
                                    (percentiles ? "p10" : "low") + inUnit,
                                    (percentiles ? "p90" : "high") + inUnit})
      table.header.push_back(of + name);
  }
  if (compared.averages.empty()) return table;
  const std::vector<double> timeS = commonTimes(compared.averages);
  auto columns = std::make_shared<std::vector<std::vector<double>>>();
  for (const OverlaidCurve& each : compared.curves) {
    table.header.push_back(each.name.toStdString() + inUnit);
    columns->push_back(alignedValues(each.curve, timeS));
  }
  table.numRows = timeS.size();
  table.row =
      [averages = compared.averages, timeS, columns, zeroS = compared.zeroS](std::size_t i) {
        const auto cell = [](double value) {
          return std::isfinite(value) ? numberText(value) : std::string();
        };
        std::vector<std::string> cells = {numberText(timeS[i] + zeroS), numberText(timeS[i])};
        for (const OverlaidAverage& each : averages) {
          const AverageCurve& average = *each.curve;
          const auto at = placeIn(average, timeS[i]);
          cells.push_back(std::to_string(at ? average.count[*at] : 0));
          for (const auto* column : {&average.middle, &average.low, &average.high})
            cells.push_back(at ? cell((*column)[*at]) : std::string());
        }
        for (const auto& column : *columns) cells.push_back(cell(column[i]));
        return cells;
      };
  return table;
}

}  // namespace palpate::gui
