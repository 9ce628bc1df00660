// The search behind step_fit: moments of one shape, and Levenberg-Marquardt over its two
// parameters.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace palpate {

// What is searched: (log T2, log(T1/T2 - 1)), good for d clearly above 1, or (log T, d) around and
// below it.
enum class StepCoordinates { kTimes, kDamping };

// Samples in order of time, with weights, and the sums over all later samples of what the settled
// tail needs.
class StepSamples {
 public:
  // Both of the same size, time ascending from 0.
  StepSamples(std::vector<double> timeS, std::vector<double> values);
  void setWeights(std::vector<double> weights);
  // Means of neighbours that span at most this share of their time, weighted by their number:
  // nearly all that the samples say, in a fraction of them.
  StepSamples merged(double shareOfTime) const;

  std::size_t size() const noexcept { return t_.size(); }
  std::span<const double> timeS() const noexcept { return t_; }
  std::span<const double> values() const noexcept { return y_; }
  std::span<const double> weights() const noexcept { return w_; }  // empty: all 1

  // Weighted sums of products.
  struct Moments {
    double pp = 0, pt = 0, tt = 0, py = 0, ty = 0, yy = 0;  // phi, t, y
    double ap = 0, at = 0, ay = 0, bp = 0, bt = 0, by = 0;  // first, second derivative with them
    double aa = 0, ab = 0, bb = 0;
  };
  Moments moments(const Eigen::Vector2d& at, StepCoordinates by) const;

 private:
  struct Tail {
    double one = 0, t = 0, tt = 0, y = 0, ty = 0, yy = 0;
  };
  void sumTails();

  std::vector<double> t_, y_, w_;
  std::vector<Tail> tails_;  // over samples i..end
};

struct StepSearch {
  StepCoordinates by = StepCoordinates::kTimes;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double gain = 0.0;
  double drift = 0.0;
  double sumOfSquares = 0.0;
  bool converged = false;
  bool sameAsKnown = false;  // it ran into a minimum that is known already, and stopped
  int evaluations = 0;
};

struct StepSearchBounds {
  Eigen::Vector2d least, most;
};

// Bounded Levenberg-Marquardt. `known`: minima found before. By times it stops, not converged,
// where T1/T2 comes below 1.6: the caller goes on by damping.
StepSearch searchStep(const StepSamples& samples,
                      StepCoordinates by,
                      const Eigen::Vector2d& start,
                      const StepSearchBounds& bounds,
                      int maxIterations,
                      std::span<const StepSearch> known = {});

}  // namespace palpate
