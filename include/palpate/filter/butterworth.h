// Butterworth filters of signals (Butterworth 1930): low-pass, high-pass, band-pass and band-stop,
// for the filters of these names. The amplitude has no ripple and is 1/sqrt(2) at every edge.
//
// The filter is a chain of sections of first and second order. Each section keeps the states of the
// analog section, the position x1 and the speed x2 (scaled by the section's frequency w):
//   x1' = w x2,  x2' = w (u - x1 - d x2),  y = h (u - d x2 - x1) + b x2 + l x1
// The states advance by the trapezoidal rule. With even stamps this is the bilinear transform, with
// the edges at their exact frequencies: the results are those of scipy.signal.butter(order, edges,
// fs, output="sos") with sosfilt (initial state sosfilt_zi times the first value) and sosfiltfilt.
//
// Stamps are irregular. As for spectra (signals/spectrum.h), the signal is linear between its
// samples; the step of the rule is then the interval itself, so that nothing has to be resampled.
// An interval of several sampling intervals is advanced in as many steps. The energy x1^2 + x2^2 of
// a section never grows without an input, whatever the intervals are, so that every filter is
// stable. With intervals that vary by 20 %, a low-pass at 20 Hz of 74 Hz returns a tone of 10 Hz
// with an error of 2.4 % (rms); resampling to an even grid before and back after it makes 13 %.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

// Band and order of a filter.
struct ButterworthOptions {
  enum class Band {
    kLowPass,   // passes 0..highHz
    kHighPass,  // passes lowHz and above
    kBandPass,  // passes lowHz..highHz
    kBandStop   // passes all but lowHz..highHz; a narrow one is a notch
  };
  Band band = Band::kLowPass;
  // Lower edge [Hz], > 0; not used by kLowPass.
  double lowHz = 1.0;
  // Upper edge [Hz], above lowHz; not used by kHighPass.
  double highHz = 5.0;
  // Order 1..8. The amplitude falls by 20 dB per decade and order; a band filter has this order at
  // either edge.
  int order = 2;

  bool usesLow() const noexcept { return band != Band::kLowPass; }
  bool usesHigh() const noexcept { return band != Band::kHighPass; }
  // Throws std::invalid_argument that names the field.
  void validate() const;
  // Also throws std::invalid_argument when an edge is at or above half of the rate (Nyquist).
  void validateForRate(double rateHz) const;
};

// One section of a filter for a sampling rate.
struct ButterworthSection {
  bool firstOrder = false;  // x1' = w (u - x1), y = h (u - x1) + l x1
  double step = 0.0;        // w T / 2 of a sampling interval T
  double damping = 0.0;     // d; 2 is critical
  double highGain = 0.0;    // h
  double bandGain = 0.0;    // b
  double lowGain = 0.0;     // l
};
// Designs the sections for a rate [Hz]. Edges at or above 0.499 of the rate are moved there: live,
// a rate may fall. Throws std::invalid_argument as validate(), and for a bad rate.
std::vector<ButterworthSection> butterworthSections(const ButterworthOptions& options,
                                                    double rateHz);
// Number of samples after which less than 1e-9 of an input is left, at a rate [Hz].
double butterworthLength(const ButterworthOptions& options, double rateHz);

// Filters the samples of several signals that have the same stamps; causal. The sampling rate is
// the mean over the last 64 intervals.
class ButterworthFilter {
 public:
  // Throws std::invalid_argument for bad options.
  explicit ButterworthFilter(const ButterworthOptions& options, std::size_t numSignals = 1);

  // Replaces the next sample of every signal by the filtered one. `intervalS` > 0 is the time since
  // the previous sample [s]; ignored for the first sample. The first sample sets the state as if
  // the signal had always had this value. A value that is not finite counts as the one before it (0
  // if there is none). Throws std::invalid_argument for another number of values or a bad interval.
  void step(std::span<double> values, double intervalS);
  // Lets the next sample set the state again; call it after a gap.
  void restart() noexcept;

 private:
  struct State {
    double position = 0.0, speed = 0.0, input = 0.0;
  };
  double nextRate(double intervalS);

  ButterworthOptions options_;
  std::size_t numSignals_;
  std::vector<ButterworthSection> sections_;
  double rateHz_ = 0.0;        // that the sections were designed for
  std::vector<State> states_;  // signal after signal of the first section, then of the next
  std::vector<double> last_;   // the last input of every signal
  std::vector<double> intervalsS_;
  double elapsedS_ = 0.0;  // sum of the stored intervals
  std::size_t nextInterval_ = 0;
  bool started_ = false;
};

// Filters a whole series forward. Times [s] ascend strictly, one per value. `gapSamples` are the
// last samples before each gap, ascending; the filter restarts after a gap. Values that are not
// finite are interpolated from their finite neighbours. An edge at or above half of a stretch's
// mean rate is moved as in butterworthSections(). The functions throw std::invalid_argument for
// other input.
std::vector<double> butterworthFiltered(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const ButterworthOptions& options,
                                        std::span<const std::size_t> gapSamples = {});
// Filters a whole series forward and then backward: without delay, with twice the order. Before
// and after each stretch the series is continued by its reflection through the end point (3 (n + 1)
// samples for n poles, or all that there are), as scipy.signal.sosfiltfilt does.
std::vector<double> butterworthZeroPhase(std::span<const double> timeS,
                                         std::span<const double> values,
                                         const ButterworthOptions& options,
                                         std::span<const std::size_t> gapSamples = {});

}  // namespace palpate
