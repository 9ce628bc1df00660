// Time series of chosen curves of a live source, made of the samples of a SignalHistory: what a
// rolling chart draws and reads. A curve that is chosen later also has all earlier samples that the
// history keeps. Times are seconds from the first sample of the history that was ever taken.
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

  bool empty() const noexcept { return first_ == timeS_.size(); }
  std::size_t numSamples() const noexcept { return timeS_.size() - first_; }
  // Times of the oldest and the newest sample [s]; 0 when there is none.
  double oldestS() const noexcept { return empty() ? 0.0 : timeS_[first_]; }
  double newestS() const noexcept { return empty() ? 0.0 : timeS_.back(); }
  // Stamp of the newest sample [us since 1970]; empty: there is none.
  std::optional<std::int64_t> newestUs() const noexcept { return newestUs_; }
  // Time of a stamp [s]; 0 while there is no sample.
  double secondsOf(std::int64_t hostUs) const noexcept;

  // Decimated points of a curve; gaps break the line. Empty for a curve that isn't wanted.
  std::vector<SeriesPoint> points(const SeriesChoice& choice,
                                  const DecimationOptions& options) const;
  // The value at a time: that of the last sample at or before it. Empty before the first and after
  // the newest sample, in a gap, and where it is NaN.
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
  struct Entry {
    SeriesChoice choice;
    // kTaxels: the chosen places in frames of the layout.
    std::shared_ptr<const SensorLayout> layout;
    std::vector<bool> chosen;
    std::size_t numChosen = 0;
    std::vector<double> values;  // one for each of timeS_
  };
  const Entry* find(const SeriesChoice& choice) const;
  // Index of the last sample at or before the time; empty: there is none.
  std::optional<std::size_t> indexAt(double timeS) const;
  static double valueOf(Entry& entry, const SignalSample& sample);
  void forgetBefore(std::int64_t hostUs);

  const SignalHistory* history_ = nullptr;
  std::optional<std::int64_t> originUs_;
  std::optional<std::int64_t> newestUs_;
  // The samples from index first_ on; those before are forgotten and are removed some at a time.
  std::vector<double> timeS_;
  std::size_t first_ = 0;
  // Indices of the last samples before gaps, ascending.
  std::vector<std::size_t> breaks_;
  std::optional<std::int64_t> breakAfterUs_;  // of a sample that is yet to come
  std::vector<Entry> entries_;
};

}  // namespace palpate
