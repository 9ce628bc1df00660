// Time series of chosen curves of a live source, made of the samples of a SignalHistory: what a
// rolling chart draws and reads. A curve that is chosen later also has all earlier samples that the
// history keeps. Columns of further series have every sample, at its own time; what is said of
// samples and gaps below is of frames. Times are seconds from the first frame of the history that
// was ever taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <palpate/live/signal_history.h>
#include <palpate/model/timing.h>
#include <palpate/signals/min_max_decimation.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

// Not thread-safe, except that the history may be filled by another thread.
class LiveSeries {
 public:
  // Takes another history, or none (null), and forgets everything. It must outlive this object, or
  // be replaced before it is destroyed.
  void setHistory(const SignalHistory* history);
  // Sets the curves. Values that a sample doesn't have (no such joint, no calibration) are NaN.
  void setWanted(const std::vector<SeriesChoice>& wanted);

  // Takes the samples that were added since the last call, and forgets what the history has
  // dropped. Returns the number of new samples.
  std::size_t update();

  // Frames are missing after a stamp [us since 1970], as an event says: the next sample follows a
  // gap, however short it is.
  void breakAfter(std::int64_t hostUs);

  bool empty() const noexcept { return frames_.empty(); }
  std::size_t numSamples() const noexcept { return frames_.timeS.size() - frames_.first; }
  // Times of the oldest and the newest sample [s]; 0 when there is none.
  double oldestS() const noexcept { return empty() ? 0.0 : frames_.timeS[frames_.first]; }
  double newestS() const noexcept { return empty() ? 0.0 : frames_.timeS.back(); }
  // Stamp of the newest sample [us since 1970]; empty: there is none.
  std::optional<std::int64_t> newestUs() const noexcept { return newestUs_; }
  // Time of a stamp [s]; 0 while there is no sample.
  double secondsOf(std::int64_t hostUs) const noexcept;

  // Decimated points of a curve; gaps break the line. Empty for a curve that isn't wanted.
  std::vector<SeriesPoint> points(const SeriesChoice& choice,
                                  const DecimationOptions& options) const;
  // The value at a time: that of the last sample at or before it. Empty before the first and after
  // the newest sample, in a gap, and where it is NaN. The newest one of a column holds until the
  // newest frame, unless that is a gap.
  std::optional<double> valueAt(const SeriesChoice& choice, double timeS) const;
  // Time of the sample at or before a time, of the first one before that [s]. Empty: no sample.
  std::optional<double> sampleTimeAt(double timeS) const;
  // Time of the sample that is `samples` after (below 0: before) the one at `timeS`, limited to the
  // first and the newest one [s]. Empty: no sample.
  std::optional<double> sampleTimeBeside(double timeS, std::ptrdiff_t samples) const;
  // The gap that contains the time.
  std::optional<TimeSpan> gapAt(double timeS) const;
  // Smallest and largest value from fromS to toS; empty: there is none.
  std::optional<std::pair<double, double>> extremes(const SeriesChoice& choice,
                                                    double fromS,
                                                    double toS) const;
  // Gaps among the samples, ascending.
  std::vector<TimeSpan> gaps() const;

 private:
  // The samples from index `first` on; those before are forgotten and are removed some at a time.
  struct Times {
    std::vector<double> timeS;
    std::size_t first = 0;
    std::vector<std::size_t> breaks;  // indices of the last samples before gaps, ascending
    bool empty() const noexcept { return first == timeS.size(); }
    // Index of the last sample at or before the time; empty: there is none.
    std::optional<std::size_t> indexAt(double atS) const;
    bool breaksAt(std::size_t index) const;
    // Returns how many samples at the beginning were removed.
    std::size_t forgetBefore(double oldestS);
  };
  struct Entry {
    SeriesChoice choice;
    // kColumn: its own samples.
    Times own = {};
    std::optional<std::int64_t> newestUs = {};
    double gapS = 0.0;  // the longest interval that is no gap at present
    // kTaxels: the chosen places in frames of the layout.
    std::shared_ptr<const SensorLayout> layout = {};
    std::vector<bool> chosen = {};
    std::size_t numChosen = 0;
    std::vector<double> values = {};  // one for each of timesOf()
    bool isColumn() const noexcept { return choice.kind == SeriesChoice::Kind::kColumn; }
  };
  const Times& timesOf(const Entry& entry) const { return entry.isColumn() ? entry.own : frames_; }
  void takeColumn(Entry& entry);
  const Entry* find(const SeriesChoice& choice) const;
  static double valueOf(Entry& entry, const SignalSample& sample);
  void forgetBefore(std::int64_t hostUs);

  const SignalHistory* history_ = nullptr;
  std::optional<std::int64_t> originUs_;
  std::optional<std::int64_t> newestUs_;
  Times frames_;
  std::optional<std::int64_t> breakAfterUs_;  // of a sample that is yet to come
  std::vector<Entry> entries_;
};

}  // namespace palpate
