#include "palpate/signals/coherence.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "palpate/core/error.h"

#include "signals/segment_transform.h"

namespace palpate {
namespace {

constexpr std::size_t kCoherenceSegmentsPerReport = 64;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kNotFinite = std::numeric_limits<double>::quiet_NaN();

// Welch 1967: overlapping segments scatter as n / (1 + 2 sum (1 - k/n) c_k^2) independent ones,
// with the correlation c_k of the squared windows of two segments k hops apart.
double independentSegments(std::size_t segments, std::size_t hop, std::size_t window) {
  const auto hann = [window](std::size_t i) {
    return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                static_cast<double>(window));
  };
  double squares = 0.0;
  for (std::size_t i = 0; i < window; ++i) squares += hann(i) * hann(i);
  const auto n = static_cast<double>(segments);
  double sum = 0.0;
  for (std::size_t k = 1; k < segments && k * hop < window; ++k) {
    double product = 0.0;
    for (std::size_t i = k * hop; i < window; ++i) product += hann(i) * hann(i - k * hop);
    const double correlation = product / squares;
    sum += (1.0 - static_cast<double>(k) / n) * correlation * correlation;
  }
  return n / (1.0 + 2.0 * sum);
}

}  // namespace

double Coherence::level95() const noexcept {
  return independentSegments > 1.0 ? 1.0 - std::pow(0.05, 1.0 / (independentSegments - 1.0)) : 1.0;
}

std::vector<CoherencePeak> coherencePeaks(const Coherence& coherence, std::size_t maxPeaks) {
  const std::vector<double>& values = coherence.coherence;
  const double level = coherence.level95();
  std::vector<CoherencePeak> peaks;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (!(values[k] > level)) continue;
    // A comparison with NaN is false: a neighbour without power is lower.
    if (values[k - 1] > values[k] && k > 1) continue;
    if (k + 1 < values.size() && values[k + 1] >= values[k]) continue;
    peaks.push_back(
        {k, static_cast<double>(k) * coherence.binHz, values[k], coherence.phaseDeg[k]});
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const CoherencePeak& a, const CoherencePeak& b) {
    return a.coherence > b.coherence;
  });
  if (peaks.size() > maxPeaks) peaks.resize(maxPeaks);
  return peaks;
}

Coherence coherenceOf(std::span<const double> timeS,
                      std::span<const double> valuesA,
                      std::span<const double> valuesB,
                      const SpectrumOptions& options,
                      const Progress& progress) {
  if (valuesA.size() != valuesB.size())
    throw std::invalid_argument("coherence: " + std::to_string(valuesA.size()) + " values and " +
                                std::to_string(valuesB.size()));
  // Both signals need the same samples, so that they are on the same grid.
  std::vector<double> a(valuesA.begin(), valuesA.end()), b(valuesB.begin(), valuesB.end());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) a[i] = b[i] = kNotFinite;
  const detail::SegmentPlan planA = detail::segmentPlan(timeS, a, options);
  const detail::SegmentPlan planB = detail::segmentPlan(timeS, b, options);
  Coherence result;
  result.report = planA.report;
  const auto& stretches = result.report.stretches;
  const auto most = std::max_element(
      stretches.begin(), stretches.end(), [](const GapFreeSpan& one, const GapFreeSpan& other) {
        return one.segments < other.segments;
      });
  if (most == stretches.end() || most->segments < 2) return result;
  const auto stretch = static_cast<std::size_t>(most - stretches.begin());
  const std::vector<double> gridA = detail::onGrid(planA, stretch);
  const std::vector<double> gridB = detail::onGrid(planB, stretch);
  const auto window = static_cast<std::size_t>(options.window);
  const std::size_t numBins = options.numBins();
  result.binHz = most->rateHz / static_cast<double>(window);
  result.segments = most->segments;
  result.independentSegments = independentSegments(result.segments, result.report.hop, window);
  result.psdA.assign(numBins, 0.0);
  result.psdB.assign(numBins, 0.0);
  std::vector<std::complex<double>> cross(numBins);
  detail::SegmentTransformer ofA(options), ofB(options);
  for (std::size_t i = 0; i < result.segments; ++i) {
    if (progress && (window > 1024 || i % kCoherenceSegmentsPerReport == 0) &&
        !progress(static_cast<double>(i) / static_cast<double>(result.segments)))
      throw Cancelled();
    const std::size_t begin = i * result.report.hop;
    const auto x = ofA.transform(std::span(gridA).subspan(begin, window));
    const auto y = ofB.transform(std::span(gridB).subspan(begin, window));
    for (std::size_t k = 0; k < numBins; ++k) {
      result.psdA[k] += std::norm(x[k]);
      result.psdB[k] += std::norm(y[k]);
      cross[k] += std::conj(x[k]) * y[k];
    }
  }
  for (std::size_t k = 0; k < numBins; ++k) {
    const double power = result.psdA[k] * result.psdB[k];
    const bool both = power > 0.0;
    result.coherence.push_back(both ? std::min(1.0, std::norm(cross[k]) / power) : kNotFinite);
    result.phaseDeg.push_back(both ? std::arg(cross[k]) * kDegPerRad : kNotFinite);
    const double density = ofA.density(k, most->rateHz) / static_cast<double>(result.segments);
    result.psdA[k] *= density;
    result.psdB[k] *= density;
  }
  return result;
}

}  // namespace palpate
