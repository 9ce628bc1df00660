// Curves over time as result tables. docs/manual/columns.md explains the columns.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/signals/alignment.h>
#include <palpate/signals/average_curve.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

struct NamedCurve {
  std::string name;
  Series series = {};  // a sample for each frame
};
// The table "curves" of the frames first..last (inclusive): their time and the value of each curve.
std::unique_ptr<ResultTable> curveTable(std::vector<NamedCurve> curves,
                                        std::size_t first,
                                        std::size_t last);

// The table "average": at each time the average with its band, then each curve by its name.
std::unique_ptr<ResultTable> averageTable(const AverageCurve& average,
                                          const AverageOptions& options,
                                          std::span<const AlignedCurve> curves,
                                          std::span<const std::string> names);

// The table "comparison": a row for each frame of A that has a frame of B at its time, and each
// matrix that can be compared (FrameComparison). Values in `unit`. Its rows throw Cancelled, Error.
std::unique_ptr<ResultTable> comparisonTable(const TimedProfile& a,
                                             const TimedProfile& b,
                                             double offsetS,
                                             const Progress& progress = {});

}  // namespace palpate
