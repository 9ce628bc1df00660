#include "calibration/step_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "calibration/overdamped_shape.h"

namespace palpate {
namespace {

// phi and t can be separated when phi differs from a straight line by more than this share of its
// sum of squares.
constexpr double kLeastStepBend = 1e-13;
// Limits of d in the search for oscillating shapes, which ends at 1; the shape from T and d is
// valid below 2.
constexpr double kLeastDamping = 0.02, kMostDamping = 1.9;
// Below this d the shape is computed from T and d, which is smooth at d = 1; above it, from T1 and
// T2.
constexpr double kStepNearlyCritical = 1.2;
constexpr double kStepTolerance = 1e-14;
// A minimum of the grid that is larger than the best one by this factor is not searched further.
constexpr double kWorthSearching = 1.5;
constexpr int kMostStepStarts = 3;
// Radius of the first step. A longer one leads from a good start to the plateau where no sample is
// within the lag.
constexpr double kFirstRadius = 10.0;
// Shortest time of the grid, as a multiple of leastT2S: half a frame.
constexpr double kShortestStart = 50.0;
// Longest time of the grid, as a share of the duration, so that the lag ends within it. Minima
// beyond describe a curved drift.
constexpr double kLongestStartShare = 0.15;
constexpr int kGridTimes = 9;
constexpr std::array kGridSecond{0.03, 0.2, 0.6, 1.0};  // q or d
constexpr int kMostRescalings = 25;
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

// The shape at all times, with derivatives by the parameters of the point, then by the coordinates.
class ShapeOfStepPlace {
 public:
  explicit ShapeOfStepPlace(const StepPlace& place)
      : place_(place), overdamped_(place.t1S, place.t2S) {}
  StepShape at(double tS) const {
    if (place_.by == StepPlace::By::kTimes) return overdamped_.at(tS);
    if (place_.by == StepPlace::By::kDamping)
      return oscillatingShape(tS, place_.parameters.timeConstantS, place_.parameters.damping);
    if (!(tS > 0.0)) return {};
    const double t1 = place_.t1S, t2 = place_.t2S, share = 1.0 / (t1 - t2);
    const double decay = share * std::exp(-tS / t1);
    return {1.0 - t1 * decay, decay, t2 * share * decay - decay * tS / t1, -t1 * share * decay};
  }
  Eigen::RowVector2d derivatives(const StepShape& shape) const {
    return Eigen::RowVector2d(shape.derivativeByFirst, shape.derivativeBySecond) * place_.chain;
  }

 private:
  const StepPlace& place_;
  OverdampedShape overdamped_;
};

// Residuals as a function of the shape alone: those of the a = K phi + m t with the smallest sum of
// squares. The component along t is removed once from the values and from phi, so that one quotient
// gives K.
class ProjectedStep {
 public:
  ProjectedStep(const StepSamples& samples, const StepSearchOptions& options)
      : samples_(samples),
        options_(options),
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
    const StepPlace place = placeAt(x[0], x[1], options_);
    const ShapeOfStepPlace shape(place);
    Eigen::MatrixX2d derivatives(size(), 2);
    for (Eigen::Index i = 0; i < size(); ++i)
      derivatives.row(i) = shape.derivatives(shape.at(samples_.timeS[static_cast<std::size_t>(i)]));
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
  StepParameters parametersAt(const Eigen::Vector2d& x) {
    StepParameters p = placeAt(x[0], x[1], options_).parameters;
    if (!project({x.data(), 2})) return p;
    p.staticResponseCounts = gain_;
    p.driftCountsPerS = drift_;
    return p;
  }
  int evaluations() const noexcept { return evaluations_; }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(samples_.timeS.size()); }
  Eigen::VectorXd withoutT(const Eigen::VectorXd& v) const { return v - unitT_.dot(v) * unitT_; }
  bool project(std::span<const double> x) {
    ++evaluations_;
    const StepPlace place = placeAt(x[0], x[1], options_);
    const ShapeOfStepPlace shape(place);
    for (Eigen::Index i = 0; i < size(); ++i)
      phi_[i] = shape.at(samples_.timeS[static_cast<std::size_t>(i)]).phi;
    const double whole = phi_.squaredNorm(), along = unitT_.dot(phi_);
    phi_ -= along * unitT_;
    const double bend = phi_.squaredNorm();
    if (!(bend > kLeastStepBend * whole)) return false;
    gain_ = phi_.dot(y_) / bend;
    const Eigen::Map<const Eigen::VectorXd> t(samples_.timeS.data(), size());
    const Eigen::Map<const Eigen::VectorXd> y(samples_.values.data(), size());
    drift_ = (unitT_.dot(y) - gain_ * along) / t.norm();
    return true;
  }

  const StepSamples& samples_;
  const StepSearchOptions& options_;
  Eigen::VectorXd unitT_, y_, phi_;
  double gain_ = 0.0, drift_ = 0.0;
  int evaluations_ = 0;
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

// Solves a problem whose last two parameters are the coordinates of the domain. The second one may
// leave the domain, where the shape continues smoothly, because Ceres is very slow along a bound. A
// solution outside is searched again on the edge of the domain.
LeastSquaresReport solveInDomain(LeastSquaresProblem& problem,
                                 const Eigen::VectorXd& start,
                                 const StepSearchOptions& options) {
  constexpr double kUnbounded = std::numeric_limits<double>::max();
  const bool oscillating = options.domain == StepDomain::kOscillating;
  const Eigen::Index last = start.size() - 1;
  problem.lowerBounds.setConstant(start.size(), -kUnbounded);
  problem.upperBounds.setConstant(start.size(), kUnbounded);
  problem.lowerBounds[last - 1] = std::log(options.leastT2S);
  problem.upperBounds[last - 1] = std::log(options.mostS);
  if (oscillating) problem.lowerBounds[last] = kLeastDamping;
  if (oscillating) problem.upperBounds[last] = kMostDamping;
  const LeastSquaresOptions solver{.maxIterations = options.maxIterations,
                                   .tolerance = kStepTolerance,
                                   .firstRadii = {kFirstRadius},
                                   .covariance = false};
  LeastSquaresReport report = solveLeastSquares(problem, start, solver);
  const double edge = std::clamp(report.x[last], oscillating ? kLeastDamping : 0.0, 1.0);
  if (edge == report.x[last]) return report;
  const Eigen::VectorXd inside = report.x.head(last);
  report = solveLeastSquares(
      withLastAt(problem, static_cast<std::size_t>(start.size()), edge), inside, solver);
  const Eigen::VectorXd found = report.x;
  report.x.resize(start.size());
  report.x << found, edge;
  return report;
}

// Returns the points of the grid that have no better neighbour, best first.
std::vector<Eigen::Vector2d> startsOf(ProjectedStep& projected,
                                      const StepSamples& samples,
                                      const StepSearchOptions& options) {
  const double shortest = std::log(kShortestStart * options.leastT2S);
  const double longest = std::log(kLongestStartShare * samples.timeS.back());
  const auto placeOf = [&](int i, int j) {
    return Eigen::Vector2d(shortest + (longest - shortest) * i / (kGridTimes - 1),
                           kGridSecond[static_cast<std::size_t>(j)]);
  };
  constexpr int kRows = static_cast<int>(kGridSecond.size());
  Eigen::ArrayXXd sums(kGridTimes, kRows);
  for (int i = 0; i < kGridTimes; ++i)
    for (int j = 0; j < kRows; ++j) sums(i, j) = projected.sumOfSquares(placeOf(i, j));
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
  if (found.size() > kMostStepStarts) found.resize(kMostStepStarts);
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
  for (const Eigen::Vector2d& start : startsOf(projected, samples, options)) {
    const LeastSquaresReport report = solveInDomain(problem, start, options);
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
  problem.residuals = [&](std::span<const double> x, std::span<double> out) {
    ++found.evaluations;
    const StepPlace place = placeAt(x[2], x[3], options);
    const ShapeOfStepPlace shape(place);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double t = samples.timeS[i];
      out[i] = samples.values[i] - x[0] * shape.at(t).phi - x[1] * t;
    }
    return true;
  };
  problem.jacobian = [&](std::span<const double> x, std::span<double> out) {
    ++found.evaluations;
    const StepPlace place = placeAt(x[2], x[3], options);
    const ShapeOfStepPlace shape(place);
    for (std::size_t i = 0; i < samples.timeS.size(); ++i) {
      const double t = samples.timeS[i];
      const StepShape at = shape.at(t);
      const Eigen::RowVector2d by = -x[0] * shape.derivatives(at);
      const std::array row{-at.phi, -t, by[0], by[1]};
      std::copy(row.begin(), row.end(), &out[4 * i]);
    }
    return true;
  };
  problem.loss = loss;
  Eigen::VectorXd x(4);
  x << found.parameters.staticResponseCounts, found.parameters.driftCountsPerS, found.at;
  std::vector<double> sizes(samples.timeS.size());
  for (int i = 0; i < kMostRescalings; ++i) {
    problem.residuals({x.data(), 4}, sizes);
    for (double& size : sizes) size = std::abs(size);
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    if (!(*middle > 0.0)) break;  // half of the samples fit exactly
    problem.lossScale = deviations * kSdPerMad * *middle;
    const LeastSquaresReport report = solveInDomain(problem, x, options);
    found.weights = report.weights;
    found.lossScale = problem.lossScale;
    found.converged = report.converged;
    const StepParameters was = found.parameters;
    found.at = report.x.tail<2>();
    found.parameters = placeAt(report.x[2], report.x[3], options).parameters;
    found.parameters.staticResponseCounts = report.x[0];
    found.parameters.driftCountsPerS = report.x[1];
    x = report.x;
    const StepParameters& is = found.parameters;
    if (std::abs(std::log(is.timeConstantS / was.timeConstantS)) +
            std::abs(std::log(is.damping / was.damping)) +
            std::abs(is.staticResponseCounts / was.staticResponseCounts - 1.0) <
        1e-7)
      break;
  }
  return found;
}

}  // namespace palpate
