#include "palpate/emulator/shape.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace palpate::shape_test {
namespace {

using Eigen::Vector3d;

const Shape kShapes[] = {{ShapeKind::kSphere, {60, 0, 0}},
                         {ShapeKind::kCylinder, {50, 0, 120}},
                         {ShapeKind::kBox, {40, 60, 80}},
                         {ShapeKind::kEllipsoid, {60, 50, 40}},
                         {ShapeKind::kCone, {60, 0, 80}}};

TEST(Shape, DistancesAtPlacesOneCanTell) {
  EXPECT_DOUBLE_EQ(kShapes[0].distanceMm({0, 40, 0}), 10.0);
  EXPECT_DOUBLE_EQ(kShapes[0].distanceMm({0, 0, 0}), -30.0);
  EXPECT_DOUBLE_EQ(kShapes[1].distanceMm({30, 0, 10}), 5.0);
  EXPECT_DOUBLE_EQ(kShapes[1].distanceMm({0, 0, 59}), -1.0);
  EXPECT_DOUBLE_EQ(kShapes[1].distanceMm({28, 0, 64}), 5.0) << "from the edge: 3, 4, 5";
  EXPECT_DOUBLE_EQ(kShapes[2].distanceMm({25, 0, 0}), 5.0);
  EXPECT_DOUBLE_EQ(kShapes[2].distanceMm({18, 0, 0}), -2.0);
  EXPECT_DOUBLE_EQ(kShapes[2].distanceMm({23, 34, 40}), 5.0);
  EXPECT_NEAR(kShapes[3].distanceMm({30.01, 0, 0}), 0.01, 1e-5);
  EXPECT_NEAR(kShapes[3].distanceMm({0, 0, 19.99}), -0.01, 1e-5);
  EXPECT_DOUBLE_EQ(kShapes[4].distanceMm({0, 0, 45}), 5.0) << "above the tip";
  EXPECT_DOUBLE_EQ(kShapes[4].distanceMm({0, 0, -43}), 3.0) << "below the foot";
  EXPECT_NEAR(
      kShapes[4].distanceMm({0, 0, -40 + 80.0 / 2}), -15.0 * 80.0 / std::hypot(30.0, 80.0), 1e-9)
      << "half way up, the mantle is nearest";
}

// A distance changes by d when the point moves by d along the gradient, outside and just inside.
TEST(Shape, TheGradientIsTheShortestWay) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-80.0, 80.0);
  for (const Shape& shape : kShapes) {
    int tried = 0;
    while (tried < 200) {
      const Vector3d p(place(random), place(random), place(random));
      const double d = shape.distanceMm(p);
      if (shape.kind == ShapeKind::kEllipsoid ? std::abs(d) > 0.5 : d < 0.0) continue;
      ++tried;
      const Vector3d g = shape.gradient(p);
      EXPECT_NEAR(g.norm(), 1.0, 1e-9);
      EXPECT_NEAR(
          shape.distanceMm(p - g * d), 0.0, shape.kind == ShapeKind::kEllipsoid ? 0.05 : 1e-3);
    }
  }
}

TEST(Shape, NamesAreKnownOrRefused) {
  EXPECT_EQ(shapeKind("cone"), ShapeKind::kCone);
  EXPECT_THROW(shapeKind("banana"), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::shape_test
