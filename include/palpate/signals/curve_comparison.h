// How alike two curves are over the span of time that they share.
//
// Both are resampled on one time base: from the begin of the common span in steps of the longer of
// the two median intervals (the slower recording sets the pace; nothing is invented between its
// samples), each curve by the straight line between its neighbouring samples. Moments that lie in a
// gap of either curve are left out. Correlation is Pearson's, over that base; like the other
// figures it is symmetric but for the sign of A - B.
#pragma once

#include <cstddef>
#include <optional>

#include <palpate/signals/alignment.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

struct CurveComparison {
  std::size_t samples = 0;  // of the common time base
  double fromS = 0.0;       // common span, on A's axis
  double toS = 0.0;
  double stepS = 0.0;           // 0: fewer than two samples in both curves
  double meanDifference = 0.0;  // of A - B, in the unit of the curves
  double rmsDifference = 0.0;
  double largestDifference = 0.0;  // of largest magnitude, with its sign
  double largestAtS = 0.0;
  // -1..1; nothing: fewer than three samples, or a curve that is constant
  std::optional<double> correlation = {};
};

// Times ascend [s]; b's are shifted by `offsetS` onto a's axis. Intervals longer than `gapS` (a's,
// b's) are gaps; 0: there are none. NaN counts as a gap. Throws std::invalid_argument where times
// and values differ in number.
struct CurveGaps {
  double aS = 0.0;
  double bS = 0.0;
};
CurveComparison compareCurves(const Series& a,
                              const Series& b,
                              double offsetS,
                              const CurveGaps& gaps = {});
// The interval from which on it is a gap (model/timing.h): max(1 s, 5 median intervals).
double gapFromS(const TimingReport& timing);

}  // namespace palpate
