#include "palpate/signals/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {

SpectrumOptions SpectrogramOptions::limitedToCells() const {
  if (maxSegments == 0 || maxCells == 0)
    throw std::invalid_argument("spectrogram: maxSegments and maxCells must be above 0");
  spectrum.validate();
  SpectrumOptions options = spectrum;
  const std::size_t most =
      std::max<std::size_t>(1, std::min(maxSegments, maxCells / spectrum.numBins()));
  options.maxSegments = spectrum.maxSegments == 0 ? most : std::min(most, spectrum.maxSegments);
  return options;
}

Spectrogram spectrogramOf(std::span<const double> timeS,
                          std::span<const double> values,
                          const SpectrogramOptions& options,
                          const Progress& progress) {
  const SpectrumOptions spectrum = options.limitedToCells();
  Spectrogram all;
  all.numBins = spectrum.numBins();
  const SpectrumReport plan = planSpectra(timeS, values, spectrum);
  MeanSpectrumCollector mean(plan);
  std::size_t stretch = plan.stretches.size();  // none yet
  const auto collect = [&](const SpectrumSegment& segment) {
    if (segment.stretch != stretch) {
      stretch = segment.stretch;
      const GapFreeSpan& whole = plan.stretches[stretch];
      SpectrogramPart part{.firstS = segment.timeS,
                           .stepS = static_cast<double>(plan.hop) / whole.rateHz,
                           .binHz = segment.binHz,
                           .psd = {},
                           .magnitude = {}};
      part.psd.reserve(whole.segments * all.numBins);
      part.magnitude.reserve(whole.segments * all.numBins);
      all.parts.push_back(std::move(part));
    }
    SpectrogramPart& part = all.parts.back();
    ++part.segments;
    for (std::size_t k = 0; k < all.numBins; ++k) {
      part.psd.push_back(static_cast<float>(segment.psd[k]));
      part.magnitude.push_back(static_cast<float>(segment.magnitude[k]));
      all.largestPsd = std::max(all.largestPsd, segment.psd[k]);
      all.largestMagnitude = std::max(all.largestMagnitude, segment.magnitude[k]);
    }
    mean.add(segment);
  };
  all.report = visitSpectra(timeS, values, spectrum, collect, progress);
  all.mean = mean.result();
  return all;
}

double decibels(double psd, double floorDb) {
  return psd > 0.0 ? std::max(10.0 * std::log10(psd), floorDb) : floorDb;
}

}  // namespace palpate
