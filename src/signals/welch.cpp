#include "palpate/signals/welch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

constexpr double kNoDensity = 1e-12;  // part of the largest density

// Offset of the top of the parabola from the bin [bins], -0.5..0.5, and the factor of its value.
struct PeakTop {
  double offset = 0.0;
  double factor = 1.0;
};
PeakTop topOf(double before, double at, double after) {
  if (!(before > 0.0 && at > 0.0 && after > 0.0)) return {};
  const double a = std::log(before), b = std::log(at), c = std::log(after);
  const double curvature = a - 2.0 * b + c;
  if (!(curvature < 0.0)) return {};
  const double offset = std::clamp(0.5 * (a - c) / curvature, -0.5, 0.5);
  return {offset, std::exp(-0.25 * (a - c) * offset)};
}

// The place where the density falls to `level`, from the bin on in the direction of `step` [bins].
double crossing(const std::vector<double>& psd, std::size_t bin, int step, double level) {
  auto i = static_cast<std::ptrdiff_t>(bin);
  const std::ptrdiff_t end = step > 0 ? static_cast<std::ptrdiff_t>(psd.size()) - 1 : 0;
  while (i != end && psd[static_cast<std::size_t>(i)] > level) i += step;
  const double here = psd[static_cast<std::size_t>(i)];
  if (here > level) return static_cast<double>(i);
  const double inside = psd[static_cast<std::size_t>(i - step)];
  return static_cast<double>(i) - step * (level - here) / (inside - here);
}

// Lowest level before a higher one, in the direction of `step` [dB].
double valley(const std::vector<double>& db, std::size_t bin, int step) {
  double lowest = db[bin];
  for (auto i = static_cast<std::ptrdiff_t>(bin);
       i >= 0 && i < static_cast<std::ptrdiff_t>(db.size()) &&
       db[static_cast<std::size_t>(i)] <= db[bin];
       i += step)
    lowest = std::min(lowest, db[static_cast<std::size_t>(i)]);
  return lowest;
}

}  // namespace

SpectrumOptions welchOptions(int window) {
  SpectrumOptions options;
  options.window = window;
  options.overlap = window / 2;
  return options;
}

WelchSpectrum welchSpectrum(std::span<const double> timeS,
                            std::span<const double> values,
                            const SpectrumOptions& options,
                            const Progress& progress) {
  const SpectrumReport plan = planSpectra(timeS, values, options);
  if (plan.segments == 0) return {plan, {}};
  MeanSpectrumCollector collector(plan);
  visitSpectra(
      timeS,
      values,
      options,
      [&](const SpectrumSegment& segment) { collector.add(segment); },
      progress);
  return {plan, collector.result()};
}

std::vector<SpectralPeak> spectralPeaks(const MeanSpectrum& mean,
                                        const SpectralPeakOptions& options) {
  if (!(options.prominenceDb > 0.0))
    throw std::invalid_argument("peaks: the prominence must be above 0 dB");
  const std::vector<double>& psd = mean.psd;
  if (psd.size() < 3) return {};
  const double largest = *std::max_element(psd.begin(), psd.end());
  if (!(largest > 0.0)) return {};
  std::vector<double> db;
  for (const double value : psd)
    db.push_back(10.0 * std::log10(std::max(value, kNoDensity * largest)));
  std::vector<SpectralPeak> peaks;
  for (std::size_t k = 1; k + 1 < db.size(); ++k) {
    if (!(db[k] > db[k - 1])) continue;
    std::size_t last = k;  // of bins with the same density
    while (last + 1 < db.size() && db[last + 1] == db[k]) ++last;
    if (last + 1 == db.size() || db[last + 1] > db[k]) continue;
    const std::size_t bin = (k + last) / 2;
    const double prominenceDb = db[bin] - std::max(valley(db, bin, -1), valley(db, bin, 1));
    if (prominenceDb < options.prominenceDb) continue;
    const PeakTop top = topOf(psd[bin - 1], psd[bin], psd[bin + 1]);
    const double half = psd[bin] / 2.0;
    peaks.push_back(
        {.bin = bin,
         .frequencyHz = (static_cast<double>(bin) + top.offset) * mean.binHz,
         .psd = psd[bin] * top.factor,
         .amplitude = mean.magnitude[bin] * std::sqrt(top.factor),
         .widthHz = (crossing(psd, bin, 1, half) - crossing(psd, bin, -1, half)) * mean.binHz,
         .prominenceDb = prominenceDb});
    k = last;
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const SpectralPeak& a, const SpectralPeak& b) {
    return a.psd > b.psd;
  });
  if (peaks.size() > options.maxPeaks) peaks.resize(options.maxPeaks);
  return peaks;
}

}  // namespace palpate
