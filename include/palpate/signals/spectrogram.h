// The spectra of a series over time as one picture: what filter/spectrum.h visits, kept, in as many
// segments as a picture takes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/signals/spectrum.h>

namespace palpate {

struct SpectrogramOptions {
  SpectrumOptions spectrum = {};     // its maxSegments counts, too, where it is above 0
  std::size_t maxSegments = 20'000;  // wider than any screen; above 0
  std::size_t maxCells = 4'000'000;  // segments times bins; above 0

  // The spectra's options with the number of segments that fits; at least one.
  SpectrumOptions limitedToCells() const;
};

// The segments of one stretch without a gap: evenly spaced in time and in frequency.
struct SpectrogramPart {
  double firstS = 0.0;  // middle of its first segment [s]
  double stepS = 0.0;   // from one segment to the next [s]
  double binHz = 0.0;
  std::size_t segments = 0;      // at least 1
  std::vector<float> psd;        // segment after segment, numBins() values each [units^2/Hz]
  std::vector<float> magnitude;  // likewise [units]
};

struct Spectrogram {
  SpectrumReport report;
  std::size_t numBins = 0;
  std::vector<SpectrogramPart> parts;  // stretches that have a segment
  MeanSpectrum mean;
  double largestPsd = 0.0;  // of all cells
  double largestMagnitude = 0.0;
};

// As visitSpectra: throws std::invalid_argument, Cancelled.
Spectrogram spectrogramOf(std::span<const double> timeS,
                          std::span<const double> values,
                          const SpectrogramOptions& options = {},
                          const Progress& progress = {});

// 10 lg(psd / 1 units^2 per Hz) [dB]; `floorDb` for less than that, 0 included.
double decibels(double psd, double floorDb);

}  // namespace palpate
