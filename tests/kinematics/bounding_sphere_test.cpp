#include "palpate/kinematics/bounding_sphere.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "palpate/kinematics/hand_geometry.h"

#include "testing/sdh2.h"

namespace palpate::bounding_sphere_test {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

double farthest(const Points& points, const Vector3d& centre) {
  double squared = 0.0;
  for (const Vector3d& point : points) squared = std::max(squared, (point - centre).squaredNorm());
  return std::sqrt(squared);
}

// The sphere with its centre in the plane (line) of 2..4 points that has them all on its surface.
std::optional<Vector3d> circumcentre(const Points& on) {
  if (on.size() == 1) return on[0];
  const auto edges = static_cast<Eigen::Index>(on.size() - 1);
  Eigen::MatrixXd span(3, edges);
  for (Eigen::Index i = 0; i < edges; ++i)
    span.col(i) = on[static_cast<std::size_t>(i) + 1] - on[0];
  const Eigen::MatrixXd gram = span.transpose() * span;
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
  if (!lu.isInvertible()) return std::nullopt;
  return on[0] + span * lu.solve(gram.diagonal() / 2.0);
}

// The smallest of the spheres through all 1-, 2-, 3- and 4-subsets that enclose everything.
double bruteForceRadius(const Points& points) {
  double best = std::numeric_limits<double>::infinity();
  Points on;
  const std::function<void(std::size_t)> choose = [&](std::size_t from) {
    if (!on.empty())
      if (const auto centre = circumcentre(on)) {
        const double through = (on[0] - *centre).norm(), needed = farthest(points, *centre);
        if (needed <= through * (1.0 + 1e-9) + 1e-12) best = std::min(best, needed);
      }
    if (on.size() == 4) return;
    for (std::size_t i = from; i < points.size(); ++i) {
      on.push_back(points[i]);
      choose(i + 1);
      on.pop_back();
    }
  };
  choose(0);
  return best;
}

void expectSmallest(const Points& points, const std::string& what) {
  const auto sphere = smallestEnclosingSphere(points);
  ASSERT_TRUE(sphere.has_value()) << what;
  const double scale = 1.0 + sphere->radiusMm;
  EXPECT_NEAR(sphere->radiusMm, bruteForceRadius(points), 1e-9 * scale) << what;
  EXPECT_LE(farthest(points, sphere->centreMm), sphere->radiusMm + 1e-12 * scale) << what;
}

TEST(BoundingSphere, OfNoPointIsNothingAndOfOneIsThePoint) {
  EXPECT_FALSE(smallestEnclosingSphere({}).has_value());
  const auto one = smallestEnclosingSphere({Vector3d(1, -2, 3)});
  EXPECT_EQ(one->centreMm, Vector3d(1, -2, 3));
  EXPECT_EQ(one->radiusMm, 0.0);
  const auto same = smallestEnclosingSphere(Points(9, Vector3d(1, -2, 3)));
  EXPECT_EQ(same->centreMm, Vector3d(1, -2, 3));
  EXPECT_EQ(same->radiusMm, 0.0);
}

TEST(BoundingSphere, OfKnownBodies) {
  const auto two = smallestEnclosingSphere({Vector3d(0, 0, 0), Vector3d(0, 6, 8)});
  EXPECT_NEAR(two->radiusMm, 5.0, 1e-14);
  EXPECT_LT((two->centreMm - Vector3d(0, 3, 4)).norm(), 1e-14);
  // An obtuse triangle: the longest side alone.
  const auto obtuse =
      smallestEnclosingSphere({Vector3d(0, 0, 0), Vector3d(10, 0, 0), Vector3d(5, 1, 0)});
  EXPECT_NEAR(obtuse->radiusMm, 5.0, 1e-14);
  // A regular triangle of 66 mm: its corners are 66 / sqrt 3 from the middle.
  const double h = 33.0 * std::sqrt(3.0);
  const auto triangle =
      smallestEnclosingSphere({Vector3d(0, 0, 1), Vector3d(66, 0, 1), Vector3d(33, h, 1)});
  EXPECT_NEAR(triangle->radiusMm, 66.0 / std::sqrt(3.0), 1e-12);
  // A cube's corners, edge 2.
  Points cube;
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) cube.emplace_back(x + 100, y - 50, z + 7);
  const auto around = smallestEnclosingSphere(cube);
  EXPECT_NEAR(around->radiusMm, std::sqrt(3.0), 1e-13);
  EXPECT_LT((around->centreMm - Vector3d(100, -50, 7)).norm(), 1e-12);
}

class BoundingSphereOfRandomPoints : public ::testing::Test {
 protected:
  double normal() { return std::normal_distribution<double>()(random_); }
  int upTo(int most) { return std::uniform_int_distribution<int>(0, most)(random_); }
  Vector3d point() {
    Vector3d p;
    for (int i = 0; i < 3; ++i) p[i] = normal();
    return p;
  }
  void check(const std::string& what, int times, const std::function<Vector3d()>& next) {
    for (int i = 0; i < times; ++i) {
      offset_ = 50.0 * point();
      a_ = point();
      b_ = point();
      Points points;
      for (int n = 1 + upTo(12); n > 0; --n) points.push_back(next());
      expectSmallest(points, what + " " + std::to_string(i));
      if (HasFatalFailure()) return;
    }
  }
  std::mt19937 random_{7};
  Vector3d offset_, a_, b_;
};

TEST_F(BoundingSphereOfRandomPoints, IsTheSmallestOfAllSubsets) {
  check("random", 300, [&] { return point(); });
  check("cospherical", 300, [&]() -> Vector3d { return offset_ + 30.0 * point().normalized(); });
  check("collinear", 200, [&]() -> Vector3d { return offset_ + a_ * normal(); });
  check("coplanar", 300, [&]() -> Vector3d { return offset_ + a_ * normal() + b_ * normal(); });
  check("tiny", 200, [&]() -> Vector3d { return 1e-7 * point(); });
  check("huge", 200, [&]() -> Vector3d { return 1e7 * point(); });
  check("corners of a cube, again and again", 200, [&] {
    return Vector3d(offset_ + Vector3d(upTo(1), upTo(1), upTo(1)) * 17.0);
  });
  check("grid", 300, [&] { return Vector3d(upTo(3), upTo(3), upTo(3)); });
  check("flat grid", 600, [&] {
    return Vector3d(offset_ + Vector3d(3.4 * upTo(5), 3.4 * upTo(13), 0.0));
  });
}

// Taxels of a matrix lie on a regular grid: many on one sphere. CGAL alone, in the order they come
// in, is far off for some of these sets. A sphere can't be smaller than half the largest distance,
// nor larger than that times sqrt(3/2) (Jung).
TEST_F(BoundingSphereOfRandomPoints, HoldsForEveryPartOfAMatrix) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose({60, -20, 40, -20, 40, -20, 40});
  for (int round = 0; round < 4000; ++round) {
    const auto matrix = static_cast<std::size_t>(upTo(5));
    const int rows = geometry.description().layout.matrix(matrix).rows;
    const int y0 = upTo(rows - 1), x0 = upTo(5), y1 = y0 + upTo(rows - 1 - y0),
              x1 = x0 + upTo(5 - x0);
    Points points;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        if (upTo(9) > 0) points.push_back(pose.positionMm(matrix, y, x));
    if (points.empty()) continue;
    const auto sphere = smallestEnclosingSphere(points);
    double longest = 0.0;
    for (const Vector3d& a : points)
      for (const Vector3d& b : points) longest = std::max(longest, (a - b).norm());
    EXPECT_GE(sphere->radiusMm, longest / 2.0 - 1e-9);
    EXPECT_LE(sphere->radiusMm, longest / 2.0 * std::sqrt(1.5) + 1e-9);
    EXPECT_LE(farthest(points, sphere->centreMm), sphere->radiusMm + 1e-12);
    if (points.size() <= 12) {
      EXPECT_NEAR(sphere->radiusMm, bruteForceRadius(points), 1e-9);
    }
  }
}

TEST(BoundingSphere, RefusesWhatIsNoNumber) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int i = 0; i < 3; ++i) {
      Points points(4, Vector3d(1, 2, 3));
      points[2][i] = bad;
      EXPECT_THROW(smallestEnclosingSphere(points), std::invalid_argument);
    }
}

}  // namespace
}  // namespace palpate::bounding_sphere_test
