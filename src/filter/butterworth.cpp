#include "palpate/filter/butterworth.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "palpate/core/number_text.h"

#include "filter/sample_stretches.h"

namespace palpate {
namespace {

using ButterworthPole = std::complex<double>;

constexpr int kHighestOrder = 8;
// Largest edge as a part of the rate; at half of it the bilinear transform has no value.
constexpr double kHighestEdge = 0.499;
constexpr std::size_t kIntervalsForRate = 64;
constexpr double kLeft = 1e-9;  // part of an input that counts as nothing
// States below this are set to 0: such numbers would slow the arithmetic down.
constexpr double kVanished = 1e-30;

std::string nameOf(ButterworthOptions::Band band) {
  switch (band) {
    case ButterworthOptions::Band::kLowPass:
      return "low-pass";
    case ButterworthOptions::Band::kHighPass:
      return "high-pass";
    case ButterworthOptions::Band::kBandPass:
      return "band-pass";
    case ButterworthOptions::Band::kBandStop:
      break;
  }
  return "band-stop";
}

// The edge as w T / 2 of the analog filter (prewarped).
double warped(double hz, double rateHz) {
  return std::tan(std::numbers::pi * std::min(hz / rateHz, kHighestEdge));
}

// A section of second order with the denominator s^2 + a1 s + a0.
ButterworthSection sectionOf(double a1, double a0) {
  ButterworthSection section;
  section.step = std::sqrt(a0);
  section.damping = a1 / section.step;
  return section;
}

// The sections of a low-pass or high-pass with the edge `w`.
std::vector<ButterworthSection> edgeSections(int order, double w, bool high) {
  std::vector<ButterworthSection> sections;
  for (int k = 0; k < order / 2; ++k) {
    const double angle = std::numbers::pi * (2 * k + 1) / (2.0 * order);
    sections.push_back({.step = w, .damping = 2.0 * std::sin(angle)});
  }
  if (order % 2 == 1) sections.push_back({.firstOrder = true, .step = w});
  for (ButterworthSection& section : sections) (high ? section.highGain : section.lowGain) = 1.0;
  return sections;
}

// The sections of a band-pass or band-stop. Every pole p of the low-pass at 1 gives the two roots
// of s^2 - c s + low high = 0, with c = p (high - low) for the pass and (high - low) / p for the
// stop; a pair of conjugate p gives two pairs.
std::vector<ButterworthSection> bandSections(int order, double low, double high, bool stop) {
  const double width = high - low, middle = low * high;
  std::vector<ButterworthSection> sections;
  for (int k = 0; k < (order + 1) / 2; ++k) {
    const double angle = std::numbers::pi * (2 * k + 1) / (2.0 * order);
    const bool real = 2 * k + 1 == order;
    if (real) {
      sections.push_back(sectionOf(width, middle));
      continue;
    }
    const ButterworthPole pole(-std::sin(angle), std::cos(angle));
    const ButterworthPole c = stop ? width / pole : width * pole;
    const ButterworthPole root = std::sqrt(c * c - 4.0 * middle);
    for (const ButterworthPole& s : {(c + root) / 2.0, (c - root) / 2.0})
      sections.push_back(sectionOf(-2.0 * s.real(), std::norm(s)));
  }
  for (ButterworthSection& section : sections) {
    if (stop) {
      // The gain of every section at 0 Hz is 1 (the product of the high gains is 1), so that a load
      // at rest stays at rest when the rate changes.
      section.highGain = section.step * section.step / middle;
      section.lowGain = 1.0;
    } else {
      section.bandGain = width / section.step;
    }
  }
  return sections;
}

// One step of a section: the gains for an interval, and the advance of a state.
struct SectionStep {
  explicit SectionStep(const ButterworthSection& of, double part)
      : section(of),
        g(of.step * part),
        scale(1.0 / (1.0 + g * (of.firstOrder ? 1.0 : of.damping + g))) {}

  // Advances the state by one step in which the input goes from `before` to `now`.
  void advance(double& position, double& speed, double before, double now) const {
    if (section.firstOrder) {
      position = ((1.0 - g) * position + g * (before + now)) * scale;
      return;
    }
    const double force = speed + g * (before + now - position - section.damping * speed);
    const double newSpeed = (force - g * (position + g * speed)) * scale;
    position += g * (speed + newSpeed);
    speed = newSpeed;
  }
  double output(double position, double speed, double input) const {
    return section.highGain * (input - section.damping * speed - position) +
           section.bandGain * speed + section.lowGain * position;
  }

  const ButterworthSection& section;
  const double g;
  const double scale;
};

// Filters a stretch in place, from the first sample to the last. `intervalsS[i]` is the interval
// before sample i.
void filterStretch(std::span<double> values,
                   std::span<const double> intervalsS,
                   const std::vector<ButterworthSection>& sections,
                   double rateHz) {
  for (const ButterworthSection& section : sections) {
    double before = values.front();
    double position = before, speed = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double input = values[i];
      const double intervals = i == 0 ? 1.0 : intervalsS[i] * rateHz;
      const double steps = std::max(1.0, std::round(intervals));
      const SectionStep step(section, intervals / steps);
      double from = before;
      for (double n = 1.0; n <= steps; ++n) {
        const double to = n == steps ? input : before + (input - before) * n / steps;
        step.advance(position, speed, from, to);
        from = to;
      }
      values[i] = step.output(position, speed, input);
      before = input;
    }
  }
}

// The values with those that are not finite interpolated over time; unchanged if none is finite.
std::vector<double> finiteValues(std::span<const double> timeS, std::span<const double> values) {
  std::vector<double> whole(values.begin(), values.end());
  std::size_t before = whole.size();
  for (std::size_t i = 0; i <= whole.size(); ++i) {
    const bool end = i == whole.size();
    if (!end && !std::isfinite(whole[i])) continue;
    const bool first = before == whole.size();
    if (end && first) return whole;
    for (std::size_t k = first ? 0 : before + 1; k < i; ++k) {
      if (first || end) {
        whole[k] = end ? whole[before] : whole[i];
      } else {
        const double part = (timeS[k] - timeS[before]) / (timeS[i] - timeS[before]);
        whole[k] = whole[before] + part * (whole[i] - whole[before]);
      }
    }
    before = i;
  }
  return whole;
}

void requireSeries(std::span<const double> timeS, std::span<const double> values) {
  if (timeS.size() != values.size())
    throw std::invalid_argument("butterworth: " + std::to_string(timeS.size()) + " times for " +
                                std::to_string(values.size()) + " values");
  for (std::size_t i = 0; i < timeS.size(); ++i)
    if (!std::isfinite(timeS[i]) || (i > 0 && !(timeS[i] > timeS[i - 1])))
      throw std::invalid_argument("butterworth: times must ascend; sample " + std::to_string(i) +
                                  " doesn't");
}

// Number of poles of the filter.
std::size_t polesOf(const ButterworthOptions& options) {
  const auto order = static_cast<std::size_t>(options.order);
  return options.usesLow() && options.usesHigh() ? 2 * order : order;
}

void zeroPhaseStretch(std::span<const double> timeS,
                      std::span<double> values,
                      const ButterworthOptions& options) {
  const std::size_t n = values.size();
  if (n == 0 || !std::isfinite(values.front())) return;
  const std::size_t pad = std::min(3 * (polesOf(options) + 1), n - 1);
  const double rateHz =
      n > 1 ? static_cast<double>(n - 1) / (timeS.back() - timeS.front()) : 2.0 * options.highHz;
  std::vector<double> extended, intervalsS{0.0};
  extended.reserve(n + 2 * pad);
  for (std::size_t i = pad; i > 0; --i) extended.push_back(2.0 * values.front() - values[i]);
  extended.insert(extended.end(), values.begin(), values.end());
  for (std::size_t i = 1; i <= pad; ++i)
    extended.push_back(2.0 * values.back() - values[n - 1 - i]);
  for (std::size_t i = pad; i > 0; --i) intervalsS.push_back(timeS[i] - timeS[i - 1]);
  for (std::size_t i = 1; i < n; ++i) intervalsS.push_back(timeS[i] - timeS[i - 1]);
  for (std::size_t i = 1; i <= pad; ++i) intervalsS.push_back(timeS[n - i] - timeS[n - 1 - i]);

  const std::vector<ButterworthSection> sections = butterworthSections(options, rateHz);
  filterStretch(extended, intervalsS, sections, rateHz);
  std::reverse(extended.begin(), extended.end());
  std::reverse(intervalsS.begin() + 1, intervalsS.end());
  filterStretch(extended, intervalsS, sections, rateHz);
  for (std::size_t i = 0; i < n; ++i) values[i] = extended[extended.size() - 1 - pad - i];
}

// Applies `filter(times, part)` to each stretch without a gap; `part` holds its finite values.
template <class Filter>
std::vector<double> filteredByStretch(std::span<const double> timeS,
                                      std::span<const double> values,
                                      const ButterworthOptions& options,
                                      std::span<const std::size_t> gapSamples,
                                      const Filter& filter) {
  options.validate();
  requireSeries(timeS, values);
  std::vector<double> out(values.begin(), values.end());
  for (const SampleRange& stretch : sampleStretches(values.size(), gapSamples)) {
    const std::size_t n = stretch.end - stretch.begin;
    const auto times = timeS.subspan(stretch.begin, n);
    std::vector<double> part = finiteValues(times, values.subspan(stretch.begin, n));
    filter(times, part);
    std::copy(part.begin(), part.end(), out.begin() + static_cast<std::ptrdiff_t>(stretch.begin));
  }
  return out;
}

}  // namespace

void ButterworthOptions::validate() const {
  const std::string name = nameOf(band);
  const auto require = [&](const char* field, double hz) {
    if (!(std::isfinite(hz) && hz > 0.0))
      throw std::invalid_argument(name + ": " + field + " must be above 0 Hz, is " +
                                  numberText(hz));
  };
  if (usesLow()) require("low edge", lowHz);
  if (usesHigh()) require("high edge", highHz);
  if (usesLow() && usesHigh() && !(lowHz < highHz))
    throw std::invalid_argument(name + ": low must be below high, but " + numberText(lowHz) +
                                " Hz is not below " + numberText(highHz) + " Hz");
  if (order < 1 || order > kHighestOrder)
    throw std::invalid_argument(name + ": order must be 1.." + std::to_string(kHighestOrder) +
                                ", is " + std::to_string(order));
}

void ButterworthOptions::validateForRate(double rateHz) const {
  validate();
  const double edge = usesHigh() ? highHz : lowHz;
  if (edge < rateHz / 2.0) return;
  throw std::invalid_argument(nameOf(band) + ": " + numberText(edge) + " Hz is not below " +
                              fixedText(rateHz / 2.0, 2) + " Hz, half the rate of " +
                              fixedText(rateHz, 2) + " samples/s");
}

std::vector<ButterworthSection> butterworthSections(const ButterworthOptions& options,
                                                    double rateHz) {
  options.validate();
  if (!(std::isfinite(rateHz) && rateHz > 0.0))
    throw std::invalid_argument("butterworth: the rate must be above 0 Hz, is " +
                                numberText(rateHz));
  using Band = ButterworthOptions::Band;
  const double high = warped(options.highHz, rateHz);
  double low = warped(options.lowHz, rateHz);
  switch (options.band) {
    case Band::kLowPass:
      return edgeSections(options.order, high, false);
    case Band::kHighPass:
      return edgeSections(options.order, low, true);
    case Band::kBandPass:
    case Band::kBandStop:
      break;
  }
  // Where both edges were moved, a narrow band just below the highest frequency is left.
  if (options.lowHz / rateHz >= kHighestEdge) low = 0.9 * high;
  return bandSections(options.order, low, high, options.band == Band::kBandStop);
}

double butterworthLength(const ButterworthOptions& options, double rateHz) {
  double slowest = 0.0;  // magnitude of the pole of the slowest decay
  for (const ButterworthSection& section : butterworthSections(options, rateHz)) {
    const double half = section.damping / 2.0;
    const ButterworthPole s =
        section.firstOrder ? ButterworthPole(-section.step)
                           : section.step * (-half + std::sqrt(ButterworthPole(half * half - 1.0)));
    slowest = std::max(slowest, std::abs((1.0 + s) / (1.0 - s)));
  }
  return std::log(kLeft) / std::log(slowest);
}

ButterworthFilter::ButterworthFilter(const ButterworthOptions& options, std::size_t numSignals)
    : options_(options), numSignals_(numSignals), last_(numSignals, 0.0) {
  options_.validate();
}

void ButterworthFilter::restart() noexcept {
  started_ = false;
  rateHz_ = 0.0;
  intervalsS_.clear();
  elapsedS_ = 0.0;
  nextInterval_ = 0;
  std::fill(last_.begin(), last_.end(), 0.0);
}

// Takes an interval and returns the mean rate over the last ones.
double ButterworthFilter::nextRate(double intervalS) {
  if (intervalsS_.size() < kIntervalsForRate) {
    intervalsS_.push_back(intervalS);
  } else {
    intervalsS_[nextInterval_] = intervalS;
    nextInterval_ = (nextInterval_ + 1) % kIntervalsForRate;
  }
  elapsedS_ = 0.0;
  for (const double stored : intervalsS_) elapsedS_ += stored;
  return static_cast<double>(intervalsS_.size()) / elapsedS_;
}

void ButterworthFilter::step(std::span<double> values, double intervalS) {
  if (values.size() != numSignals_)
    throw std::invalid_argument("butterworth: " + std::to_string(values.size()) + " values of " +
                                std::to_string(numSignals_) + " signals");
  const bool first = !started_;
  if (!first && !(std::isfinite(intervalS) && intervalS > 0.0))
    throw std::invalid_argument("butterworth: an interval must be above 0 s, is " +
                                numberText(intervalS));
  for (std::size_t i = 0; i < values.size(); ++i)
    last_[i] = values[i] = std::isfinite(values[i]) ? values[i] : last_[i];
  if (first) {
    // The state of rest is the same for every rate.
    sections_ = butterworthSections(options_, 4.0 * std::max(options_.lowHz, options_.highHz));
    states_.assign(sections_.size() * numSignals_, {});
  } else if (const double rateHz = nextRate(intervalS); rateHz != rateHz_) {
    rateHz_ = rateHz;
    sections_ = butterworthSections(options_, rateHz_);
  }
  const double intervals = first ? 1.0 : intervalS * rateHz_;
  const double steps = std::max(1.0, std::round(intervals));
  State* state = states_.data();
  for (const ButterworthSection& section : sections_) {
    const SectionStep step(section, intervals / steps);
    for (double& value : values) {
      const double input = value;
      if (first) {
        state->position = state->input = input;
        state->speed = 0.0;
      } else if (steps == 1.0) {
        step.advance(state->position, state->speed, state->input, input);
      } else {
        double from = state->input;
        for (double n = 1.0; n <= steps; ++n) {
          const double to = n == steps ? input : state->input + (input - state->input) * n / steps;
          step.advance(state->position, state->speed, from, to);
          from = to;
        }
      }
      if (std::abs(state->position) < kVanished) state->position = 0.0;
      if (std::abs(state->speed) < kVanished) state->speed = 0.0;
      state->input = input;
      value = step.output(state->position, state->speed, input);
      ++state;
    }
  }
  started_ = true;
}

std::vector<double> butterworthFiltered(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const ButterworthOptions& options,
                                        std::span<const std::size_t> gapSamples) {
  return filteredByStretch(
      timeS,
      values,
      options,
      gapSamples,
      [&](std::span<const double> times, std::vector<double>& part) {
        if (!std::isfinite(part.front())) return;
        const std::size_t n = part.size();
        std::vector<double> intervalsS{0.0};
        for (std::size_t i = 1; i < n; ++i) intervalsS.push_back(times[i] - times[i - 1]);
        const double rateHz = n > 1 ? static_cast<double>(n - 1) / (times.back() - times.front())
                                    : 4.0 * std::max(options.lowHz, options.highHz);
        filterStretch(part, intervalsS, butterworthSections(options, rateHz), rateHz);
      });
}

std::vector<double> butterworthZeroPhase(std::span<const double> timeS,
                                         std::span<const double> values,
                                         const ButterworthOptions& options,
                                         std::span<const std::size_t> gapSamples) {
  return filteredByStretch(timeS,
                           values,
                           options,
                           gapSamples,
                           [&](std::span<const double> times, std::vector<double>& part) {
                             zeroPhaseStretch(times, part, options);
                           });
}

}  // namespace palpate
