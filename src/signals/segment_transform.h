// Division of a series into segments on regular grids, and the transform of a segment; for the
// spectra, their mean and the coherence (signals/spectrum.h has the formulas).
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "palpate/signals/spectrum.h"

#include "signals/real_fourier.h"

namespace palpate::detail {

// The finite samples of a series.
struct FiniteSamples {
  std::vector<double> timeS, values;
  std::vector<std::size_t> index;  // in the series
};

struct SegmentPlan {
  FiniteSamples samples;
  std::vector<std::size_t> begins;  // start of each stretch, index in samples
  SpectrumReport report;
};

// Throws std::invalid_argument as planSpectra().
SegmentPlan segmentPlan(std::span<const double> timeS,
                        std::span<const double> values,
                        const SpectrumOptions& options);
// Interpolates the samples of a stretch linearly on its grid.
std::vector<double> onGrid(const SegmentPlan& plan, std::size_t stretch);

// Transforms segments of one length.
class SegmentTransformer {
 public:
  explicit SegmentTransformer(const SpectrumOptions& options);

  // The Fourier transform of a segment without its trend, times the window; valid until the next
  // call.
  std::span<const std::complex<double>> transform(std::span<const double> samples);
  // Also computes `psd` and `magnitude`.
  void spectra(std::span<const double> samples, double rateHz);
  // Factor from |X_k|^2 to the power spectral density.
  double density(std::size_t bin, double rateHz) const;

  std::vector<double> psd, magnitude;

 private:
  Detrend detrend_;
  RealFourier fourier_;
  std::vector<double> window_, segment_;
  double sum_ = 0.0, squares_ = 0.0;
};

}  // namespace palpate::detail
