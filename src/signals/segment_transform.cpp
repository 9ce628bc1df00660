#include "signals/segment_transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/core/statistics.h"
#include "palpate/model/gap_detector.h"

namespace palpate::detail {
namespace {

// Share of an interval that rounding may take from the grid's last sample.
constexpr double kRounding = 1e-6;

FiniteSamples finiteSamples(std::span<const double> timeS, std::span<const double> values) {
  if (timeS.size() != values.size())
    throw std::invalid_argument("spectrum: " + std::to_string(timeS.size()) + " times for " +
                                std::to_string(values.size()) + " values");
  FiniteSamples samples;
  for (std::size_t i = 0; i < timeS.size(); ++i) {
    if (!std::isfinite(timeS[i]) || (i > 0 && !(timeS[i] > timeS[i - 1])))
      throw std::invalid_argument("spectrum: times must ascend; sample " + std::to_string(i) +
                                  " doesn't");
    if (!std::isfinite(values[i])) continue;
    samples.timeS.push_back(timeS[i]);
    samples.values.push_back(values[i]);
    samples.index.push_back(i);
  }
  return samples;
}

void addStretch(SegmentPlan& plan, std::size_t begin, std::size_t end, GridRate gridRate) {
  const std::vector<double>& timeS = plan.samples.timeS;
  GapFreeSpan stretch{.first = plan.samples.index[begin],
                      .samples = end - begin,
                      .beginS = timeS[begin],
                      .endS = timeS[end - 1],
                      .gridSamples = 1};
  const double durationS = stretch.endS - stretch.beginS;
  if (end - begin > 1) {
    if (gridRate == GridRate::kMean) {
      stretch.gridSamples = end - begin;
      stretch.rateHz = static_cast<double>(end - begin - 1) / durationS;
    } else {
      std::vector<double> intervals;
      for (std::size_t i = begin + 1; i < end; ++i) intervals.push_back(timeS[i] - timeS[i - 1]);
      stretch.rateHz = 1.0 / median(std::move(intervals));
      stretch.gridSamples =
          static_cast<std::size_t>(std::floor(durationS * stretch.rateHz + kRounding)) + 1;
    }
  }
  plan.begins.push_back(begin);
  plan.report.stretches.push_back(stretch);
}

std::size_t segmentsOf(const GapFreeSpan& stretch, std::size_t window, std::size_t hop) {
  return stretch.gridSamples < window ? 0 : (stretch.gridSamples - window) / hop + 1;
}

// Determines the segments of every stretch; the hop grows until there are few enough.
void planSegments(SpectrumReport& report, const SpectrumOptions& options) {
  const auto window = static_cast<std::size_t>(options.window);
  const auto total = [&](std::size_t hop) {
    std::size_t sum = 0;
    for (const GapFreeSpan& stretch : report.stretches) sum += segmentsOf(stretch, window, hop);
    return sum;
  };
  std::size_t hop = window - static_cast<std::size_t>(options.overlap);
  if (options.maxSegments > 0 && total(hop) > options.maxSegments) {
    // Every stretch keeps its first segment, however large the hop is. With more stretches than
    // allowed segments, the limit is therefore exceeded.
    std::size_t below = hop, enough = hop;
    while (total(enough) > options.maxSegments && enough < report.samples) enough *= 2;
    while (enough - below > 1) {
      const std::size_t middle = below + (enough - below) / 2;
      (total(middle) > options.maxSegments ? below : enough) = middle;
    }
    hop = enough;
  }
  report.hop = hop;
  for (GapFreeSpan& stretch : report.stretches) {
    stretch.segments = segmentsOf(stretch, window, hop);
    report.segments += stretch.segments;
    if (stretch.segments == 0) report.inNoSegment += stretch.samples;
  }
}

// Subtracts the trend from `segment`. A constant segment becomes exactly zero.
void detrended(std::vector<double>& segment, Detrend detrend) {
  if (detrend == Detrend::kNone) return;
  const double first = segment.front();
  const auto n = static_cast<double>(segment.size());
  const double middle = (n - 1.0) / 2.0;
  double sum = 0.0, slope = 0.0;
  for (std::size_t i = 0; i < segment.size(); ++i) {
    segment[i] -= first;
    sum += segment[i];
    slope += (static_cast<double>(i) - middle) * segment[i];
  }
  const double mean = sum / n;
  slope = detrend == Detrend::kLine ? slope * 12.0 / (n * (n * n - 1.0)) : 0.0;
  for (std::size_t i = 0; i < segment.size(); ++i)
    segment[i] -= mean + slope * (static_cast<double>(i) - middle);
}

}  // namespace

SegmentPlan segmentPlan(std::span<const double> timeS,
                        std::span<const double> values,
                        const SpectrumOptions& options) {
  options.validate();
  SegmentPlan plan{.samples = finiteSamples(timeS, values), .begins = {}, .report = {}};
  SpectrumReport& report = plan.report;
  const std::vector<double>& times = plan.samples.timeS;
  report.samples = values.size();
  report.notFinite = values.size() - times.size();
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  const double gapS = gapThresholdS(intervals.empty() ? 0.0 : median(std::vector(intervals)));

  std::size_t begin = 0, within = 0;
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 1; i <= times.size(); ++i) {
    if (i < times.size() && intervals[i - 1] <= gapS) {
      sum += intervals[i - 1];
      ++within;
      continue;
    }
    addStretch(plan, begin, i, options.gridRate);
    begin = i;
  }
  if (within > 1) {
    const double mean = sum / static_cast<double>(within);
    for (const double interval : intervals)
      if (interval <= gapS) squares += (interval - mean) * (interval - mean);
    report.jitter = std::sqrt(squares / static_cast<double>(within)) / mean;
  }
  planSegments(report, options);
  std::size_t longest = 1;
  for (const GapFreeSpan& stretch : report.stretches)
    if (stretch.samples > longest) {
      longest = stretch.samples;
      report.rateHz = stretch.rateHz;
    }
  report.nyquistHz = report.rateHz / 2.0;
  return plan;
}

std::vector<double> onGrid(const SegmentPlan& plan, std::size_t which) {
  const GapFreeSpan& stretch = plan.report.stretches[which];
  const double* timeS = plan.samples.timeS.data() + plan.begins[which];
  const double* values = plan.samples.values.data() + plan.begins[which];
  std::vector<double> grid(stretch.gridSamples);
  std::size_t left = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double t = stretch.beginS + static_cast<double>(i) / stretch.rateHz;
    while (left + 2 < stretch.samples && timeS[left + 1] <= t) ++left;
    const double part = (t - timeS[left]) / (timeS[left + 1] - timeS[left]);
    grid[i] = values[left] + std::clamp(part, 0.0, 1.0) * (values[left + 1] - values[left]);
  }
  return grid;
}

SegmentTransformer::SegmentTransformer(const SpectrumOptions& options)
    : detrend_(options.detrend), fourier_(static_cast<std::size_t>(options.window)) {
  const auto n = static_cast<std::size_t>(options.window);
  window_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    window_[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                      static_cast<double>(n));
  for (const double w : window_) {
    sum_ += w;
    squares_ += w * w;
  }
  psd.resize(options.numBins());
  magnitude.resize(options.numBins());
}

std::span<const std::complex<double>> SegmentTransformer::transform(
    std::span<const double> samples) {
  segment_.assign(samples.begin(), samples.end());
  detrended(segment_, detrend_);
  for (std::size_t i = 0; i < segment_.size(); ++i) segment_[i] *= window_[i];
  return fourier_.transform(segment_);
}

double SegmentTransformer::density(std::size_t bin, double rateHz) const {
  const bool alone = bin == 0 || 2 * bin == window_.size();  // this bin has no mirror image
  return (alone ? 1.0 : 2.0) / (rateHz * squares_);
}

void SegmentTransformer::spectra(std::span<const double> samples, double rateHz) {
  const auto spectrum = transform(samples);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const bool alone = k == 0 || 2 * k == segment_.size();
    const double power = std::norm(spectrum[k]);
    psd[k] = power * density(k, rateHz);
    magnitude[k] = (alone ? 1.0 : 2.0) * std::sqrt(power) / sum_;
  }
}

}  // namespace palpate::detail
