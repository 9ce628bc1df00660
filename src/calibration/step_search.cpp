#include "calibration/step_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "palpate/core/statistics.h"

#include "calibration/overdamped_shape.h"

namespace palpate {
namespace {

// phi and t can be separated when phi differs from a straight line by more than this share of its
// sum of squares.
constexpr double kMinStepBend = 1e-13;
// Limits of d in the search for oscillating shapes, which ends at 1; the shape from T and d is
// valid below 2.
constexpr double kMinDamping = 0.02, kMaxDamping = 1.9;
// Below this d the shape is computed from T and d, which is smooth at d = 1; above it, from T1 and
// T2.
constexpr double kStepNearlyCritical = 1.2;
constexpr double kStepTolerance = 1e-14;
// A minimum of the grid that is larger than the best one by this factor is not searched further.
constexpr double kWorthSearching = 1.5;
constexpr int kMaxStepStarts = 3;
// Radius of the first step. A longer one leads from a good start to the plateau where no sample is
// within the lag.
constexpr double kFirstRadius = 10.0;
// Shortest time of the grid, as a multiple of leastT2S: half a frame.
constexpr double kShortestStart = 50.0;
// Longest time of the grid, as a share of the duration, so that the lag ends within it. Minima
// beyond describe a curved drift.
constexpr double kLongestStartShare = 0.15;
constexpr int kGridTimes = 9;
// Longer times, as shares of the duration: no starts, but alternatives.
constexpr std::array kLongTimeShares{0.3, 0.5};
constexpr std::array kGridSecond{0.03, 0.2, 0.6, 1.0};  // q or d
// The scale of a robust loss is updated from roughly solved minima until it changes by less than
// kNearlySettled, then from exact ones until it changes by less than kScaleSettled. It settles
// within 12 updates, and within 40 where a quarter of the samples are outliers.
constexpr int kMaxRescalings = 100;
constexpr double kRoughTolerance = 1e-6;
constexpr double kNearlySettled = 1e-4, kScaleSettled = 1e-7;
// Radius of the first step from the minimum of another scale.
constexpr double kWarmRadius = 1e6;
constexpr double kSdPerMad = 1.4826;

// A point of a domain: its shape, and the derivatives of the shape's parameters by the coordinates.
struct StepPlace {
  enum class By {
    kDamping,  // T and d, smooth at d = 1: log T, d
    kTimes,    // T1 and T2: log T2, log(T1/T2 - 1)
    // The continuation to q < 0, where T2 would be far below every sample's time: T1, T2.
    kFast,
  };
  StepParameters parameters;
  By by = By::kDamping;
  double t1S = 1.0, t2S = 1.0;
  Eigen::Matrix2d chain = Eigen::Matrix2d::Identity();
};

StepPlace placeAt(double first, double second, const StepSearchOptions& options) {
  StepPlace place;
  if (options.domain == StepDomain::kOscillating) {
    place.parameters = {0.0, 0.0, std::exp(first), second};
    return place;
  }
  const double m = std::exp(first), least = options.leastT2S;
  const double mean = m + least;                                            // (T1 + T2) / 2
  const double product = m * m * second + 2.0 * m * least + least * least;  // T1 T2
  const double t = std::sqrt(product), d = mean / t;
  place.parameters = {0.0, 0.0, t, second <= 1.0 ? std::max(d, 1.0) : d};
  if (second >= 0.0 && d < kStepNearlyCritical) {
    const double logTByFirst = m * (m * second + least) / product;
    const double logTBySecond = 0.5 * m * m / product;
    place.chain << logTByFirst, logTBySecond, m / t - d * logTByFirst, -d * logTBySecond;
    return place;
  }
  const double root = std::sqrt(1.0 - second);
  place.t1S = mean + m * root;
  place.t2S = least + m * second / (1.0 + root);
  const double t2ByFirst = m * second / (1.0 + root), t2BySecond = 0.5 * m / root;
  if (second < 0.0) {
    place.by = StepPlace::By::kFast;
    place.chain << m * (1.0 + root), -t2BySecond, t2ByFirst, t2BySecond;
    return place;
  }
  place.by = StepPlace::By::kTimes;
  place.chain << t2ByFirst / place.t2S, t2BySecond / place.t2S, 1.0 - t2ByFirst / place.t2S,
      -0.5 / (1.0 - second) - t2BySecond / place.t2S;
  return place;
}

// The shapes of a point at all times. They are computed once for the residuals and the derivatives,
// which are asked for at the same point.
class ShapesOfStepPlace {
 public:
  ShapesOfStepPlace(std::span<const double> timeS, const StepSearchOptions& options)
      : timeS_(timeS), options_(options), shapes_(timeS.size()) {}

  // Returns whether the point is another one than before.
  bool moveTo(double first, double second) {
    if (first == first_ && second == second_) return false;
    first_ = first;
    second_ = second;
    place_ = placeAt(first, second, options_);
    const OverdampedShape overdamped(place_.t1S, place_.t2S);
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      shapes_[i] =
          place_.by == StepPlace::By::kTimes ? overdamped.at(timeS_[i]) : shapeAt(timeS_[i]);
    ++evaluations_;
    return true;
  }
  const StepPlace& place() const noexcept { return place_; }
  // Their derivatives are those by the parameters of the point; place().chain leads to those by the
  // coordinates.
  const std::vector<StepShape>& shapes() const noexcept { return shapes_; }
  int evaluations() const noexcept { return evaluations_; }

 private:
  StepShape shapeAt(double tS) const {
    if (place_.by == StepPlace::By::kDamping)
      return oscillatingShape(tS, place_.parameters.timeConstantS, place_.parameters.damping);
    if (!(tS > 0.0)) return {};
    const double t1 = place_.t1S, t2 = place_.t2S, share = 1.0 / (t1 - t2);
    const double decay = share * std::exp(-tS / t1);
    return {1.0 - t1 * decay, decay, t2 * share * decay - decay * tS / t1, -t1 * share * decay};
  }

  std::span<const double> timeS_;
  const StepSearchOptions& options_;
  double first_ = std::numeric_limits<double>::quiet_NaN(), second_ = first_;
  StepPlace place_;
  std::vector<StepShape> shapes_;
  int evaluations_ = 0;
};

// Residuals as a function of the shape alone: those of the a = K phi + m t with the smallest sum of
// squares. The component along t is removed once from the values and from phi, so that one quotient
// gives K.
class ProjectedStep {
 public:
  ProjectedStep(const StepSamples& samples, const StepSearchOptions& options)
      : samples_(samples),
        shapes_(samples.timeS, options),
        unitT_(Eigen::Map<const Eigen::VectorXd>(samples.timeS.data(), size()).normalized()),
        y_(withoutT(Eigen::Map<const Eigen::VectorXd>(samples.values.data(), size()))),
        phi_(size()) {}

  bool residuals(std::span<const double> x, std::span<double> out) {
    const bool defined = project(x);
    if (defined) Eigen::Map<Eigen::VectorXd>(out.data(), size()) = y_ - gain_ * phi_;
    return defined;
  }
  bool jacobian(std::span<const double> x, std::span<double> out) {
    if (!project(x)) return false;
    Eigen::MatrixX2d derivatives(size(), 2);
    for (Eigen::Index i = 0; i < size(); ++i) {
      const StepShape& shape = shapes_.shapes()[static_cast<std::size_t>(i)];
      derivatives.row(i) << shape.derivativeByFirst, shape.derivativeBySecond;
    }
    derivatives *= shapes_.place().chain;
    const Eigen::VectorXd residual = y_ - gain_ * phi_;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>> all(
        out.data(), size(), 2);
    for (int j = 0; j < 2; ++j) {
      const Eigen::VectorXd one = withoutT(derivatives.col(j));
      const double gainBy = (one.dot(residual) - gain_ * one.dot(phi_)) / phi_.squaredNorm();
      all.col(j) = -gain_ * one - gainBy * phi_;
    }
    return all.allFinite();
  }
  // Returns infinity where K and m cannot be separated.
  double sumOfSquares(const Eigen::Vector2d& x) {
    return project({x.data(), 2}) ? (y_ - gain_ * phi_).squaredNorm()
                                  : std::numeric_limits<double>::infinity();
  }
  // The point at which the last sum was computed.
  StepAlternative alternative(double sumOfSquares) const {
    return {sumOfSquares, gain_, drift_, shapes_.shapes().back().phi};
  }
  StepParameters parametersAt(const Eigen::Vector2d& x) {
    const bool defined = project({x.data(), 2});
    StepParameters p = shapes_.place().parameters;
    if (!defined) return p;
    p.staticResponseCounts = gain_;
    p.driftCountsPerS = drift_;
    return p;
  }
  int evaluations() const noexcept { return shapes_.evaluations(); }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(samples_.timeS.size()); }
  Eigen::VectorXd withoutT(const Eigen::VectorXd& v) const { return v - unitT_.dot(v) * unitT_; }
  bool project(std::span<const double> x) {
    if (!shapes_.moveTo(x[0], x[1])) return defined_;
    for (Eigen::Index i = 0; i < size(); ++i)
      phi_[i] = shapes_.shapes()[static_cast<std::size_t>(i)].phi;
    const double whole = phi_.squaredNorm(), along = unitT_.dot(phi_);
    phi_ -= along * unitT_;
    const double bend = phi_.squaredNorm();
    defined_ = bend > kMinStepBend * whole;
    if (!defined_) return false;
    gain_ = phi_.dot(y_) / bend;
    const Eigen::Map<const Eigen::VectorXd> t(samples_.timeS.data(), size());
    const Eigen::Map<const Eigen::VectorXd> y(samples_.values.data(), size());
    drift_ = (unitT_.dot(y) - gain_ * along) / t.norm();
    return true;
  }

  const StepSamples& samples_;
  ShapesOfStepPlace shapes_;
  Eigen::VectorXd unitT_, y_, phi_;
  double gain_ = 0.0, drift_ = 0.0;
  bool defined_ = false;
};

// Returns the problem with its last parameter fixed at a value.
LeastSquaresProblem withLastAt(const LeastSquaresProblem& problem, std::size_t size, double value) {
  LeastSquaresProblem fewer = problem;
  const auto whole = [size, value](std::span<const double> x) {
    std::vector<double> all(x.begin(), x.end());
    all.resize(size, value);
    return all;
  };
  fewer.residuals = [&problem, whole](std::span<const double> x, std::span<double> out) {
    return problem.residuals(whole(x), out);
  };
  fewer.jacobian = [&problem, whole, size](std::span<const double> x, std::span<double> out) {
    std::vector<double> all(problem.numResiduals * size);
    if (!problem.jacobian(whole(x), all)) return false;
    for (std::size_t i = 0; i < problem.numResiduals; ++i)
      std::copy_n(&all[i * size], size - 1, &out[i * (size - 1)]);
    return true;
  };
  const auto last = static_cast<Eigen::Index>(size - 1);
  fewer.lowerBounds = Eigen::VectorXd(problem.lowerBounds.head(last));
  fewer.upperBounds = Eigen::VectorXd(problem.upperBounds.head(last));
  return fewer;
}

// Whether the sum of the loss falls when the last parameter of a report grows (1), when it becomes
// smaller (-1), or neither (0).
int fallsAlongLast(const LeastSquaresProblem& problem, const LeastSquaresReport& report) {
  const std::size_t n = problem.numResiduals, p = static_cast<std::size_t>(report.x.size());
  std::vector<double> residuals(n), jacobian(n * p);
  const std::span<const double> at(report.x.data(), p);
  if (!problem.residuals(at, residuals) || !problem.jacobian(at, jacobian)) return 0;
  double slope = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    slope += report.weights[i] * residuals[i] * jacobian[i * p + p - 1];
  return slope < 0.0 ? 1 : slope > 0.0 ? -1 : 0;
}

// Solves a problem whose last two parameters are the coordinates of the domain. The second one may
// leave the domain, where the shape continues smoothly, because Ceres is very slow along a bound. A
// solution outside is searched again on the edge of the domain. A start on an edge is first
// searched along it, and the result is kept unless the sum falls towards the inside.
LeastSquaresReport solveInDomain(LeastSquaresProblem& problem,
                                 const Eigen::VectorXd& start,
                                 const StepSearchOptions& options,
                                 double tolerance,
                                 double radius) {
  constexpr double kUnbounded = std::numeric_limits<double>::max();
  const bool oscillating = options.domain == StepDomain::kOscillating;
  const double low = oscillating ? kMinDamping : 0.0, high = 1.0;
  const Eigen::Index last = start.size() - 1;
  problem.lowerBounds.setConstant(start.size(), -kUnbounded);
  problem.upperBounds.setConstant(start.size(), kUnbounded);
  problem.lowerBounds[last - 1] = std::log(options.leastT2S);
  problem.upperBounds[last - 1] = std::log(options.mostS);
  if (oscillating) problem.lowerBounds[last] = kMinDamping;
  if (oscillating) problem.upperBounds[last] = kMaxDamping;
  const LeastSquaresOptions solver{.maxIterations = options.maxIterations,
                                   .tolerance = tolerance,
                                   .firstRadii = {radius},
                                   .covariance = false};
  const auto onEdge = [&](const Eigen::VectorXd& from, double edge) {
    const Eigen::VectorXd along = from.head(last);
    LeastSquaresReport report = solveLeastSquares(
        withLastAt(problem, static_cast<std::size_t>(start.size()), edge), along, solver);
    const Eigen::VectorXd found = report.x;
    report.x.resize(start.size());
    report.x << found, edge;
    return report;
  };
  if (start[last] == low || start[last] == high) {
    const LeastSquaresReport held = onEdge(start, start[last]);
    const int inwards = start[last] == low ? 1 : -1;
    if (!held.weights.empty() && fallsAlongLast(problem, held) != inwards) return held;
  }
  const LeastSquaresReport report = solveLeastSquares(problem, start, solver);
  const double edge = std::clamp(report.x[last], low, high);
  return edge == report.x[last] ? report : onEdge(report.x, edge);
}

// Returns the points of the grid that have no better neighbour, best first; writes all points to
// `alternatives`.
std::vector<Eigen::Vector2d> startsOf(ProjectedStep& projected,
                                      const StepSamples& samples,
                                      const StepSearchOptions& options,
                                      std::vector<StepAlternative>& alternatives) {
  const double shortest = std::log(kShortestStart * options.leastT2S);
  const double longest = std::log(kLongestStartShare * samples.timeS.back());
  const auto placeOf = [&](int i, int j) {
    return Eigen::Vector2d(shortest + (longest - shortest) * i / (kGridTimes - 1),
                           kGridSecond[static_cast<std::size_t>(j)]);
  };
  constexpr int kRows = static_cast<int>(kGridSecond.size());
  Eigen::ArrayXXd sums(kGridTimes, kRows);
  const auto sumAt = [&](const Eigen::Vector2d& x) {
    const double sum = projected.sumOfSquares(x);
    if (std::isfinite(sum)) alternatives.push_back(projected.alternative(sum));
    return sum;
  };
  for (int i = 0; i < kGridTimes; ++i)
    for (int j = 0; j < kRows; ++j) sums(i, j) = sumAt(placeOf(i, j));
  for (const double share : kLongTimeShares)
    for (const double second : kGridSecond) sumAt({std::log(share * samples.timeS.back()), second});
  const double best = sums.minCoeff();
  std::vector<std::pair<double, Eigen::Vector2d>> found;
  for (int i = 0; i < kGridTimes; ++i)
    for (int j = 0; j < kRows; ++j) {
      const int left = std::max(i - 1, 0), top = std::max(j - 1, 0);
      const double least =
          sums.block(left, top, std::min(i + 2, kGridTimes) - left, std::min(j + 2, kRows) - top)
              .minCoeff();
      if (std::isfinite(sums(i, j)) && sums(i, j) <= least && sums(i, j) <= kWorthSearching * best)
        found.emplace_back(sums(i, j), placeOf(i, j));
    }
  std::stable_sort(
      found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (found.size() > kMaxStepStarts) found.resize(kMaxStepStarts);
  std::vector<Eigen::Vector2d> starts;
  for (const auto& one : found) starts.push_back(one.second);
  return starts;
}

}  // namespace

StepMinimum searchStep(const StepSamples& samples, const StepSearchOptions& options) {
  ProjectedStep projected(samples, options);
  LeastSquaresProblem problem;
  problem.numResiduals = samples.timeS.size();
  problem.residuals = [&](auto x, auto out) { return projected.residuals(x, out); };
  problem.jacobian = [&](auto x, auto out) { return projected.jacobian(x, out); };
  StepMinimum best;
  best.sumOfSquares = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& start : startsOf(projected, samples, options, best.alternatives)) {
    const LeastSquaresReport report =
        solveInDomain(problem, start, options, kStepTolerance, kFirstRadius);
    if (!(report.sumOfSquares < best.sumOfSquares)) continue;
    best.at = report.x;
    best.parameters = projected.parametersAt(report.x);
    best.sumOfSquares = report.sumOfSquares;
    best.converged = report.converged;
  }
  best.evaluations = projected.evaluations();
  return best;
}

StepMinimum searchRobustStep(const StepSamples& samples,
                             const StepSearchOptions& options,
                             const StepMinimum& start,
                             LeastSquaresLoss loss,
                             double deviations) {
  StepMinimum found = start;
  // The parameters are K, m and the two coordinates.
  LeastSquaresProblem problem;
  problem.numResiduals = samples.timeS.size();
  ShapesOfStepPlace shapes(samples.timeS, options);
  problem.residuals = [&](std::span<const double> x, std::span<double> out) {
    shapes.moveTo(x[2], x[3]);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = samples.values[i] - x[0] * shapes.shapes()[i].phi - x[1] * samples.timeS[i];
    return true;
  };
  problem.jacobian = [&](std::span<const double> x, std::span<double> out) {
    shapes.moveTo(x[2], x[3]);
    const Eigen::Matrix2d chain = -x[0] * shapes.place().chain;
    for (std::size_t i = 0; i < samples.timeS.size(); ++i) {
      const StepShape& shape = shapes.shapes()[i];
      const Eigen::RowVector2d by =
          Eigen::RowVector2d(shape.derivativeByFirst, shape.derivativeBySecond) * chain;
      const std::array row{-shape.phi, -samples.timeS[i], by[0], by[1]};
      std::copy(row.begin(), row.end(), &out[4 * i]);
    }
    return true;
  };
  problem.loss = loss;
  std::vector<double> sizes(samples.timeS.size());
  const auto scaleAt = [&](const Eigen::VectorXd& x) {
    problem.residuals({x.data(), 4}, sizes);
    for (double& size : sizes) size = std::abs(size);
    return deviations * kSdPerMad * upperMedian(std::span(sizes));
  };
  Eigen::VectorXd x(4);
  x << found.parameters.staticResponseCounts, found.parameters.driftCountsPerS, found.at;
  double scale = scaleAt(x);
  bool fine = false, settled = false;
  // The scale is 0 when half of the samples fit exactly.
  for (int i = 0; i < kMaxRescalings && !settled && scale > 0.0; ++i) {
    problem.lossScale = scale;
    const LeastSquaresReport report = solveInDomain(problem,
                                                    x,
                                                    options,
                                                    fine ? kStepTolerance : kRoughTolerance,
                                                    i == 0 ? kFirstRadius : kWarmRadius);
    x = report.x;
    found.weights = report.weights;
    found.lossScale = scale;
    found.sumOfSquares = report.sumOfSquares;
    found.converged = report.converged;
    if (!report.converged) break;
    scale = scaleAt(x);
    const double moved = std::abs(scale / found.lossScale - 1.0);
    settled = fine && moved < kScaleSettled;
    fine = fine || moved < kNearlySettled;
  }
  found.converged = found.converged && (settled || !(scale > 0.0));
  found.at = x.tail<2>();
  found.parameters = placeAt(x[2], x[3], options).parameters;
  found.parameters.staticResponseCounts = x[0];
  found.parameters.driftCountsPerS = x[1];
  found.evaluations += shapes.evaluations();
  return found;
}

}  // namespace palpate
