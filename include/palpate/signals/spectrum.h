// Spectra of one signal over time: the short-time Fourier transform of a series with irregular time
// stamps (study 5.1; Welch 1967 for the scaling; the window as in Harris 1978). The command
// `spectrum` and the Spectrum dock use it.
//
// Time stamps are irregular (25 % jitter at 74 Hz), but a Fourier transform needs a regular grid.
// Each gap-free span is therefore interpolated linearly onto a regular grid at its own rate.
// Frequencies above half of that rate (Nyquist) cannot be measured, and components above it are
// aliased. Interpolation attenuates high frequencies if the stamps are irregular:
// interpolationGain(). Regular stamps lose nothing.
//
// A segment has N samples x_n, and one begins every `hop` = N - overlap samples. Its trend is
// subtracted (Detrend), then it is multiplied by the periodic Hann window w_n = (1 - cos(2 pi n /
// N)) / 2 (periodic: zero at n = 0, not at n = N - 1; a tone at a bin does not leak into bins two
// or more away). With X_k = sum x_n w_n e^(-2 pi i k n / N), k = 0..N/2:
//   psd_k       = c |X_k|^2 / (rate sum w_n^2)   [units^2/Hz], one-sided
//   magnitude_k = c' |X_k| / sum w_n             [units]: a tone of amplitude A at a bin reads A
// Here c = c' = 2, but 1 at k = 0 and (N even) at k = N/2. Parseval: sum psd_k rate/N = sum (x_n
// w_n)^2 / sum w_n^2. A tone half way between two bins reads as little as 0.849 A (scalloping).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>

namespace palpate {

// What is subtracted from a segment before the window is applied.
enum class Detrend {
  // Nothing: a resting load appears at 0 Hz and leaks into the next bin.
  kNone,
  kMean,  // the mean of the segment
  // The line fitted by least squares: loads that rise or fall then do not fill the lowest bins.
  kLine
};
inline constexpr std::array<OptionWord<Detrend>, 3> kDetrendWords{
    {{"mean", Detrend::kMean}, {"line", Detrend::kLine}, {"none", Detrend::kNone}}};

// How the rate of the regular grid of a stretch is chosen.
enum class GridRate {
  kMean,  // (samples - 1) / duration: the grid has as many points as the stretch has samples
  // 1 / median interval: the rate that the stretch would have without delays.
  kMedian
};
inline constexpr std::array<OptionWord<GridRate>, 2> kGridRateWords{
    {{"mean", GridRate::kMean}, {"median", GridRate::kMedian}}};

// How a series is divided into segments.
struct SpectrumOptions {
  static constexpr OptionRange kWindow{2, 65'536, "samples"};
  int window = 32;  // N [samples], not only powers of two
  // Samples that a segment shares with the next, 0..window-1.
  int overlap = 31;
  Detrend detrend = Detrend::kMean;
  GridRate gridRate = GridRate::kMean;
  // Largest number of segments: the hop grows until they fit (with a hop above `window`, some
  // samples are in no segment). 0 means no limit.
  std::size_t maxSegments = 0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
  std::size_t numBins() const noexcept { return static_cast<std::size_t>(window) / 2 + 1; }
};

// Samples without a gap between them.
struct GapFreeSpan {
  std::size_t first = 0;    // index of its first finite sample in the series
  std::size_t samples = 0;  // finite samples
  double beginS = 0.0;      // time of its first and last sample [s]
  double endS = 0.0;
  double rateHz = 0.0;          // rate of its grid; 0 with one sample
  std::size_t gridSamples = 0;  // on the grid
  std::size_t segments = 0;     // 0 when the span is shorter than a window
};

// The division of a series into stretches and segments.
struct SpectrumReport {
  std::size_t samples = 0;  // given
  // Samples that are NaN or infinite. They are left out, and interpolated unless that makes a gap.
  std::size_t notFinite = 0;
  // Finite samples in stretches shorter than a window.
  std::size_t inNoSegment = 0;
  std::vector<GapFreeSpan> stretches;
  std::size_t segments = 0;
  // Distance of segments [samples of the grid]; above window - overlap when maxSegments requires
  // it.
  std::size_t hop = 1;
  double rateHz = 0.0;  // of the longest stretch; 0 with fewer than two samples
  // Half of that rate, the highest frequency of the spectra.
  double nyquistHz = 0.0;
  // Standard deviation of the intervals within stretches / their mean; 0 with fewer than two.
  double jitter = 0.0;
};

// One segment; its spans are valid only during the call of the sink.
struct SpectrumSegment {
  std::size_t segment = 0;            // counted through all stretches, from 0
  std::size_t stretch = 0;            // index in SpectrumReport::stretches
  double timeS = 0.0;                 // time of the middle, sample N/2, where the window is 1 [s]
  double binHz = 0.0;                 // bin k is at k * binHz
  std::span<const double> psd;        // numBins() values [units^2/Hz]
  std::span<const double> magnitude;  // numBins() values [units]
};
using SpectrumSink = std::function<void(const SpectrumSegment&)>;

// Determines rates, stretches and the number of segments without a transform. A gap is an interval
// longer than max(1 s, 5 median intervals); no segment spans one. Throws std::invalid_argument for
// bad options, and unless times [s] ascend strictly and are finite, one per value.
SpectrumReport planSpectra(std::span<const double> timeS,
                           std::span<const double> values,
                           const SpectrumOptions& options = {});
// The segments one after the other.
class SpectrumRun {
 public:
  // Copies the samples. Throws as planSpectra().
  SpectrumRun(std::span<const double> timeS,
              std::span<const double> values,
              const SpectrumOptions& options = {});
  ~SpectrumRun();
  SpectrumRun(const SpectrumRun&) = delete;
  SpectrumRun& operator=(const SpectrumRun&) = delete;
  const SpectrumReport& report() const;
  // Transforms the next one; its spans are valid until the next call. False after the last one.
  // Throws Cancelled.
  bool next(SpectrumSegment& segment, const Progress& progress = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
// Does the same and passes every segment to `sink`, in order. A series shorter than a window has no
// segment. A constant series is zero in every bin (with Detrend::kNone, it has values at 0 Hz and
// in the next bin). Also throws Cancelled.
SpectrumReport visitSpectra(std::span<const double> timeS,
                            std::span<const double> values,
                            const SpectrumOptions& options,
                            const SpectrumSink& sink,
                            const Progress& progress = {});

// The mean over all segments with the same rate, and its strongest line.
struct MeanSpectrum {
  double binHz = 0.0;
  std::size_t segments = 0;
  std::vector<double> psd;        // mean (Welch's estimate) [units^2/Hz]
  std::vector<double> magnitude;  // root of the mean square [units]
  // The bin above 0 Hz with the largest magnitude; 0 when all magnitudes are 0.
  std::size_t strongestBin() const noexcept;
  double strongestHz() const noexcept { return binHz * static_cast<double>(strongestBin()); }
};
// Computes the mean over the stretch with the most segments; other stretches have bins at other
// frequencies. Call add() from the sink.
class MeanSpectrumCollector {
 public:
  // Selects the stretch with the most segments in the report.
  explicit MeanSpectrumCollector(const SpectrumReport& plan);
  void add(const SpectrumSegment& segment);
  MeanSpectrum result() const;

 private:
  std::size_t stretch_ = 0;
  MeanSpectrum sum_;
};

// Returns the part of a tone's amplitude, 0..1, that remains on average after linear interpolation
// when the stamps are spread evenly between the grid's points: sinc^2(f / rate). It is 0.97 at a
// fifth of the Nyquist frequency, 0.81 at a half and 0.41 at the Nyquist frequency.
double interpolationGain(double frequencyHz, double rateHz);

}  // namespace palpate
