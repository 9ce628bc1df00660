#include "palpate/calibration/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/QR>

namespace palpate {
namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr double kSurfaceNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMaxTerms = 12;
// Columns are dependent when they differ by less than this share of their length. Nine independent
// terms reach 1e-6.
constexpr long double kSurfaceDependent = 1e-8L;
constexpr double kWorthATerm = 1.01;
constexpr double kHullGrowth = 1.05;

double power(double base, int exponent) {
  double product = 1.0;
  for (int i = 0; i < exponent; ++i) product *= base;
  return product;
}

struct Fit {
  LongVector c;
  LongMatrix unitCovariance;
  double squares = 0.0, looSquares = 0.0;
};

// Fits the chosen columns; empty when the points do not determine them. Uses long double, because
// the nine terms of the drift are nearly dependent.
std::optional<Fit> fitTerms(std::span<const SurfacePoint> points,
                            const std::vector<SurfaceTerm>& terms,
                            std::uint32_t chosen) {
  const auto n = static_cast<Eigen::Index>(points.size());
  const auto p = static_cast<Eigen::Index>(std::popcount(chosen));
  if (n < p) return std::nullopt;
  LongMatrix columns(n, p);
  LongVector z(n);
  Eigen::Index column = 0;
  for (std::size_t term = 0; term < terms.size(); ++term) {
    if ((chosen >> term & 1U) == 0) continue;
    for (Eigen::Index i = 0; i < n; ++i) {
      const SurfacePoint& point = points[static_cast<std::size_t>(i)];
      columns(i, column) = static_cast<long double>(power(point.x, terms[term].byX) *
                                                    power(point.t, terms[term].byT));
    }
    ++column;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    z[i] = static_cast<long double>(points[static_cast<std::size_t>(i)].z);
  const LongVector size = columns.colwise().norm().transpose();
  if (!(size.minCoeff() > 0.0L)) return std::nullopt;
  for (Eigen::Index k = 0; k < p; ++k) columns.col(k) /= size[k];
  const Eigen::HouseholderQR<LongMatrix> qr(columns);
  const LongMatrix r = qr.matrixQR().topRows(p).triangularView<Eigen::Upper>();
  if (!(r.diagonal().cwiseAbs().minCoeff() > kSurfaceDependent)) return std::nullopt;
  const LongMatrix q = qr.householderQ() * LongMatrix::Identity(n, p);
  Fit fit;
  const LongVector scaled = r.triangularView<Eigen::Upper>().solve(q.transpose() * z);
  const LongVector residuals = z - columns * scaled;
  for (Eigen::Index i = 0; i < n; ++i) {
    const long double leverage = q.row(i).squaredNorm();
    const auto e = static_cast<double>(residuals[i]);
    fit.squares += e * e;
    const auto without = static_cast<double>(residuals[i] / (1.0L - leverage));
    fit.looSquares +=
        leverage < 1.0L - 1e-9L ? without * without : std::numeric_limits<double>::infinity();
  }
  const LongMatrix inverse = r.triangularView<Eigen::Upper>().solve(LongMatrix::Identity(p, p));
  fit.c = scaled.cwiseQuotient(size);
  fit.unitCovariance = (inverse * inverse.transpose()).cwiseQuotient(size * size.transpose());
  return fit;
}

// Returns the smallest subset with the constant whose leave-one-out error is within 1 % of the
// smallest error.
std::uint32_t bestSubset(std::span<const SurfacePoint> points,
                         const std::vector<SurfaceTerm>& terms) {
  const std::uint32_t all = (1U << terms.size()) - 1U;
  std::vector<std::pair<std::uint32_t, double>> tried;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t subset = 1; subset <= all; subset += 2) {  // the first term is the constant
    if (points.size() < static_cast<std::size_t>(std::popcount(subset)) + 1) continue;
    const auto fit = fitTerms(points, terms, subset);
    if (!fit || !std::isfinite(fit->looSquares)) continue;
    tried.emplace_back(subset, fit->looSquares);
    least = std::min(least, fit->looSquares);
  }
  std::uint32_t best = 0;
  double bestSquares = 0.0;
  for (const auto& [subset, squares] : tried) {
    if (squares > kWorthATerm * kWorthATerm * least) continue;
    const int fewer = std::popcount(subset) - std::popcount(best);
    if (best == 0 || fewer < 0 || (fewer == 0 && squares < bestSquares)) {
      best = subset;
      bestSquares = squares;
    }
  }
  return best;
}

double turn(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
  return (b.x - a.x) * (c.t - a.t) - (b.t - a.t) * (c.x - a.x);
}

// Convex hull (Andrew's chain), counter-clockwise; a line for data at one temperature.
std::vector<SurfacePoint> hullOf(std::vector<SurfacePoint> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x != b.x ? a.x < b.x : a.t < b.t;
  });
  std::vector<SurfacePoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = hull.size();
    for (const SurfacePoint& point : points) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0)
        hull.pop_back();
      hull.push_back({point.x, point.t, 0.0});
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

enum class HullPlace { kInside, kBelow, kOutside };  // kBelow: a larger x would be inside

HullPlace placeIn(const std::vector<SurfacePoint>& hull, double x, double t) {
  if (hull.size() < 3) {
    // With one temperature (or one gain) the hull is a line; points close to it are in range.
    if (hull.empty()) return HullPlace::kOutside;
    const auto [leastX, mostX] =
        std::minmax_element(hull.begin(), hull.end(), [](auto& a, auto& b) { return a.x < b.x; });
    const auto [leastT, mostT] =
        std::minmax_element(hull.begin(), hull.end(), [](auto& a, auto& b) { return a.t < b.t; });
    const double slackX = (kHullGrowth - 1.0) * (mostX->x - leastX->x), slackT = 2.0;
    if (!(t >= leastT->t - slackT && t <= mostT->t + slackT && x <= mostX->x + slackX))
      return HullPlace::kOutside;
    return x >= leastX->x - slackX ? HullPlace::kInside : HullPlace::kBelow;
  }
  SurfacePoint middle;
  for (const SurfacePoint& corner : hull) {
    middle.x += corner.x / static_cast<double>(hull.size());
    middle.t += corner.t / static_cast<double>(hull.size());
  }
  const SurfacePoint at{
      middle.x + (x - middle.x) / kHullGrowth, middle.t + (t - middle.t) / kHullGrowth, 0.0};
  bool inside = true, below = false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const SurfacePoint& a = hull[i];
    const SurfacePoint& b = hull[(i + 1) % hull.size()];
    if (turn(a, b, at) < 0.0) inside = false;
    // Where the hull has this t, its x is larger.
    if ((a.t <= at.t) != (b.t <= at.t))
      below = a.x + (b.x - a.x) * (at.t - a.t) / (b.t - a.t) > at.x;
  }
  if (inside) return HullPlace::kInside;
  return below ? HullPlace::kBelow : HullPlace::kOutside;
}

}  // namespace

std::vector<SurfaceTerm> surfaceTerms(int degree) {
  std::vector<SurfaceTerm> terms;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j) terms.push_back({i, j});
  return terms;
}

SurfaceEstimate Surface::at(double x, double t) const {
  SurfaceEstimate estimate;
  if (!valid) return {kSurfaceNaN, kSurfaceNaN, kSurfaceNaN, kSurfaceNaN, false, false};
  double basis[kMaxTerms] = {};
  const auto p = static_cast<Eigen::Index>(terms.size());
  for (Eigen::Index k = 0; k < p; ++k) {
    if (c[k] == 0.0) continue;
    const SurfaceTerm& term = terms[static_cast<std::size_t>(k)];
    const double powerX = power(x, term.byX), powerT = power(t, term.byT);
    basis[k] = powerX * powerT;
    estimate.value += c[k] * basis[k];
    if (term.byX > 0) estimate.byX += c[k] * term.byX * power(x, term.byX - 1) * powerT;
    if (term.byT > 0) estimate.byT += c[k] * term.byT * powerX * power(t, term.byT - 1);
  }
  double variance = residualSd * residualSd;
  for (Eigen::Index a = 0; a < p; ++a)
    if (basis[a] != 0.0)
      for (Eigen::Index b = 0; b < p; ++b) variance += basis[a] * covariance(a, b) * basis[b];
  estimate.sd = std::sqrt(std::max(variance, 0.0));
  if (std::isnan(variance)) estimate.sd = kSurfaceNaN;
  const HullPlace place = placeIn(hull, x, t);
  estimate.inRange = place == HullPlace::kInside;
  estimate.tooLight = place == HullPlace::kBelow;
  return estimate;
}

Surface fitSurface(std::span<const SurfacePoint> points,
                   const std::vector<SurfaceTerm>& terms,
                   SurfaceSelection selection) {
  if (terms.empty() || terms.size() > kMaxTerms)
    throw std::invalid_argument("fitSurface: 1 to 12 terms, not " + std::to_string(terms.size()));
  Surface surface;
  surface.terms = terms;
  const auto p = static_cast<Eigen::Index>(terms.size());
  surface.c.setZero(p);
  surface.covariance.setZero(p, p);
  std::vector<SurfacePoint> usable;
  for (const SurfacePoint& point : points)
    if (std::isfinite(point.x) && std::isfinite(point.t) && std::isfinite(point.z))
      usable.push_back(point);
  surface.numPoints = usable.size();
  if (usable.size() < points.size())
    surface.notes.push_back(std::to_string(points.size() - usable.size()) +
                            " points are not numbers: left out");
  std::uint32_t chosen = selection == SurfaceSelection::kAllTerms ? (1U << terms.size()) - 1U
                                                                  : bestSubset(usable, terms);
  const auto fit = chosen != 0 ? fitTerms(usable, terms, chosen) : std::nullopt;
  if (!fit) {
    surface.notes.push_back(
        std::to_string(usable.size()) + " points" +
        (usable.size() < terms.size() ? " are too few" : " lie on a line or repeat themselves") +
        (selection == SurfaceSelection::kAllTerms
             ? ": " + std::to_string(terms.size()) + " terms are not determined"
             : ": no surface"));
    return surface;
  }
  surface.valid = true;
  surface.numTerms = static_cast<std::size_t>(std::popcount(chosen));
  const auto n = static_cast<double>(usable.size());
  const double dof = n - static_cast<double>(surface.numTerms);
  surface.rmse = std::sqrt(fit->squares / n);
  surface.looRmse = std::sqrt(fit->looSquares / n);
  surface.residualSd = dof > 0.0 ? std::sqrt(fit->squares / dof) : kSurfaceNaN;
  if (!(dof > 0.0))
    surface.notes.push_back("as many terms as points: nothing is known about the error");
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < p; ++k)
    if ((chosen >> k & 1U) != 0) kept.push_back(k);
  const double variance = surface.residualSd * surface.residualSd;
  for (std::size_t a = 0; a < kept.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    surface.c[kept[a]] = static_cast<double>(fit->c[i]);
    for (std::size_t b = 0; b < kept.size(); ++b)
      surface.covariance(kept[a], kept[b]) =
          variance * static_cast<double>(fit->unitCovariance(i, static_cast<Eigen::Index>(b)));
  }
  surface.hull = hullOf(usable);
  return surface;
}

}  // namespace palpate
