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

struct SpectrumRun::Impl {
  SpectrumOptions options;
  detail::SegmentPlan plan;
  detail::SegmentTransformer transformer;
  std::vector<double> grid = {};  // of the stretch
  std::size_t stretch = 0, ofStretch = 0, done = 0;
};

SpectrumRun::SpectrumRun(std::span<const double> timeS,
                         std::span<const double> values,
                         const SpectrumOptions& options)
    : impl_(new Impl{options,
                     detail::segmentPlan(timeS, values, options),
                     detail::SegmentTransformer(options)}) {}
SpectrumRun::~SpectrumRun() = default;

const SpectrumReport& SpectrumRun::report() const { return impl_->plan.report; }

bool SpectrumRun::next(SpectrumSegment& segment, const Progress& progress) {
  Impl& run = *impl_;
  const SpectrumReport& report = run.plan.report;
  if (run.done == report.segments) return false;
  while (run.ofStretch == report.stretches[run.stretch].segments) {
    ++run.stretch;
    run.ofStretch = 0;
  }
  if (run.ofStretch == 0) run.grid = detail::onGrid(run.plan, run.stretch);
  const GapFreeSpan& stretch = report.stretches[run.stretch];
  const auto window = static_cast<std::size_t>(run.options.window);
  const bool asks = window > 1024 || run.done % kSegmentsPerReport == 0;
  if (progress && asks &&
      !progress(static_cast<double>(run.done) / static_cast<double>(report.segments)))
    throw Cancelled();
  const std::size_t begin = run.ofStretch++ * report.hop;
  run.transformer.spectra(std::span(run.grid).subspan(begin, window), stretch.rateHz);
  const double middle = static_cast<double>(begin) + 0.5 * static_cast<double>(window);
  segment = {.segment = run.done++,
             .stretch = run.stretch,
             .timeS = stretch.beginS + middle / stretch.rateHz,
             .binHz = stretch.rateHz / static_cast<double>(window),
             .psd = run.transformer.psd,
             .magnitude = run.transformer.magnitude};
  return true;
}

SpectrumReport visitSpectra(std::span<const double> timeS,
                            std::span<const double> values,
                            const SpectrumOptions& options,
                            const SpectrumSink& sink,
                            const Progress& progress) {
  SpectrumRun run(timeS, values, options);
  for (SpectrumSegment segment; run.next(segment, progress);) sink(segment);
  return run.report();
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
