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

// The average of the curves of one recording, or of all curves.
struct OverlaidAverage {
  QString of;                 // name of the recording; empty: all curves
  std::size_t recording = 0;  // as in OverlaidCurve
  std::size_t numCurves = 0;
  std::shared_ptr<const AverageCurve> curve = {};  // never null
};

struct ComparedCurves {
  std::vector<OverlaidCurve> curves = {};
  // The moment that all have in common, on A's time axis [s].
  double zeroS = 0.0;
  // The span to show on A's time axis; empty: everything.
  std::optional<TimeSpan> span = {};
  // Empty: none was asked for. Grasps of different recordings are not averaged together: they have
  // an average for each recording, all with the same step.
  std::vector<OverlaidAverage> averages = {};
  CompareBand band = CompareBand::kNone;
  // What was left out, and why; one line, empty: nothing.
  QString leftOut = {};
};

// The index of the time of an average that is next to `timeS`; nothing: outside of it.
std::optional<std::size_t> placeIn(const AverageCurve& average, double timeS);

// The averages and every curve of them, a row per time; no row without an average.
TextTable averageTable(const ComparedCurves& compared, const QString& unit);

}  // namespace palpate::gui
