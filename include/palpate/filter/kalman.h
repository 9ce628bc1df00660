// The zero-order Kalman filter of one signal (study 2.1.2; Kalman 1960): the state is the value
// itself, which stays what it is but for process noise.
//   predict: P += q;   update: K = P / (P + r), x += K (z - x), P = (1 - K) P = K r
// The first value z starts it: x = z, P = r (nothing known before). K goes to the steady gain P/(P
// + r) with P = (q + sqrt(q^2 + 4 q r)) / 2: 0.270156 for q = 0.05, r = 0.5. Only q / r matters for
// x. Causal; q counts per sample, whatever the interval.
//
// Offline, the Rauch-Tung-Striebel smoother (Rauch et al. 1965) goes back over it: x_k += P_k /
// (P_k + q) (x_(k+1) - x_k), the mean given all values, before and after; no lag.
//
// A value that isn't finite is none: the state stays, P grows by q.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

struct KalmanOptions {
  // variance of the process noise per sample [units^2], >= 0; 0: the mean of all values so far
  double q = 0.05;
  double r = 0.5;  // variance of the measurement noise [units^2], > 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
  // What the gain goes to, 0..1.
  double steadyGain() const;
};

class KalmanFilter {
 public:
  explicit KalmanFilter(const KalmanOptions& options = {});
  // Takes a value, returns the state. Before the first finite value: the value itself.
  double step(double value) noexcept;
  // The next value starts anew: after a gap.
  void restart() noexcept { started_ = false; }
  bool started() const noexcept { return started_; }
  double state() const noexcept { return state_; }
  double variance() const noexcept { return variance_; }  // of the state [units^2]
  double gain() const noexcept { return gain_; }          // of the last update

 private:
  KalmanOptions options_;
  double state_ = 0.0;
  double variance_ = 0.0;
  double gain_ = 1.0;
  bool started_ = false;
};

// A whole series, as many values as given. `gapSamples`: last sample before each gap, ascending;
// the filter restarts behind it, the smoother doesn't look across. Values that aren't finite before
// the first finite one of a stretch stay as they are in kalmanFiltered; the smoother gives them its
// first state (and stays silent, NaN, where all are). Throws std::invalid_argument for bad options
// or gaps.
std::vector<double> kalmanFiltered(std::span<const double> values,
                                   const KalmanOptions& options = {},
                                   std::span<const std::size_t> gapSamples = {});
std::vector<double> rtsSmoothed(std::span<const double> values,
                                const KalmanOptions& options = {},
                                std::span<const std::size_t> gapSamples = {});

}  // namespace palpate
