// Coherence of two signals: how much of the power at a frequency they have in common (Carter 1987).
// From the mean spectra over segments (signals/welch.h), P_xx, P_yy and P_xy = mean conj(X) Y:
//   coherence_k = |P_xy|^2 / (P_xx P_yy), 0..1,  phase_k = arg P_xy
// As scipy.signal.coherence and csd with even stamps (window "hann", nperseg=window,
// noverlap=overlap). The command `spectrum --coherence` and the Spectrum dock use it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/signals/welch.h>

namespace palpate {

struct Coherence {
  SpectrumReport report;  // of the samples at which both signals are finite
  double binHz = 0.0;
  std::size_t segments = 0;
  // Number of independent segments with the same scatter; smaller than `segments` when they
  // overlap.
  double independentSegments = 0.0;
  // Per bin. NaN where one of the signals has no power.
  std::vector<double> coherence;  // 0..1
  // Of the second signal relative to the first [deg], -180..180; negative when the second is later.
  std::vector<double> phaseDeg;
  std::vector<double> psdA, psdB;  // [units^2/Hz]
  // Level that the coherence of independent noise exceeds in 5 % of the bins, 0..1:
  // 1 - 0.05^(1/(n - 1)) with n independent segments.
  double level95() const noexcept;
};

// A frequency at which two signals have something in common.
struct CoherencePeak {
  std::size_t bin = 0;
  double frequencyHz = 0.0;
  double coherence = 0.0;  // 0..1
  double phaseDeg = 0.0;
};
// The local maxima above level95(), without the first bin; the largest first, at most `maxPeaks`.
std::vector<CoherencePeak> coherencePeaks(const Coherence& coherence, std::size_t maxPeaks = 8);

// The coherence over the stretch with the most segments. Without bins when there are fewer than two
// segments: the coherence of a single segment is 1 at every frequency. Times [s] ascend strictly,
// one per value of either signal; use resampled() (signals/resampled_series.h) for a signal with
// other stamps. Throws std::invalid_argument as planSpectra(), and Cancelled.
Coherence coherenceOf(std::span<const double> timeS,
                      std::span<const double> valuesA,
                      std::span<const double> valuesB,
                      const SpectrumOptions& options = welchOptions(),
                      const Progress& progress = {});

}  // namespace palpate
