#include "palpate/filter/kelvin_voigt.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "filter/kelvin_voigt_pass.h"
#include "filter/sample_stretches.h"

namespace palpate {

void KelvinVoigtModel::validate() const {
  const auto require = [](bool good, const char* field, const char* range, double value) {
    if (!good || !std::isfinite(value))
      throw std::invalid_argument(std::string("kelvin-voigt: ") + field + " must be " + range +
                                  ", is " + std::to_string(value));
  };
  require(mass > 0.0, "m", "above 0", mass);
  require(stiffness >= 0.0, "e", "0 or above", stiffness);
  require(viscosity >= 0.0, "eta", "0 or above", viscosity);
  require(forceNoise > 0.0, "the force's noise", "above 0", forceNoise);
  require(measurementNoise > 0.0, "the measurement's noise", "above 0", measurementNoise);
}

double KelvinVoigtModel::naturalHz() const {
  return std::sqrt(stiffness / mass) / (2.0 * std::numbers::pi);
}

double KelvinVoigtModel::damping() const { return viscosity / (2.0 * std::sqrt(mass * stiffness)); }

KelvinVoigtStep kelvinVoigtStep(const KelvinVoigtModel& model, double intervalS) {
  if (!(intervalS > 0.0 && std::isfinite(intervalS)))
    throw std::invalid_argument("kelvin-voigt: an interval must be above 0 s, is " +
                                std::to_string(intervalS));
  KelvinVoigtStep step =
      unitNoiseStep(model.stiffness / model.mass, model.viscosity / model.mass, intervalS);
  const double noise = model.forceNoise / (model.mass * model.mass);
  step.qYy *= noise;
  step.qYv *= noise;
  step.qVv *= noise;
  return step;
}

KelvinVoigtFilter::KelvinVoigtFilter(const KelvinVoigtModel& model) : model_(model) {
  model_.validate();
}

double KelvinVoigtFilter::step(double value, double intervalS) {
  if (started_ && intervalS != lastIntervalS_) {
    last_ = kelvinVoigtStep(model_, intervalS);
    lastIntervalS_ = intervalS;
  }
  return step(value, last_);
}

double KelvinVoigtFilter::step(double value, const KelvinVoigtStep& interval) noexcept {
  if (!started_) {
    if (!std::isfinite(value)) return value;
    started_ = true;
    state_ = {.y = value, .pYy = model_.measurementNoise};
    return value;
  }
  state_ = predicted(state_, interval);
  if (std::isfinite(value)) state_ = updated(state_, value, model_.measurementNoise);
  return state_.y;
}

std::vector<double> kelvinVoigtFiltered(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtModel& model,
                                        std::span<const std::size_t> gapSamples) {
  KelvinVoigtFilter filter(model);
  validateTimes(timeS, values);
  std::vector<double> out(values.size());
  for (const SampleRange& stretch : sampleStretches(values.size(), gapSamples)) {
    filter.restart();
    for (std::size_t i = stretch.begin; i < stretch.end; ++i)
      out[i] = filter.step(values[i], i > stretch.begin ? timeS[i] - timeS[i - 1] : 0.0);
  }
  return out;
}

KelvinVoigtSmoothed kelvinVoigtSmoothed(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtModel& model,
                                        std::span<const std::size_t> gapSamples) {
  model.validate();
  validateTimes(timeS, values);
  KelvinVoigtSmoothed out{.position = {values.begin(), values.end()},
                          .variance = std::vector<double>(values.size(), model.measurementNoise),
                          .speed = std::vector<double>(values.size(), 0.0)};
  KelvinVoigtPass pass;
  for (const SampleRange& stretch : sampleStretches(values.size(), gapSamples)) {
    const std::size_t size = stretch.end - stretch.begin;
    forwardPass(
        timeS.subspan(stretch.begin, size), values.subspan(stretch.begin, size), model, pass);
    backwardPass(pass);
    out.logLikelihood += pass.logLikelihood;
    out.innovations += pass.innovations;
    if (pass.moments.empty()) continue;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t moment = i < pass.first ? 0 : i - pass.first;
      const KelvinVoigtState& state = pass.moments[moment].state;
      out.position[stretch.begin + i] = state.y;
      out.variance[stretch.begin + i] = state.pYy;
      out.speed[stretch.begin + i] = state.v;
    }
  }
  return out;
}

}  // namespace palpate
