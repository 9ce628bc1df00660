// What the chart of a comparison shows besides A and B: further recordings or grasps, and their
// average.
#pragma once

#include <QString>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/model/timing.h>
#include <palpate/signals/average_curve.h>

namespace palpate::gui {

enum class CompareOverlay {
  kPair,        // only A and B
  kRecordings,  // all open recordings, aligned with A
  kGraspsOfA,   // the grasps of A, laid over each other where they begin
  kAllGrasps    // the grasps of all open recordings
};
inline constexpr std::array kAllCompareOverlays = {CompareOverlay::kPair,
                                                   CompareOverlay::kRecordings,
                                                   CompareOverlay::kGraspsOfA,
                                                   CompareOverlay::kAllGrasps};
// "A and B", "all recordings", "grasps of A", "all grasps"
QString nameOf(CompareOverlay overlay);

enum class CompareBand { kNone, kStandardDeviation, kPercentiles };
inline constexpr std::array kAllCompareBands = {
    CompareBand::kNone, CompareBand::kStandardDeviation, CompareBand::kPercentiles};
// "no average", "mean ± sd", "median, 10–90 %"
QString nameOf(CompareBand band);

// A curve besides those of A and B, or a grasp of one of them.
struct OverlaidCurve {
  QString name;  // "third.dsa", "early.dsa, grasp 2"
  AlignedCurve curve;
  // Index among the recordings: 0 for A, 1 for B, 2 and on for the others; decides the colour.
  std::size_t recording = 0;
  // False for A and B as a whole, which the chart draws anyway.
  bool drawn = true;
};

struct ComparedCurves {
  std::vector<OverlaidCurve> curves = {};
  // The moment that all have in common, on A's time axis [s].
  double zeroS = 0.0;
  // The span to show on A's time axis; empty: everything.
  std::optional<TimeSpan> span = {};
  // Null: none was asked for.
  std::shared_ptr<const AverageCurve> average = {};
  CompareBand band = CompareBand::kNone;
  // Recordings that were left out, and why; one line, empty: none.
  QString leftOut = {};
};

// The average and every curve of it, a row per time; no row without an average.
TextTable averageTable(const ComparedCurves& compared, const QString& unit);

}  // namespace palpate::gui
