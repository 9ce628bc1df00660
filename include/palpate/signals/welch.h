// The spectrum of a signal as one line: the mean over overlapping segments (Welch 1967), and its
// peaks. With even stamps the mean is scipy.signal.welch(values, rate, window="hann",
// nperseg=window, noverlap=overlap, detrend="constant"). The command `spectrum --welch` and the
// Spectrum dock use it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/signals/spectrum.h>

namespace palpate {

// Options of a mean spectrum: segments of 256 samples that overlap by half.
SpectrumOptions welchOptions(int window = 256);

// The mean spectrum with the division of the series.
struct WelchSpectrum {
  SpectrumReport report;
  MeanSpectrum mean;  // over the stretch with the most segments; without bins if there is none
};
// Throws as visitSpectra(): std::invalid_argument, Cancelled.
WelchSpectrum welchSpectrum(std::span<const double> timeS,
                            std::span<const double> values,
                            const SpectrumOptions& options = welchOptions(),
                            const Progress& progress = {});

// A peak of a mean spectrum.
struct SpectralPeak {
  std::size_t bin = 0;  // of the maximum
  // Top of the parabola through the logarithms at the bin and its neighbours.
  double frequencyHz = 0.0;
  double psd = 0.0;        // there [units^2/Hz]
  double amplitude = 0.0;  // of a tone with this peak [units]; at most 4 % too large
  // Full width at half of the density at the bin (3 dB), between linearly interpolated bins [Hz]. A
  // pure tone is 1.3 to 2 bins wide. At the ends of the spectrum only up to the end.
  double widthHz = 0.0;
  // Height above the higher of the two valleys that part it from a higher peak (or from the end)
  // [dB].
  double prominenceDb = 0.0;
};
struct SpectralPeakOptions {
  // Smallest prominence [dB], above 0.
  double prominenceDb = 3.0;
  // Largest number of peaks; the ones with the largest densities are kept.
  std::size_t maxPeaks = 8;
};
// The peaks in the order of their density, the largest first. The first and the last bin are no
// peaks. As scipy.signal.find_peaks(10 log10(psd), prominence=3) and peak_widths at half of psd.
// Densities below 1e-12 of the largest are rounding and count as that.
std::vector<SpectralPeak> spectralPeaks(const MeanSpectrum& mean,
                                        const SpectralPeakOptions& options = {});

}  // namespace palpate
