// All taxel positions and normals of a pose, beside the textbook form: the product of 4x4 matrices
// per taxel, as the study's program does it.
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include "palpate/kinematics/hand_geometry.h"

#include "testing/sdh2.h"

namespace {

using namespace palpate;

std::vector<double> anglesOf(std::size_t i) {
  const double d = static_cast<double>(i % 100);
  return {60 + d / 10, -20 + d / 5, 40 - d / 7, -20 + d / 9, 40, -d / 3, d / 4};
}

void pose(benchmark::State& state) {
  const HandGeometry geometry(sdh2Geometry());
  HandPose out;
  std::size_t i = 0;
  for (auto _ : state) {
    geometry.pose(anglesOf(i++), out);
    benchmark::DoNotOptimize(out.positionsMm().data());
  }
}

Eigen::Matrix4d turnAboutZ(double theta) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(theta), -std::sin(theta), std::sin(theta), std::cos(theta);
  return turn;
}

void textbook4x4(benchmark::State& state) {
  const HandGeometry geometry(sdh2Geometry());
  const GeometryDescription& hand = geometry.description();
  std::vector<Eigen::Vector3d> positions(hand.layout.numCells());
  std::size_t i = 0;
  for (auto _ : state) {
    const std::vector<double> angles = anglesOf(i++);
    std::size_t place = 0;
    for (std::size_t m = 0; m < hand.surfaces.size(); ++m) {
      const SensorSurface& surface = hand.surfaces[m];
      const Finger& finger = hand.fingers[surface.place.finger];
      Eigen::Matrix4d chain = Eigen::Matrix4d::Identity();
      chain.topLeftCorner<3, 3>() = finger.baseRotation;
      chain.topRightCorner<3, 1>() = finger.baseMm;
      for (std::size_t l = 0; l <= *surface.place.link; ++l) {
        const ChainLink& link = finger.links[l];
        const double deg = (link.axis ? link.factor * angles[*link.axis] : 0.0) + link.offset;
        chain *= turnAboutZ(deg * std::numbers::pi / 180);
        chain *= link.jointFromEnd.matrix();
      }
      const MatrixLayout& layout = hand.layout.matrix(m);
      for (int y = 0; y < layout.rows; ++y)
        for (int x = 0; x < layout.columns; ++x) {
          Eigen::Matrix4d cell = Eigen::Matrix4d::Identity();
          cell(0, 3) = layout.pitchMm.x * x;
          cell(1, 3) = layout.pitchMm.y * y;
          const Eigen::Matrix4d all = chain * surface.linkFromSurface.matrix() * cell;
          positions[place++] = all.topRightCorner<3, 1>();
        }
    }
    benchmark::DoNotOptimize(positions.data());
  }
}

BENCHMARK(pose);
BENCHMARK(textbook4x4);

}  // namespace
