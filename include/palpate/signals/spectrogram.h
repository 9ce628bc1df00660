// The spectra of a series over time as one picture: keeps the segments that visitSpectra()
// (signals/spectrum.h) computes, but no more than a picture can show.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/signals/spectrum.h>

namespace palpate {

// Options of the spectra, and limits for the size of the picture.
struct SpectrogramOptions {
  SpectrumOptions spectrum = {};  // a maxSegments above 0 in it also applies
  // Largest number of segments, more than the columns of any screen; must be above 0.
  std::size_t maxSegments = 20'000;
  // Largest number of cells (segments times bins); must be above 0.
  std::size_t maxCells = 4'000'000;

  // Returns the options of the spectra with a number of segments that meets both limits; at least
  // one.
  SpectrumOptions limitedToCells() const;
};

// The segments of one gap-free span: evenly spaced in time and in frequency.
struct SpectrogramPart {
  double firstS = 0.0;  // middle of the first segment [s]
  double stepS = 0.0;   // from one segment to the next [s]
  double binHz = 0.0;
  std::size_t segments = 0;      // at least 1
  std::vector<float> psd;        // segment after segment, numBins() values each [units^2/Hz]
  std::vector<float> magnitude;  // in the same order [units]
};

// The spectra of a series.
struct Spectrogram {
  SpectrumReport report;
  std::size_t numBins = 0;
  // Stretches that have at least one segment.
  std::vector<SpectrogramPart> parts;
  MeanSpectrum mean;
  double largestPsd = 0.0;  // of all cells
  double largestMagnitude = 0.0;
};

// Computes a spectrogram. Throws as visitSpectra(): std::invalid_argument, Cancelled.
Spectrogram spectrogramOf(std::span<const double> timeS,
                          std::span<const double> values,
                          const SpectrogramOptions& options = {},
                          const Progress& progress = {});

// Returns 10 lg(psd / 1 units^2 per Hz) [dB], but at least `floorDb`, also for 0.
double decibels(double psd, double floorDb);

}  // namespace palpate
