// The last minutes of a live source, for a rolling chart: characteristic signals, taxels, joint
// angles, temperatures and forces of every frame, and every sample of further series. Filled by
// live processing, read by the display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <palpate/live/live_results.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// The values of all places of a frame, of which most are usually 0: either only those that are not
// 0, with their places, or all of them, whichever takes less memory.
class KeptTaxels {
 public:
  KeptTaxels() = default;
  explicit KeptTaxels(const std::vector<float>& values);
  // Mean of the places for which `chosen` is set; 0 when none is. Places beyond the end of either
  // count as 0. `numChosen`: number of set places.
  double meanOf(const std::vector<bool>& chosen, std::size_t numChosen) const;
  std::size_t bytes() const noexcept;

 private:
  // Ascending; empty: `values_` has all places.
  std::vector<std::uint32_t> places_;
  std::vector<float> values_;
};

// What is kept of one frame.
struct SignalSample {
  std::int64_t hostUs = 0;  // stamp of the frame [us since 1970]
  // True when the sample follows a gap of more than max(1 s, 5 median intervals); the chart then
  // draws no line to it.
  bool afterGap = false;
  std::vector<CharacteristicSignals> rows;  // one per matrix, then all matrices together
  std::shared_ptr<const SensorLayout> layout;
  KeptTaxels taxels;                 // values of the frame (TactileFrame::allValues)
  std::vector<double> anglesDeg;     // the last ones at or before the frame; empty: none
  std::vector<double> temperatures;  // [deg C], likewise
  // Force on each matrix, then on the whole hand [N]; empty: no calibration is applied.
  std::vector<double> forcesN;

  // Memory that the sample takes, approximately.
  std::size_t bytes() const noexcept;
};
using SharedSignalSample = std::shared_ptr<const SignalSample>;

// One column of a further series.
struct ColumnRows {
  std::vector<std::int64_t> hostUs;    // ascending [us since 1970]
  std::vector<double> values;          // one per stamp; NaN: not known
  std::vector<std::size_t> afterGaps;  // indices of rows as SignalSample::afterGap
  std::int64_t gapUs = 0;              // the longest interval that is no gap at present
};

// The oldest samples are dropped as soon as one of the limits is exceeded.
struct SignalHistoryOptions {
  double keepS = 600.0;             // [s], > 0
  std::size_t keepSamples = 30000;  // >= 1
  // Of the frames, and as much again of all further series; about 1.3 kB per sample of an SDH-2, 9
  // bytes and 8 per column of a further one; >= 1.
  std::size_t keepBytes = 64ULL << 20U;
};

// Every function may be called from any thread.
class SignalHistory {
 public:
  // Throws std::invalid_argument naming the field.
  explicit SignalHistory(const SignalHistoryOptions& options = {});

  const SignalHistoryOptions& options() const noexcept { return options_; }
  // Adds the results of SignalsStage. A frame that isn't later than the last one is ignored.
  void add(const LiveResults& results);
  // Adds a sample of a further series. One that isn't later than the last of its series is ignored;
  // where the columns are others than before, those before are dropped.
  void add(const FurtherSample& sample);
  void clear();
  // Samples later than a stamp, oldest first.
  std::vector<SharedSignalSample> after(std::int64_t hostUs) const;
  // Rows of a further series later than a stamp; none where there is no such series or column.
  ColumnRows column(const std::string& series,
                    const std::string& column,
                    std::int64_t afterUs) const;
  // Stamp of the oldest sample; empty: there is none.
  std::optional<std::int64_t> oldestUs() const;
  std::size_t size() const;
  // Memory of all samples, approximately.
  std::size_t bytes() const;

 private:
  // The newest intervals between stamps.
  struct Intervals {
    std::int64_t gapUs() const;  // the longest that is no gap
    void add(std::int64_t us);
    std::deque<std::int64_t> newestUs = {};
  };
  struct Kept {
    std::shared_ptr<const SeriesDescription> series;
    std::deque<std::int64_t> hostUs = {};
    std::deque<bool> afterGap = {};
    std::deque<double> values = {};  // row after row
    Intervals intervals = {};
    std::size_t bytes() const noexcept;
    void dropOldest();
  };
  void dropOldRows(std::int64_t newestUs);

  const SignalHistoryOptions options_;
  mutable std::mutex mutex_;
  std::deque<SharedSignalSample> samples_;
  std::size_t bytes_ = 0;
  Intervals intervals_;
  std::vector<Kept> further_;
};

}  // namespace palpate
