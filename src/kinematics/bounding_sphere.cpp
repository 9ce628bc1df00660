// The only source that includes CGAL. It uses CGAL's header-only bounding volumes with its own
// traits, so that CGAL's kernels and compiler flags are not needed.
//
// It computes in doubles and proves the result, since exact numbers take too long. The target for
// the sphere of 30 points is 5 us. It takes 1.2 us in doubles (0.8 us on a grid of 5 x 6); the same
// algorithm takes 104 us (99 us) in CGAL::Lazy_exact_nt<Gmpq>, 502 us (127 us) in CGAL::Gmpq, and
// 13 s in CGAL::Quotient<MP_Float>, which needs no GMP. CGAL's other algorithm, LP_algorithm, takes
// 623 us (401 us) and 3977 us (534 us) in the first two.
#include "palpate/kinematics/bounding_sphere.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <CGAL/Min_sphere_of_spheres_d.h>
#include <Eigen/QR>

namespace palpate {
namespace {

using Eigen::Vector3d;

struct PointTraits {
  using FT = double;
  using Sphere = Vector3d;
  using Use_square_roots = CGAL::Tag_false;
  using Algorithm = CGAL::Farthest_first_heuristic;
  using Cartesian_const_iterator = const double*;
  static const int D = 3;
  static double radius(const Sphere&) { return 0.0; }
  static const double* center_cartesian_begin(const Sphere& point) { return point.data(); }
};
using CgalSphere = CGAL::Min_sphere_of_spheres_d<PointTraits>;

constexpr double kLargestExcess = 1e-10;
constexpr int kMaxOrders = 24;

struct Candidate {
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;  // encloses all points
  double excess = 0.0;  // difference of the radius and a lower bound, as a part of the radius
};

// A lower bound for the radius. For weights w >= 0 with sum 1, every enclosing sphere has
//   radius^2 >= sum w |p|^2 - |sum w p|^2
// (the weighted variance). Both sides are equal for the smallest sphere, with the weights for which
// its centre is the weighted mean of the points on it.
double lowerBound(CgalSphere& found, const Vector3d& centre, double radius) {
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 4> system(4, 0);
  for (auto point = found.support_begin(); point != found.support_end(); ++point) {
    if (system.cols() == 4) return 0.0;
    system.conservativeResize(4, system.cols() + 1);
    system.rightCols<1>() << (*point - centre) / radius, 1.0;
  }
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> weights =
      system.colPivHouseholderQr().solve(Eigen::Vector4d::UnitW()).cwiseMax(0.0);
  const double total = weights.sum();
  if (!(total > 0.0)) return 0.0;
  weights /= total;
  const auto points = system.topRows<3>();
  const double squares = points.colwise().squaredNorm().dot(weights.transpose());
  return radius * std::sqrt(std::max(0.0, squares - (points * weights).squaredNorm()));
}

Candidate tryOrder(const std::vector<Vector3d>& points) {
  CgalSphere found(points.begin(), points.end());
  found.radius();
  Candidate candidate;
  candidate.centre = Eigen::Map<const Vector3d>(found.center_cartesian_begin());
  double squared = 0.0;
  for (const Vector3d& point : points)
    squared = std::max(squared, (point - candidate.centre).squaredNorm());
  candidate.radius = std::sqrt(squared);
  if (candidate.radius > 0.0)
    candidate.excess =
        1.0 - lowerBound(found, candidate.centre, candidate.radius) / candidate.radius;
  return candidate;
}

}  // namespace

std::optional<Sphere> smallestEnclosingSphere(const std::vector<Vector3d>& pointsMm) {
  if (pointsMm.empty()) return std::nullopt;
  Vector3d low = pointsMm.front(), high = low;
  for (const Vector3d& point : pointsMm) {
    if (!point.allFinite())
      throw std::invalid_argument("smallestEnclosingSphere: a point that is not a number");
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Vector3d middle = low + (high - low) / 2.0;
  std::vector<Vector3d> points(pointsMm);
  for (Vector3d& point : points) point -= middle;

  // With many points on one sphere (taxels of a flat matrix), CGAL's pivoting stops too early in
  // about one of a hundred cases, far from the smallest sphere. This depends on the order of the
  // points, so other orders are tried.
  Candidate best = tryOrder(points);
  std::minstd_rand order;
  for (int i = 1; i < kMaxOrders && !(best.excess <= kLargestExcess); ++i) {
    std::shuffle(points.begin(), points.end(), order);
    const Candidate next = tryOrder(points);
    if (next.excess < best.excess || !(best.excess < 1.0)) best = next;
  }
  return Sphere{best.centre + middle, best.radius};
}

}  // namespace palpate
