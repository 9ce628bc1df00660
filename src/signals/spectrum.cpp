#include "palpate/signals/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"

#include "signals/segment_transform.h"

namespace palpate {
namespace {

constexpr std::size_t kSegmentsPerReport = 64;
}  // namespace

void SpectrumOptions::validate() const {
  OptionCheck{"spectrum"}(kWindow, "window", window);
  if (overlap < 0 || overlap >= window)
    throw std::invalid_argument("spectrum: overlap must be 0.." + std::to_string(window - 1) +
                                " (below the window), is " + std::to_string(overlap));
}

SpectrumReport planSpectra(std::span<const double> timeS,
                           std::span<const double> values,
                           const SpectrumOptions& options) {
  return detail::segmentPlan(timeS, values, options).report;
}

SpectrumReport visitSpectra(std::span<const double> timeS,
                            std::span<const double> values,
                            const SpectrumOptions& options,
                            const SpectrumSink& sink,
                            const Progress& progress) {
  const detail::SegmentPlan plan = detail::segmentPlan(timeS, values, options);
  const SpectrumReport& report = plan.report;
  if (report.segments == 0) return report;
  const auto window = static_cast<std::size_t>(options.window);
  const auto allSegments = static_cast<double>(report.segments);
  detail::SegmentTransformer transformer(options);
  std::size_t done = 0;
  for (std::size_t s = 0; s < report.stretches.size(); ++s) {
    const GapFreeSpan& stretch = report.stretches[s];
    if (stretch.segments == 0) continue;
    const std::vector<double> grid = detail::onGrid(plan, s);
    for (std::size_t i = 0; i < stretch.segments; ++i, ++done) {
      const bool asks = window > 1024 || done % kSegmentsPerReport == 0;
      if (progress && asks && !progress(static_cast<double>(done) / allSegments)) throw Cancelled();
      const std::size_t begin = i * report.hop;
      transformer.spectra(std::span(grid).subspan(begin, window), stretch.rateHz);
      const double middle = static_cast<double>(begin) + 0.5 * static_cast<double>(window);
      sink({.segment = done,
            .stretch = s,
            .timeS = stretch.beginS + middle / stretch.rateHz,
            .binHz = stretch.rateHz / static_cast<double>(window),
            .psd = transformer.psd,
            .magnitude = transformer.magnitude});
    }
  }
  return report;
}

std::size_t MeanSpectrum::strongestBin() const noexcept {
  std::size_t strongest = 0;
  double largest = 0.0;
  for (std::size_t k = 1; k < magnitude.size(); ++k)
    if (magnitude[k] > largest) {
      largest = magnitude[k];
      strongest = k;
    }
  return strongest;
}

MeanSpectrumCollector::MeanSpectrumCollector(const SpectrumReport& plan) {
  const auto most = std::max_element(
      plan.stretches.begin(), plan.stretches.end(), [](const auto& a, const auto& b) {
        return a.segments < b.segments;
      });
  stretch_ = static_cast<std::size_t>(most - plan.stretches.begin());
}

void MeanSpectrumCollector::add(const SpectrumSegment& segment) {
  if (segment.stretch != stretch_) return;
  if (sum_.segments == 0) {
    sum_.binHz = segment.binHz;
    sum_.psd.assign(segment.psd.size(), 0.0);
    sum_.magnitude.assign(segment.psd.size(), 0.0);
  }
  ++sum_.segments;
  for (std::size_t k = 0; k < segment.psd.size(); ++k) {
    sum_.psd[k] += segment.psd[k];
    sum_.magnitude[k] += segment.magnitude[k] * segment.magnitude[k];
  }
}

MeanSpectrum MeanSpectrumCollector::result() const {
  MeanSpectrum mean = sum_;
  const auto n = static_cast<double>(mean.segments);
  for (double& value : mean.psd) value /= n;
  for (double& value : mean.magnitude) value = std::sqrt(value / n);
  return mean;
}

double interpolationGain(double frequencyHz, double rateHz) {
  if (!(rateHz > 0.0) || frequencyHz == 0.0) return 1.0;
  const double angle = std::numbers::pi * frequencyHz / rateHz;
  return std::sin(angle) * std::sin(angle) / (angle * angle);
}

}  // namespace palpate
