// Enclosing spheres beside the textbook's recursive Welzl, and all contact figures of a frame.
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include "palpate/device/sdh2.h"
#include "palpate/kinematics/contact_geometry.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_description.h"

#include "testing/sdh2.h"

namespace {

using namespace palpate;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

// As many taxels of both fingertips as asked for, in the pose of a pinch grip: what a grasp
// touches.
std::vector<Points> taxelSets(std::size_t number) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose({90, -6, 5, -90, 0, -5, 5});
  std::mt19937 random(1);
  std::vector<Points> sets(100);
  for (Points& points : sets) {
    for (const std::size_t m : {1u, 5u})
      for (std::size_t i = 0; i < number / 2; ++i)
        points.push_back(
            pose.positionMm(m, 2 + static_cast<int>(random() % 9), static_cast<int>(random() % 6)));
  }
  return sets;
}

void sphere(benchmark::State& state) {
  const auto sets = taxelSets(static_cast<std::size_t>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(smallestEnclosingSphere(sets[i++ % sets.size()]));
}

// Welzl 1991, as textbooks have it: recursion over the points, spheres through up to four of them.
Sphere through(const Points& on) {
  if (on.empty()) return {Vector3d::Zero(), -1.0};
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> span(3, on.size() - 1);
  for (std::size_t i = 1; i < on.size(); ++i)
    span.col(static_cast<Eigen::Index>(i - 1)) = on[i] - on[0];
  if (span.cols() == 0) return {on[0], 0.0};
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram =
      span.transpose() * span;
  const Vector3d toCentre = span * gram.fullPivLu().solve(gram.diagonal() / 2.0);
  return {on[0] + toCentre, toCentre.norm()};
}

Sphere welzl(const Points& points, std::size_t number, Points& on) {
  if (number == 0 || on.size() == 4) return through(on);
  const Sphere without = welzl(points, number - 1, on);
  const Vector3d& last = points[number - 1];
  if (without.radiusMm >= 0.0 && (last - without.centreMm).norm() <= without.radiusMm + 1e-9)
    return without;
  on.push_back(last);
  const Sphere with = welzl(points, number - 1, on);
  on.pop_back();
  return with;
}

void textbookWelzl(benchmark::State& state) {
  auto sets = taxelSets(static_cast<std::size_t>(state.range(0)));
  std::mt19937 random(2);
  for (Points& points : sets) std::shuffle(points.begin(), points.end(), random);
  std::size_t i = 0;
  Points on;
  for (auto _ : state) {
    const Points& points = sets[i++ % sets.size()];
    benchmark::DoNotOptimize(welzl(points, points.size(), on));
  }
}

// A pinch grip: 36 and 24 active taxels, as in the shared foam ball.
TactileFrame pinchFrame() {
  TactileFrame frame(sdh2().layout);
  for (int y = 3; y < 9; ++y)
    for (int x = 0; x < 6; ++x) {
      frame.matrix(1)(y, x) = static_cast<float>(100 + 40 * y + 10 * x);
      if (y < 7) frame.matrix(5)(y, x) = static_cast<float>(90 + 30 * y);
    }
  return frame;
}

void contact(benchmark::State& state) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose({90, -6, 5, -90, 0, -5, 5});
  const TactileFrame frame = pinchFrame();
  ContactOptions options;
  options.spheres = state.range(0) != 0;
  HandContact out;
  for (auto _ : state) {
    contactOf(frame, pose, options, out);
    benchmark::DoNotOptimize(out.sum);
  }
}

void contactOfAnEmptyFrame(benchmark::State& state) {
  const HandGeometry geometry(sdh2Geometry());
  const HandPose pose = geometry.pose({90, -6, 5, -90, 0, -5, 5});
  const TactileFrame frame(sdh2().layout);
  HandContact out;
  for (auto _ : state) {
    contactOf(frame, pose, {}, out);
    benchmark::DoNotOptimize(out.sum);
  }
}

BENCHMARK(sphere)->Arg(6)->Arg(30)->Arg(60)->Arg(200);
BENCHMARK(textbookWelzl)->Arg(6)->Arg(30)->Arg(60);
BENCHMARK(contact)->ArgName("spheres")->Arg(0)->Arg(1);
BENCHMARK(contactOfAnEmptyFrame);

}  // namespace
