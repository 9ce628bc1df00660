// Reads the time series of a profile that charts can plot: a characteristic signal of a matrix,
// selected taxels, a joint angle, a temperature, or a column of a further series. Times are seconds
// from the first frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/taxel_selection.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// Selects one time series of a profile.
struct SeriesChoice {
  enum class Kind {
    // `signal` of matrix `index`; with index = number of matrices, of the whole hand,
    // which has no components (isComponent()).
    kMatrix,
    // Mean value of `taxels` [counts]; unloaded taxels count as 0.
    kTaxels,
    kAngle,  // joint angle `index` [deg]
    // Temperature sensor `index` [deg C]; NaN where the value is exactly 0, since the sensor has
    // not reported then.
    kTemperature,
    // Force on matrix `index` [N]; with index = number of matrices, on the whole hand. Only of live
    // sources (live/live_series.h): a profile has none without a calibration.
    kForce,
    // What `formula` makes of the signals of the recording (signals/formula.h), at every frame.
    kFormula,
    // Column `column` of the further series `series`, both by name, which are the same in other
    // recordings; in the column's unit, NaN where the value is not known.
    kColumn
  };
  Kind kind = Kind::kMatrix;
  std::size_t index = 0;
  SignalKind signal = SignalKind::kMean;
  TaxelSelection taxels = {};
  std::string formula = {};
  std::string series = {};
  std::string column = {};
  bool operator==(const SeriesChoice&) const = default;
};

// Which value of the samples of which series a choice means: an angle, a temperature, a column.
struct SeriesColumn {
  std::size_t series = kAngleSeries;
  std::size_t column = 0;
};
// Empty: the choice is one of frames, or the profile hasn't that series with samples, or that
// column.
std::optional<SeriesColumn> columnOf(const Profile& profile, const SeriesChoice& choice);
// The value in a sample: NaN where it is not known, as a temperature that is exactly 0.
double valueIn(const Sample& sample, const SeriesColumn& column);

// Its unit: "counts", "taxels", "deg"; empty for a formula, and for a column without one.
std::string seriesUnit(const Profile& profile, const SeriesChoice& choice);

// Times [s] and values of a time series.
struct Series {
  std::vector<double> timeS;  // ascending
  std::vector<double> values;
};

// Returns whether the profile has the series. (Series may be missing, and another hand has other
// matrices.)
bool hasSeries(const Profile& profile, const SeriesChoice& choice);
// Why it hasn't, with the remedy, where that is known: "needs a calibration: .."; else empty.
std::string whyMissing(const Profile& profile, const SeriesChoice& choice);

// Whether its values are at hand; false: the first to read them computes series of the profile that
// are computed (Profile::isReady()), of a formula those that it names. True where hasSeries()
// isn't.
bool isReady(const Profile& profile, const SeriesChoice& choice);

// Returns the number of samples within fromS..toS.
std::size_t numSamples(const Profile& profile,
                       const SeriesChoice& choice,
                       double fromS,
                       double toS);

// Returns all samples within fromS..toS, and the nearest sample on either side of that span. With
// `unreadable`, samples that can't be read because the recording is damaged are added to it, and
// their values are NaN. Throws std::invalid_argument when the profile does not have the series, or
// the formula can't be computed, Cancelled, and without `unreadable` Error.
Series readSeries(const Profile& profile,
                  const SeriesChoice& choice,
                  double fromS,
                  double toS,
                  const Progress& progress = {},
                  UnreadableSamples* unreadable = nullptr);
// Calls sink(timeS, value) for all samples in order and keeps none of them.
void visitSeries(const Profile& profile,
                 const SeriesChoice& choice,
                 const std::function<void(double timeS, double value)>& sink,
                 const Progress& progress = {},
                 UnreadableSamples* unreadable = nullptr);

// Returns about numSteps + 1 different samples, spread evenly over the time of the frames, for a
// quick overview of a long recording. Throws as above.
Series readSpread(const Profile& profile,
                  const SeriesChoice& choice,
                  std::size_t numSteps,
                  const Progress& progress = {},
                  UnreadableSamples* unreadable = nullptr);

// Mean of the selected taxels [counts]; 0 when none is selected.
double meanOf(const TactileFrame& frame, const TaxelSelection& taxels);

}  // namespace palpate
