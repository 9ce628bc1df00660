// Spectra of one signal over time: the short-time Fourier transform of a series whose samples come
// when they come (study 5.1; Welch 1967 for the scaling; the window's values as in Harris 1978).
//
// Time stamps are irregular (25 % jitter at 74 Hz), but a Fourier transform needs a regular grid.
// Each gap-free span is therefore interpolated linearly onto a regular grid at its own rate.
// Frequencies above half of that rate (Nyquist) cannot be measured, and components above it are
// aliased. Interpolation attenuates high frequencies if the stamps are irregular:
// interpolationGain(). Regular stamps lose nothing.
//
// Segment of N samples x_n, every `hop` = N - overlap samples; its trend is taken away (detrend),
// then the periodic Hann window w_n = (1 - cos(2 pi n / N)) / 2 is laid on (periodic: zero at n =
// 0, not at n = N - 1; its bins are free of leakage from tones at other bins two or more away).
// With X_k = sum x_n w_n e^(-2 pi i k n / N), k = 0..N/2:
//   psd_k       = c |X_k|^2 / (rate sum w_n^2)   [units^2/Hz], one-sided
//   magnitude_k = c' |X_k| / sum w_n             [units]: a tone of amplitude A at a bin reads A
// with c = c' = 2, but 1 at k = 0 and (N even) k = N/2. Parseval: sum psd_k rate/N = sum (x_n
// w_n)^2 / sum w_n^2. A tone half way between two bins reads down to 0.849 A (scalloping).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <palpate/core/progress.h>

namespace palpate {

// What is taken from a segment before the window is laid on it.
enum class Detrend {
  kNone,  // nothing: a resting load stands at 0 Hz and leaks into the bin beside it
  kMean,  // the segment's mean
  kLine   // its line of least squares: loads that rise or fall don't fill the lowest bins
};

// The even grid's rate in a stretch.
enum class GridRate {
  kMean,   // (samples - 1) / duration: as many samples as there are
  kMedian  // 1 / median interval: what the stretch would have had without its delays
};

struct SpectrumOptions {
  int window = 32;   // N [samples], 2..65,536; any number, not only powers of two
  int overlap = 31;  // [samples] that a segment shares with the next, 0..window-1
  Detrend detrend = Detrend::kMean;
  GridRate gridRate = GridRate::kMean;
  // At most so many segments: the hop grows until they fit (beyond `window` samples between two are
  // in none). 0: no limit.
  std::size_t maxSegments = 0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
  std::size_t numBins() const noexcept { return static_cast<std::size_t>(window) / 2 + 1; }
};

// Samples without a gap between them.
struct GapFreeSpan {
  std::size_t first = 0;    // index of its first finite sample in the series
  std::size_t samples = 0;  // finite samples
  double beginS = 0.0;      // time of its first and last sample [s], as given
  double endS = 0.0;
  double rateHz = 0.0;          // of its grid; 0 with one sample
  std::size_t gridSamples = 0;  // on the grid
  std::size_t segments = 0;     // 0: shorter than a window
};

struct SpectrumReport {
  std::size_t samples = 0;  // given
  // of them NaN or infinite: left out, interpolated over unless that makes a gap
  std::size_t notFinite = 0;
  std::size_t inNoSegment = 0;  // finite samples of stretches shorter than a window
  std::vector<GapFreeSpan> stretches;
  std::size_t segments = 0;
  // [samples of the grid] between segments; above window - overlap where maxSegments asked
  std::size_t hop = 1;
  double rateHz = 0.0;     // of the longest stretch; 0: fewer than two samples
  double nyquistHz = 0.0;  // half of it: nothing above can be seen
  double jitter = 0.0;  // sd of the intervals within stretches / their mean; 0 with fewer than two
};

// One segment; its spans live only during the call.
struct SpectrumSegment {
  std::size_t segment = 0;            // 0, 1, .. through all stretches
  std::size_t stretch = 0;            // index in the report
  double timeS = 0.0;                 // of its middle, where the window is 1: sample N/2 [s]
  double binHz = 0.0;                 // bin k is at k * binHz
  std::span<const double> psd;        // numBins() values [units^2/Hz]
  std::span<const double> magnitude;  // numBins() values [units]
};
using SpectrumSink = std::function<void(const SpectrumSegment&)>;

// What there is to see, without a transform: rates, stretches, number of segments. Times [s] must
// ascend strictly and be finite, one per value: std::invalid_argument otherwise, and for bad
// options. A gap: an interval longer than max(1 s, 5 median intervals); no segment spans one.
SpectrumReport planSpectra(std::span<const double> timeS,
                           std::span<const double> values,
                           const SpectrumOptions& options = {});
// The same, and every segment in order. A series shorter than a window has none; a constant one is
// zero in every bin (unless nothing is taken away: then at 0 Hz and the bin beside it). Throws
// Cancelled as well.
SpectrumReport visitSpectra(std::span<const double> timeS,
                            std::span<const double> values,
                            const SpectrumOptions& options,
                            const SpectrumSink& sink,
                            const Progress& progress = {});

// The mean over all segments of one rate and their strongest line.
struct MeanSpectrum {
  double binHz = 0.0;
  std::size_t segments = 0;
  std::vector<double> psd;        // [units^2/Hz], mean (Welch's estimate)
  std::vector<double> magnitude;  // [units], root of the mean square
  // The bin above 0 Hz with the largest magnitude; 0 where all are 0.
  std::size_t strongestBin() const noexcept;
  double strongestHz() const noexcept { return binHz * static_cast<double>(strongestBin()); }
};
// Collects segments of the stretch with the most of them; others have bins elsewhere. Use as a
// sink.
class MeanSpectrumCollector {
 public:
  // Of the report's stretch with the most segments.
  explicit MeanSpectrumCollector(const SpectrumReport& plan);
  void add(const SpectrumSegment& segment);
  MeanSpectrum result() const;

 private:
  std::size_t stretch_ = 0;
  MeanSpectrum sum_;
};

// What linear interpolation onto the grid leaves of a tone on average when stamps are spread evenly
// between the grid's points, 0..1: sinc^2(f / rate). 0.97 at a fifth of Nyquist, 0.81 at a half,
// 0.41 at Nyquist.
double interpolationGain(double frequencyHz, double rateHz);

}  // namespace palpate
