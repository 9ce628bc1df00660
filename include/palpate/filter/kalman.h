// The zero-order Kalman filter of one signal (study 2.1.2; Kalman 1960), for the filters "kalman"
// and "rts". The state is the value itself, which changes only by process noise:
//   predict: P += q;   update: K = P / (P + r), x += K (z - x), P = (1 - K) P = K r
// The first value z sets the state: x = z, P = r (nothing is known before). K approaches the steady
// gain P/(P + r) with P = (q + sqrt(q^2 + 4 q r)) / 2: 0.270156 for q = 0.05, r = 0.5. Only q / r
// influences x. The filter is causal; q is per sample, whatever the interval.
//
// Offline, the Rauch-Tung-Striebel smoother (Rauch et al. 1965) runs backward over the filtered
// states. It gives the mean given all values, before and after, without lag:
//   x_k += P_k / (P_k + q) (x_(k+1) - x_k)
//
// Where a value is not finite, the state stays and P grows by q.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

// The noise variances of the filter.
struct KalmanOptions {
  // Variance of the process noise per sample [units^2], >= 0. With 0 the state is the mean of all
  // values so far.
  double q = 0.05;
  // Variance of the measurement noise [units^2], > 0.
  double r = 0.5;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Filters values one by one.
class KalmanFilter {
 public:
  explicit KalmanFilter(const KalmanOptions& options = {});
  // Takes a value and returns the state. Before the first finite value it returns the value itself.
  double step(double value) noexcept;
  // Lets the next value set the state again; call it after a gap.
  void restart() noexcept { started_ = false; }
  bool started() const noexcept { return started_; }
  double state() const noexcept { return state_; }
  double variance() const noexcept { return variance_; }  // variance of the state [units^2]
  double gain() const noexcept { return gain_; }          // gain of the last update

 private:
  KalmanOptions options_;
  double state_ = 0.0;
  double variance_ = 0.0;
  double gain_ = 1.0;
  bool started_ = false;
};

// Filter and smoother for a whole series; they return as many values as given. `gapSamples` are the
// last samples before each gap, ascending; the filter restarts after a gap, and the smoother does
// not use values across it. Values that are not finite before the first finite value of a stretch
// stay unchanged in kalmanFiltered; rtsSmoothed replaces them by its first state (and gives NaN
// where no value of the stretch is finite). Both throw std::invalid_argument for bad options or
// gaps.
std::vector<double> kalmanFiltered(std::span<const double> values,
                                   const KalmanOptions& options = {},
                                   std::span<const std::size_t> gapSamples = {});
std::vector<double> rtsSmoothed(std::span<const double> values,
                                const KalmanOptions& options = {},
                                std::span<const std::size_t> gapSamples = {});

}  // namespace palpate
