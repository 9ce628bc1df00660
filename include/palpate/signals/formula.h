// A curve that is computed from the signals of a profile by a formula: a difference, a ratio, a
// derivative. muParser evaluates the formula. The command `derive` and the timeline use it.
//
//   operators   + - * / ^ ( ), comparisons, && ||, condition ? a : b
//   functions   abs sqrt min max sum avg exp ln log10 log2 sin cos tan asin acos atan rint sign ..
//   der(x)      slope of x over time [1/s]; x is any formula
//   smooth(x, n), median(x, n)
//               mean or median of n samples, odd, around each sample
//   lowpass(x, hz), highpass(x, hz), bandpass(x, low, high), bandstop(x, low, high)
//               Butterworth filter of order 2, forward and backward: without delay
//               (filter/butterworth.h)
//               All of these end on either side of a gap.
//   t           time from the first frame [s]
//   signals     m1_mean, hand_sum, m5_x2_y9, angle3, temperature4, wrist_fz:
//               signals/signal_name.h
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/signals/profile_series.h>

namespace palpate {

// Parts a text at its commas outside of brackets; what is around them stays.
std::vector<std::string> splitAtCommas(const std::string& text);

// Slope of a series over time: central differences of second order for uneven stamps, one-sided
// ones at the ends, as numpy.gradient(values, timeS). Intervals longer than `longestS` are gaps:
// each side ends there. NaN for a single sample. Throws std::invalid_argument unless times ascend,
// one per value.
std::vector<double> derivativeOf(std::span<const double> timeS,
                                 std::span<const double> values,
                                 double longestS);

// A parsed formula.
class Formula {
 public:
  static constexpr std::size_t kLongest = 1000;  // letters

  // Throws std::invalid_argument that says what is wrong with the text.
  explicit Formula(const std::string& text);
  ~Formula();
  Formula(const Formula& other);
  Formula& operator=(const Formula& other);

  const std::string& text() const noexcept { return text_; }
  // The names of the signals in the formula, without t, in alphabetical order.
  const std::vector<std::string>& names() const noexcept { return names_; }

  // Number of samples before and after a sample on which its value depends, at a rate [Hz]: 0
  // without a slope or filter; of a frequency filter at most 20,000.
  std::size_t reach(double rateHz) const;

  // Whether it has a frequency filter: its rate is that of all samples between two gaps.
  bool hasFrequencyFilter() const;

  // Computes the curve at every time [s]; `values` has the signals in the order of names(), one
  // value per time. `longestS`: longer intervals are gaps for der(). Throws std::invalid_argument
  // for other sizes, and when the formula can't be computed; Cancelled.
  std::vector<double> evaluate(std::span<const double> timeS,
                               const std::vector<std::vector<double>>& values,
                               double longestS,
                               const Progress& progress = {}) const;

 private:
  struct SeriesCall;
  std::string text_;
  // With der(..) and filters replaced by variables.
  std::string parsed_;
  std::vector<std::string> names_;
  std::vector<SeriesCall> calls_;
};

// Computes the formula at every frame of fromS..toS. Angles and temperatures are interpolated at
// the frames; of a further series the last sample at or before a frame counts. The values don't
// depend on the span: a formula with a frequency filter is computed from gap to gap. Throws
// std::invalid_argument for a name that is not a signal or that the profile lacks, and as Formula;
// Cancelled; Error (a frame that can't be read). With `unreadable`, frames at which a signal can't
// be read are added to it instead, and their values are NaN; slopes and filters beside them are
// computed as if the signal ran straight from one side to the other.
Series formulaSeries(const Profile& profile,
                     const Formula& formula,
                     double fromS,
                     double toS,
                     const Progress& progress = {},
                     UnreadableSamples* unreadable = nullptr);

}  // namespace palpate
