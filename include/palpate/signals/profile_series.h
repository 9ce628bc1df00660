// What can be plotted of a profile over time: a characteristic signal of a matrix, chosen taxels, a
// joint angle, a temperature. Times are seconds from the first frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/taxel_selection.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

struct SeriesChoice {
  enum class Kind {
    kMatrix,      // `signal` of matrix `index`; index = number of matrices: of the whole hand
    kTaxels,      // mean value of `taxels` [counts]; those that feel nothing count as 0
    kAngle,       // joint angle `index` [deg]
    kTemperature  // sensor `index` [deg C]; an exact 0 is a sensor that said nothing: NaN
  };
  Kind kind = Kind::kMatrix;
  std::size_t index = 0;
  SignalKind signal = SignalKind::kMean;
  TaxelSelection taxels = {};
  bool operator==(const SeriesChoice&) const = default;
};

struct Series {
  std::vector<double> timeS;  // ascending
  std::vector<double> values;
};

// Whether the profile has it. (Angles and temperatures may be missing; another hand has other
// matrices.)
bool hasSeries(const Profile& profile, const SeriesChoice& choice);

// How many samples lie within fromS..toS.
std::size_t numSamples(const Profile& profile,
                       const SeriesChoice& choice,
                       double fromS,
                       double toS);

// All samples within fromS..toS, and the nearest on either side of it. Throws std::invalid_argument
// where the profile hasn't it, Cancelled.
Series readSeries(const Profile& profile,
                  const SeriesChoice& choice,
                  double fromS,
                  double toS,
                  const Progress& progress = {});
// The same without keeping anything: calls sink(timeS, value) for all samples in order.
void visitSeries(const Profile& profile,
                 const SeriesChoice& choice,
                 const std::function<void(double timeS, double value)>& sink,
                 const Progress& progress = {});

// About numSteps + 1 samples spread evenly over the time of the frames, none twice: a first look at
// a long recording. Throws as above.
Series readSpread(const Profile& profile,
                  const SeriesChoice& choice,
                  std::size_t numSteps,
                  const Progress& progress = {});

// Mean of the chosen taxels [counts]; 0 where none is chosen.
double meanOf(const TactileFrame& frame, const TaxelSelection& taxels);

}  // namespace palpate
