// The Kelvin-Voigt model of a tactile signal and its Kalman filter and smoother (study 2.1.2, eq.
// 2.1), for the filter "kelvin-voigt". The model is a mass m on a spring E and a damper eta, driven
// by an unknown force F:
//   m y'' = F - eta y' - E y,   state x = (y, y'): x' = A x + (0, F/m),
//   A = [0 1; -E/m -eta/m],   z = y + v
// y is the signal [counts], y' its speed [counts/s]. F is white noise of spectral density S, v has
// variance r. A signal determines only E/m, eta/m and S/m^2, so that the unit of force is
// arbitrary.
//
// The model is discretised exactly for every interval T, which may differ from sample to sample:
//   x_(k+1) = e^(A T) x_k + w,  e^(A T) = [h' + b h, h; -a h, h'],  a = E/m, b = eta/m
// Here h is the impulse response. With D = b^2/4 - a, it is e^(-b T/2) times sinh(sqrt(D)
// T)/sqrt(D) (damping d > 1), T (d = 1) or sin(sqrt(-D) T)/sqrt(-D) (d < 1).
//   Cov(w) = S/m^2 integral_0^T (h, h')(h, h')^T.
//
// The first value z of a stretch sets the state: y = z with variance r (nothing is known before),
// and y' = 0 (at rest, as in the study). Where a value is not finite, the filter only predicts. The
// model's rest position is y = 0, which biases the filter towards 0; the zero-order filter
// (filter/kalman.h), which the study prefers, has no such bias.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

// The parameters of the model.
struct KelvinVoigtModel {
  double mass = 1.0;              // m > 0 [force s^2/counts]
  double stiffness = 400.0;       // E >= 0 [force/counts]
  double viscosity = 40.0;        // eta >= 0 [force s/counts]
  double forceNoise = 1e8;        // S > 0 [force^2 s]
  double measurementNoise = 1.0;  // r > 0 [counts^2]

  // Throws std::invalid_argument that names the field.
  void validate() const;
  // Natural frequency sqrt(E/m) / 2 pi [Hz], and damping d = eta / (2 sqrt(m E)); d is infinite for
  // E = 0.
  double naturalHz() const;
  double damping() const;
};

// The discretised model for one interval: the transition matrix f and the covariance q of its
// noise.
struct KelvinVoigtStep {
  // Transition: new y from y, new y from speed, and so on.
  double fYy = 1.0, fYv = 0.0, fVy = 0.0, fVv = 1.0;
  double qYy = 0.0, qYv = 0.0, qVv = 0.0;
};
// Discretises a model for an interval [s] > 0. Throws std::invalid_argument for a bad interval; the
// model must be valid.
KelvinVoigtStep kelvinVoigtStep(const KelvinVoigtModel& model, double intervalS);

// Mean and covariance of the state.
struct KelvinVoigtState {
  double y = 0.0, v = 0.0;                 // [counts], [counts/s]
  double pYy = 0.0, pYv = 0.0, pVv = 0.0;  // [counts^2], [counts^2/s], [counts^2/s^2]
};

// Filters values one by one; causal.
class KelvinVoigtFilter {
 public:
  // Throws std::invalid_argument for a bad model.
  explicit KelvinVoigtFilter(const KelvinVoigtModel& model);

  // Takes a value that was measured `intervalS` > 0 after the previous one (ignored for the first
  // value) and returns the position. Before the first finite value it returns the value itself.
  // Throws std::invalid_argument for a bad interval.
  double step(double value, double intervalS);
  // Does the same with an interval that was already discretised, for many filters of one model or
  // even sampling.
  double step(double value, const KelvinVoigtStep& interval) noexcept;
  // Lets the next value set the state again; call it after a gap.
  void restart() noexcept { started_ = false; }
  bool started() const noexcept { return started_; }
  const KelvinVoigtState& state() const noexcept { return state_; }
  const KelvinVoigtModel& model() const noexcept { return model_; }

 private:
  KelvinVoigtModel model_;
  KelvinVoigtState state_;
  // The discretised last interval; the next one is often the same.
  KelvinVoigtStep last_;
  double lastIntervalS_ = -1.0;  // negative before the first interval
  bool started_ = false;
};

// Filter and smoother for a whole series. Times [s] ascend strictly, one per value. `gapSamples`
// are the last samples before each gap, ascending; the filter restarts after a gap, and the
// smoother does not use values across it. Before the first finite value of a stretch, filtered
// positions are the values themselves, and smoothed positions are the first smoothed position. The
// functions throw std::invalid_argument for other input.
std::vector<double> kelvinVoigtFiltered(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtModel& model,
                                        std::span<const std::size_t> gapSamples = {});

// Result of the Rauch-Tung-Striebel smoother: position given all values of the stretch, before and
// after.
struct KelvinVoigtSmoothed {
  std::vector<double> position;  // [counts]
  std::vector<double> variance;  // of the position [counts^2]
  std::vector<double> speed;     // [counts/s]
  // Log-likelihood of all values except the first of each stretch, given that first value.
  double logLikelihood = 0.0;
  std::size_t innovations = 0;  // number of these values
};
KelvinVoigtSmoothed kelvinVoigtSmoothed(std::span<const double> timeS,
                                        std::span<const double> values,
                                        const KelvinVoigtModel& model,
                                        std::span<const std::size_t> gapSamples = {});

}  // namespace palpate
