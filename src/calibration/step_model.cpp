#include "palpate/calibration/step_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/overdamped_shape.h"

namespace palpate {
namespace {

constexpr double kStepModelNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kStepModelSettled = 0.01;  // 1 - phi at the end of the lag

// Functions of z^2, which may be negative (then with cosh and sinh): cos z, sin z / z and (sin z /
// z - cos z) / z^2.
struct Oscillation {
  double cosine, sine, difference;
};
Oscillation oscillation(double z2) {
  const double z = std::sqrt(std::abs(z2));
  const double cosine = z2 >= 0.0 ? std::cos(z) : std::cosh(z);
  if (z < 1e-2)
    return {cosine, 1.0 - z2 / 6.0 * (1.0 - z2 / 20.0), 1.0 / 3.0 - z2 / 30.0 * (1.0 - z2 / 28.0)};
  const double sine = (z2 >= 0.0 ? std::sin(z) : std::sinh(z)) / z;
  return {cosine, sine, (sine - cosine) / z2};
}

StepShape shapeOf(const StepParameters& p, double tS) {
  return p.damping >= 1.0 ? overdampedShape(tS, p.t1S(), p.t2S())
                          : oscillatingShape(tS, p.timeConstantS, p.damping);
}

double inflectionOf(const StepParameters& p) {
  if (p.damping < 1.0)
    return std::acos(p.damping) * p.timeConstantS / std::sqrt(1.0 - p.damping * p.damping);
  const double t1 = p.t1S(), t2 = p.t2S();
  const double q = t1 / t2 - 1.0;
  // T1 T2 / (T1 - T2) ln(T1/T2) = T1 ln(1 + q) / q
  return q < 1e-8 ? t1 * (1.0 - 0.5 * q) : t1 * std::log1p(q) / q;
}

// Returns the first t at which `reached` is true, by doubling and halving from about the time
// constant of the response.
template <typename Reached>
double firstTime(const StepParameters& p, Reached reached) {
  double low = 0.0, high = 2.0 * p.timeConstantS * std::max(p.damping, 1.0 / p.damping);
  for (int i = 0; i < 60 && !reached(high); ++i) {
    low = high;
    high *= 1.25;
  }
  if (!reached(high)) return kStepModelNaN;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

double steadyTime(const StepParameters& p) {
  if (p.staticResponseCounts * p.driftCountsPerS > 0.0 || p.damping < 1.0) {
    const double sign = p.staticResponseCounts < 0.0 ? -1.0 : 1.0;
    const double atGain = firstTime(
        p, [&](double t) { return sign * (stepResponse(p, t) - p.staticResponseCounts) >= 0.0; });
    if (!std::isnan(atGain)) return atGain;
  }
  return firstTime(p, [&](double t) { return 1.0 - shapeOf(p, t).phi < kStepModelSettled; });
}

}  // namespace

StepParameters StepParameters::ofTimes(double staticResponseCounts,
                                       double driftCountsPerS,
                                       double t1S,
                                       double t2S) {
  const double t = std::sqrt(t1S) * std::sqrt(t2S);
  return {staticResponseCounts, driftCountsPerS, t, std::max(0.5 * (t1S / t + t2S / t), 1.0)};
}

double StepParameters::t1S() const {
  if (!(damping >= 1.0)) return kStepModelNaN;
  return timeConstantS * (damping + std::sqrt((damping - 1.0) * (damping + 1.0)));
}

double StepParameters::t2S() const {
  if (!(damping >= 1.0)) return kStepModelNaN;
  return timeConstantS / (damping + std::sqrt((damping - 1.0) * (damping + 1.0)));
}

StepShape overdampedShape(double tS, double t1S, double t2S) {
  return OverdampedShape(t1S, t2S).at(tS);
}

StepShape oscillatingShape(double tS, double timeConstantS, double damping) {
  if (!(tS > 0.0)) return {};
  const double s = tS / timeConstantS;
  const Oscillation z = oscillation(s * s * (1.0 - damping * damping));
  const double decay = std::exp(-damping * s);
  const double rest = decay * (z.cosine + damping * s * z.sine);
  StepShape shape;
  shape.phi = 1.0 - rest;
  shape.rate = decay * s * z.sine / timeConstantS;
  shape.derivativeByFirst = -tS * shape.rate;
  shape.derivativeBySecond =
      s * rest -
      decay * s * (z.sine * (1.0 + damping * s) + damping * damping * s * s * z.difference);
  return shape;
}

double stepResponse(const StepParameters& p, double tS) {
  return p.staticResponseCounts * shapeOf(p, tS).phi + p.driftCountsPerS * std::max(tS, 0.0);
}

double stepResponseRate(const StepParameters& p, double tS) {
  return p.staticResponseCounts * shapeOf(p, tS).rate + (tS >= 0.0 ? p.driftCountsPerS : 0.0);
}

StepCharacteristics characteristicsOf(const StepParameters& p) {
  StepCharacteristics c;
  const double k = p.staticResponseCounts;
  c.inflectionS = inflectionOf(p);
  c.inflectionCounts = stepResponse(p, c.inflectionS);
  c.tangentPerS = stepResponseRate(p, c.inflectionS);
  const bool flat = !(std::abs(c.tangentPerS) > 0.0);
  c.deadTimeS = flat ? kStepModelNaN : c.inflectionS - c.inflectionCounts / c.tangentPerS;
  c.tangentAtGainS =
      flat ? kStepModelNaN : c.inflectionS + (k - c.inflectionCounts) / c.tangentPerS;
  c.equivalentTangentPerS = stepResponse(p, c.tangentAtGainS) / c.tangentAtGainS;
  c.steadyS = steadyTime(p);
  return c;
}

}  // namespace palpate
