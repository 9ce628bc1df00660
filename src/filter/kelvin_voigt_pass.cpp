#include "filter/kelvin_voigt_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

// Largest product of interval and rate (max(sqrt(a), b)) for which the power series of the noise is
// exact to rounding; longer intervals are halved first.
constexpr double kSmall = 0.25;
constexpr int kTerms = 14;
// Below this value of |D| T^2, sinh(sqrt(D) T) / sqrt(D) is computed by its power series, which
// includes the limit d = 1.
constexpr double kNearCritical = 0.01;

void setTransition(KelvinVoigtStep& step, double a, double b, double t) noexcept {
  const double half = 0.5 * b;
  const double d = half * half - a;
  if (std::abs(d) * t * t < kNearCritical) {
    const double x = d * t * t;
    const double fall = std::exp(-half * t);
    const double s =
        fall * t * (1.0 + x / 6.0 * (1.0 + x / 20.0 * (1.0 + x / 42.0 * (1.0 + x / 72.0))));
    const double c =
        fall * (1.0 + x / 2.0 * (1.0 + x / 12.0 * (1.0 + x / 30.0 * (1.0 + x / 56.0))));
    step.fYv = s;
    step.fYy = c + half * s;
    step.fVv = c - half * s;
  } else if (d < 0.0) {
    const double w = std::sqrt(-d);
    const double fall = std::exp(-half * t);
    const double s = fall * std::sin(w * t) / w, c = fall * std::cos(w * t);
    step.fYv = s;
    step.fYy = c + half * s;
    step.fVv = c - half * s;
  } else {
    // Computed from the two real poles; the slow pole without cancellation.
    const double root = std::sqrt(d);
    const double fast = -(half + root), slow = -a / (half + root);
    const double eFast = std::exp(fast * t), eSlow = std::exp(slow * t);
    const double inverse = 1.0 / (2.0 * root);
    step.fYv = (eSlow - eFast) * inverse;
    step.fYy = (slow * eFast - fast * eSlow) * inverse;
    step.fVv = (slow * eSlow - fast * eFast) * inverse;
  }
  step.fVy = -a * step.fYv;
}

// Solves dQ/dt = A Q + Q A^T + e e^T, e = (0, 1), as a power series in t.
void setSmallNoise(KelvinVoigtStep& step, double a, double b, double t) noexcept {
  double yy = 0.0, yv = 0.0, vv = t;
  step.qYy = 0.0;
  step.qYv = 0.0;
  step.qVv = vv;
  for (int n = 2; n <= kTerms; ++n) {
    const double factor = t / n;
    const double nextYy = 2.0 * yv * factor;
    const double nextYv = (vv - a * yy - b * yv) * factor;
    vv = -2.0 * (a * yv + b * vv) * factor;
    yy = nextYy;
    yv = nextYv;
    step.qYy += yy;
    step.qYv += yv;
    step.qVv += vv;
  }
}

// Q(2 T) = Q(T) + F Q(T) F^T, F(2 T) = F^2: no term cancels another.
void doubleInterval(KelvinVoigtStep& s) noexcept {
  const KelvinVoigtState noise{.pYy = s.qYy, .pYv = s.qYv, .pVv = s.qVv};
  const KelvinVoigtState both = predicted(noise, s);  // adds the noise of the second half
  s.qYy = both.pYy;
  s.qYv = both.pYv;
  s.qVv = both.pVv;
  const double yv = s.fYv * (s.fYy + s.fVv), vy = s.fVy * (s.fYy + s.fVv);
  const double cross = s.fYv * s.fVy;
  s.fYy = s.fYy * s.fYy + cross;
  s.fVv = s.fVv * s.fVv + cross;
  s.fYv = yv;
  s.fVy = vy;
}

}  // namespace

KelvinVoigtStep unitNoiseStep(double a, double b, double intervalS) noexcept {
  const double pace = std::max(std::sqrt(a), b) * intervalS;
  int doublings = 0;
  double part = intervalS;
  if (pace > kSmall) {
    doublings = std::ilogb(pace / kSmall) + 1;
    part = std::ldexp(intervalS, -doublings);
  }
  KelvinVoigtStep step;
  setTransition(step, a, b, part);
  setSmallNoise(step, a, b, part);
  if (doublings == 0) return step;
  for (int i = 0; i < doublings; ++i) doubleInterval(step);
  setTransition(step, a, b, intervalS);  // again, since squaring lost some digits
  return step;
}

KelvinVoigtState predicted(const KelvinVoigtState& x, const KelvinVoigtStep& s) noexcept {
  const double yyF = s.fYy * x.pYy + s.fYv * x.pYv, yvF = s.fYy * x.pYv + s.fYv * x.pVv;
  const double vyF = s.fVy * x.pYy + s.fVv * x.pYv, vvF = s.fVy * x.pYv + s.fVv * x.pVv;
  return {.y = s.fYy * x.y + s.fYv * x.v,
          .v = s.fVy * x.y + s.fVv * x.v,
          .pYy = yyF * s.fYy + yvF * s.fYv + s.qYy,
          .pYv = yyF * s.fVy + yvF * s.fVv + s.qYv,
          .pVv = vyF * s.fVy + vvF * s.fVv + s.qVv};
}

KelvinVoigtState updated(const KelvinVoigtState& x, double value, double r) noexcept {
  const double perVariance = 1.0 / (x.pYy + r);
  const double surprise = (value - x.y) * perVariance;
  return {.y = x.y + x.pYy * surprise,
          .v = x.v + x.pYv * surprise,
          .pYy = x.pYy * r * perVariance,
          .pYv = x.pYv * r * perVariance,
          .pVv = x.pVv - x.pYv * x.pYv * perVariance};
}

void forwardPass(std::span<const double> timeS,
                 std::span<const double> values,
                 const KelvinVoigtModel& model,
                 KelvinVoigtPass& pass) {
  pass.moments.clear();
  pass.logLikelihood = 0.0;
  pass.innovations = 0;
  pass.first = 0;
  while (pass.first < values.size() && !std::isfinite(values[pass.first])) ++pass.first;
  if (pass.first == values.size()) return;
  const double r = model.measurementNoise;
  pass.moments.resize(values.size() - pass.first);
  pass.moments[0] = {.state = {.y = values[pass.first], .pYy = r}};
  double lastIntervalS = -1.0;
  KelvinVoigtStep step;
  for (std::size_t i = 1; i < pass.moments.size(); ++i) {
    const std::size_t at = pass.first + i;
    const double intervalS = timeS[at] - timeS[at - 1];
    if (intervalS != lastIntervalS) step = kelvinVoigtStep(model, intervalS);
    lastIntervalS = intervalS;
    KelvinVoigtMoment& moment = pass.moments[i];
    moment.step = step;
    moment.predicted = predicted(pass.moments[i - 1].state, step);
    moment.state = moment.predicted;
    if (!std::isfinite(values[at])) continue;
    const double variance = moment.predicted.pYy + r, surprise = values[at] - moment.predicted.y;
    pass.logLikelihood -=
        0.5 * (std::log(2.0 * std::numbers::pi * variance) + surprise * surprise / variance);
    ++pass.innovations;
    moment.state = updated(moment.predicted, values[at], r);
  }
}

// The smoother's step is
//   G = P F^T P(predicted)^-1,  x += G (x' - x'(predicted)),
//   P += G (P' - P'(predicted)) G^T,  Cov(x', x) = P' G^T
void backwardPass(KelvinVoigtPass& pass) {
  for (std::size_t i = pass.moments.size(); i-- > 1;) {
    KelvinVoigtMoment& next = pass.moments[i];
    KelvinVoigtState& x = pass.moments[i - 1].state;
    const KelvinVoigtStep& s = next.step;
    const KelvinVoigtState& p = next.predicted;
    const double inverse = 1.0 / (p.pYy * p.pVv - p.pYv * p.pYv);
    const double yyF = x.pYy * s.fYy + x.pYv * s.fYv, yvF = x.pYy * s.fVy + x.pYv * s.fVv;
    const double vyF = x.pYv * s.fYy + x.pVv * s.fYv, vvF = x.pYv * s.fVy + x.pVv * s.fVv;
    const double gYy = (yyF * p.pVv - yvF * p.pYv) * inverse;
    const double gYv = (yvF * p.pYy - yyF * p.pYv) * inverse;
    const double gVy = (vyF * p.pVv - vvF * p.pYv) * inverse;
    const double gVv = (vvF * p.pYy - vyF * p.pYv) * inverse;
    const double dy = next.state.y - p.y, dv = next.state.v - p.v;
    const double dYy = next.state.pYy - p.pYy, dYv = next.state.pYv - p.pYv,
                 dVv = next.state.pVv - p.pVv;
    next.cYy = next.state.pYy * gYy + next.state.pYv * gYv;
    next.cYv = next.state.pYy * gVy + next.state.pYv * gVv;
    next.cVy = next.state.pYv * gYy + next.state.pVv * gYv;
    next.cVv = next.state.pYv * gVy + next.state.pVv * gVv;
    x.y += gYy * dy + gYv * dv;
    x.v += gVy * dy + gVv * dv;
    x.pYy += gYy * gYy * dYy + 2.0 * gYy * gYv * dYv + gYv * gYv * dVv;
    x.pYv += gYy * gVy * dYy + (gYy * gVv + gYv * gVy) * dYv + gYv * gVv * dVv;
    x.pVv += gVy * gVy * dYy + 2.0 * gVy * gVv * dYv + gVv * gVv * dVv;
  }
}

void validateTimes(std::span<const double> timeS, std::span<const double> values) {
  if (timeS.size() != values.size())
    throw std::invalid_argument("kelvin-voigt: " + std::to_string(timeS.size()) + " times for " +
                                std::to_string(values.size()) + " values");
  for (std::size_t i = 0; i < timeS.size(); ++i)
    if (!std::isfinite(timeS[i]) || (i > 0 && !(timeS[i] > timeS[i - 1])))
      throw std::invalid_argument("kelvin-voigt: times must ascend; sample " + std::to_string(i) +
                                  " doesn't");
}

}  // namespace palpate
