#include "palpate/signals/curve_rows.h"

#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/frame_difference.h"

namespace palpate {
namespace {

constexpr int kMicroseconds = 6;  // decimals: the resolution of time stamps

struct ComparedMatrix {
  FramePair pair;
  std::size_t matrix;
  double meanA, meanB;
  DifferenceStatistics difference;
};

// A column of the number at a row's place in a list.
ColumnOf<std::size_t> listColumn(std::string name,
                                 std::string unit,
                                 std::string meaning,
                                 std::vector<double> values,
                                 int decimals = -1) {
  return finiteColumn<std::size_t>(
      std::move(name),
      std::move(unit),
      std::move(meaning),
      [values = std::move(values)](std::size_t row) { return values[row]; },
      decimals);
}

std::vector<std::size_t> rowsFrom(std::size_t first, std::size_t end) {
  std::vector<std::size_t> rows;
  for (std::size_t row = first; row < end; ++row) rows.push_back(row);
  return rows;
}

std::vector<ColumnOf<ComparedMatrix>> comparisonColumns(const std::string& unit) {
  using Row = ComparedMatrix;
  return {
      finiteColumn<Row>(
          "time_s",
          "s",
          "time from the first frame of A",
          [](const Row& row) { return row.pair.timeS; },
          kMicroseconds),
      columnOf<Row>(
          "frame_a", "", "frame of A, from 0", [](const Row& row) { return row.pair.frameA; }),
      columnOf<Row>("frame_b",
                    "",
                    "frame of B at that time, from 0",
                    [](const Row& row) { return row.pair.frameB; }),
      columnOf<Row>("matrix", "", "number of the matrix, from 0", &Row::matrix),
      columnOf<Row>("mean_a", unit, "mean of the touched taxels in A", &Row::meanA),
      columnOf<Row>("mean_b", unit, "mean of the touched taxels in B", &Row::meanB),
      columnOf<Row>("difference_mean",
                    unit,
                    "mean of A - B over the taxels that are touched in either",
                    [](const Row& row) { return row.difference.mean; }),
      columnOf<Row>("difference_rms",
                    unit,
                    "root of the mean square of A - B over these",
                    [](const Row& row) { return row.difference.rms; })};
}

}  // namespace

std::unique_ptr<ResultTable> curveTable(std::vector<NamedCurve> curves,
                                        std::size_t first,
                                        std::size_t last) {
  std::vector<ColumnOf<std::size_t>> columns = {
      columnOf<std::size_t>("frame",
                            "",
                            "number of the frame, from 0",
                            [](std::size_t row) { return row; }),
      listColumn("time_s",
                 "s",
                 "time from the first frame",
                 curves.empty() ? std::vector<double>() : curves.front().series.timeS)};
  for (NamedCurve& curve : curves)
    columns.push_back(listColumn(std::move(curve.name),
                                 "",
                                 "value of the formula, in the unit that it has",
                                 std::move(curve.series.values)));
  return std::make_unique<RowTable<std::size_t>>(
      "curves", std::move(columns), rowsFrom(first, last + 1));
}

std::unique_ptr<ResultTable> averageTable(const AverageCurve& average,
                                          const AverageOptions& options,
                                          std::span<const AlignedCurve> curves,
                                          std::span<const std::string> names) {
  const bool percentiles = options.band == AverageBand::kPercentiles;
  const std::string low = percentiles ? "p" + numberText(options.lowPercent) : "low";
  const std::string high = percentiles ? "p" + numberText(options.highPercent) : "high";
  std::vector<ColumnOf<std::size_t>> columns = {
      listColumn("time_s",
                 "s",
                 "time from the moment that all are aligned at",
                 average.timeS,
                 kMicroseconds),
      columnOf<std::size_t>("curves",
                            "",
                            "number of curves that have a value",
                            [count = average.count](std::size_t row) { return count[row]; }),
      listColumn(percentiles ? "median" : "mean", "", "of the curves", average.middle),
      listColumn(low,
                 "",
                 percentiles ? "lower percentile" : "mean less a standard deviation (n - 1)",
                 average.low),
      listColumn(high,
                 "",
                 percentiles ? "upper percentile" : "mean and a standard deviation (n - 1)",
                 average.high)};
  for (std::size_t i = 0; i < curves.size(); ++i)
    columns.push_back(
        listColumn(names[i], "", "value of this curve", alignedValues(curves[i], average.timeS)));
  return std::make_unique<RowTable<std::size_t>>(
      "average", std::move(columns), rowsFrom(0, average.timeS.size()));
}

std::unique_ptr<ResultTable> comparisonTable(const TimedProfile& a,
                                             const TimedProfile& b,
                                             double offsetS,
                                             const Progress& progress) {
  const FrameComparison comparison(a.profile.hand().layout, b.profile.hand().layout);
  const auto pairs = std::make_shared<FramePairs>(a, b, offsetS);
  const auto self = std::make_shared<ResultTable*>();
  auto table = std::make_unique<RowTable<ComparedMatrix>>(
      "comparison",
      comparisonColumns(a.profile.hand().unit),
      [comparison, pairs, progress, self, any = false](std::vector<ComparedMatrix>& rows) mutable {
        if (!pairs->next(progress)) {
          if (!any) (*self)->note("the two have no moment in common at this alignment");
          return false;
        }
        any = true;
        const auto differences = comparison.statistics(pairs->inA(), pairs->inB());
        for (std::size_t m = 0; m + 1 < differences.size(); ++m)
          if (comparison.compared(m))
            rows.push_back({pairs->pair(),
                            m,
                            characteristicSignals(pairs->inA(), m).mean,
                            characteristicSignals(pairs->inB(), m).mean,
                            differences[m]});
        return true;
      });
  *self = table.get();
  return table;
}

}  // namespace palpate
