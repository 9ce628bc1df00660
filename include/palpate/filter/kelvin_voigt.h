// The Kelvin-Voigt model of a tactile signal and its Kalman filter (study 2.1.2, eq. 2.1): a mass m
// on a spring E and a damper eta, pushed by a force nobody knows.
//   m y'' = F - eta y' - E y,   state x = (y, y'): x' = A x + (0, F/m),
//   A = [0 1; -E/m -eta/m],   z = y + v
// y is the signal [counts], y' its speed [counts/s]. F is white noise of spectral density S, v has
// variance r. Only E/m, eta/m and S/m^2 can be seen in a signal: a force has no unit here.
//
// Discretised exactly for every interval T, which may differ from sample to sample:
//   x_(k+1) = e^(A T) x_k + w,  e^(A T) = [h' + b h, h; -a h, h'],  a = E/m, b = eta/m
// h the impulse response: with D = b^2/4 - a, h = e^(-b T/2) times sinh(sqrt(D) T)/sqrt(D) (damping
// d > 1), T (d = 1) or sin(sqrt(-D) T)/sqrt(-D) (d < 1). Cov(w) = S/m^2 integral_0^T (h, h')(h,
// h')^T.
//
// The first value z of a stretch starts it: y = z with variance r (nothing known before), y' = 0:
// at rest, as in the study. A value that isn't finite is none: the state is predicted only. The
// model's rest is y = 0, which the filter therefore leans to; the zero-order filter
// (filter/kalman.h) does not, and is what the study prefers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

struct KelvinVoigtModel {
  double mass = 1.0;              // m > 0 [force s^2/counts]
  double stiffness = 400.0;       // E >= 0 [force/counts]
  double viscosity = 40.0;        // eta >= 0 [force s/counts]
  double forceNoise = 1e8;        // S > 0 [force^2 s]
  double measurementNoise = 1.0;  // r > 0 [counts^2]

  // Throws std::invalid_argument with the field's name.
  void validate() const;
  // sqrt(E/m) / 2 pi [Hz], and d = eta / (2 sqrt(m E)); d is infinite for E = 0.
  double naturalHz() const;
  double damping() const;
};

// One interval: transition and covariance of its noise.
struct KelvinVoigtStep {
  double fYy = 1.0, fYv = 0.0, fVy = 0.0, fVv = 1.0;  // y from y, y from speed, ..
  double qYy = 0.0, qYv = 0.0, qVv = 0.0;
};
// intervalS > 0 [s]. Throws std::invalid_argument; the model is taken as valid.
KelvinVoigtStep kelvinVoigtStep(const KelvinVoigtModel& model, double intervalS);

// Mean and covariance of the state.
struct KelvinVoigtState {
  double y = 0.0, v = 0.0;                 // [counts], [counts/s]
  double pYy = 0.0, pYv = 0.0, pVv = 0.0;  // [counts^2], [counts^2/s], [counts^2/s^2]
};

// Value by value; causal.
class KelvinVoigtFilter {
 public:
  // Throws std::invalid_argument for a bad model.
  explicit KelvinVoigtFilter(const KelvinVoigtModel& model);

  // Takes a value that came `intervalS` > 0 after the one before (the first one's is ignored);
  // returns the position. Before the first finite value: the value itself. Throws
  // std::invalid_argument for a bad interval.
  double step(double value, double intervalS);
  // The same with an interval that was discretised before: many filters of one model, or even
  // sampling.
  double step(double value, const KelvinVoigtStep& interval) noexcept;
  // The next value starts anew: after a gap.
  void restart() noexcept { started_ = false; }
  bool started() const noexcept { return started_; }
  const KelvinVoigtState& state() const noexcept { return state_; }
  const KelvinVoigtModel& model() const noexcept { return model_; }

 private:
  KelvinVoigtModel model_;
  KelvinVoigtState state_;
  KelvinVoigtStep last_;         // the discretised interval of last time: often the same
  double lastIntervalS_ = -1.0;  // no interval yet
  bool started_ = false;
};

// A whole series. Times [s] ascend strictly, one per value. `gapSamples`: last sample before each
// gap, ascending; the filter restarts behind it, the smoother doesn't look across. Before the first
// finite value of a stretch filtered positions are the values as they are, smoothed ones the first
// smoothed position. All throw std::invalid_argument.
std::vector<double> kelvinVoigtFiltered(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtModel& model,
                                        std::span<const std::size_t> gapSamples = {});

// Rauch-Tung-Striebel: position given all values of the stretch, before and after.
struct KelvinVoigtSmoothed {
  std::vector<double> position;  // [counts]
  std::vector<double> variance;  // of the position [counts^2]
  std::vector<double> speed;     // [counts/s]
  double logLikelihood = 0.0;    // of all values but the first of each stretch, given that one
  std::size_t innovations = 0;   // how many values that is
};
KelvinVoigtSmoothed kelvinVoigtSmoothed(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtModel& model,
                                        std::span<const std::size_t> gapSamples = {});

}  // namespace palpate
