// A scene like that of a hand, for tests and benchmarks of the ways to draw one: a palm, three
// fingers of rounded links, plates of taxels, a sphere that is seen through with its wires, points,
// lines and words. About 5,000 triangles, 1,000 lines.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "gui/hand3d/hand_scene.h"

namespace palpate::gui::samples {

class SceneMaker {
 public:
  HandScene scene;

  void triangle(std::vector<SceneVertex>& into,
                const std::array<Eigen::Vector3f, 3>& mm,
                const std::array<Eigen::Vector3f, 3>& normals,
                QRgb color) {
    for (std::size_t k = 0; k < 3; ++k)
      into.push_back({.positionMm = {mm[k].x(), mm[k].y(), mm[k].z()},
                      .normal = {normals[k].x(), normals[k].y(), normals[k].z()},
                      .color = color});
  }
  // Corners counter-clockwise, one normal; a zero one: not lit.
  void quad(const std::array<Eigen::Vector3f, 4>& mm, const Eigen::Vector3f& normal, QRgb color) {
    triangle(scene.solid, {mm[0], mm[1], mm[2]}, {normal, normal, normal}, color);
    triangle(scene.solid, {mm[0], mm[2], mm[3]}, {normal, normal, normal}, color);
  }
  void box(const Eigen::Vector3f& middle, const Eigen::Vector3f& half, QRgb color) {
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0F, 1.0F}) {
        const Eigen::Vector3f n = side * Eigen::Vector3f::Unit(axis);
        const Eigen::Vector3f u = Eigen::Vector3f::Unit((axis + 1) % 3), v = n.cross(u);
        const auto corner = [&](float a, float b) -> Eigen::Vector3f {
          return middle + half.cwiseProduct(n + a * u + b * v);
        };
        quad({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, n, color);
      }
  }
  // An upright rounded bar: a sphere drawn out along z.
  void ellipsoid(std::vector<SceneVertex>& into,
                 const Eigen::Vector3f& middle,
                 const Eigen::Vector3f& radii,
                 int rings,
                 QRgb color) {
    const int around = 2 * rings;
    const auto at = [&](int ring, int step) -> Eigen::Vector3f {
      const float polar =
          std::numbers::pi_v<float> * static_cast<float>(ring) / static_cast<float>(rings);
      const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(step % around) /
                         static_cast<float>(around);
      return {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
    };
    const auto add = [&](const std::array<Eigen::Vector3f, 3>& unit) {
      std::array<Eigen::Vector3f, 3> mm, normals;
      for (std::size_t k = 0; k < 3; ++k) {
        mm[k] = middle + radii.cwiseProduct(unit[k]);
        normals[k] = unit[k].cwiseQuotient(radii).normalized();
      }
      triangle(into, mm, normals, color);
    };
    for (int ring = 0; ring < rings; ++ring)
      for (int step = 0; step < around; ++step) {
        if (ring + 1 < rings) add({at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)});
        if (ring > 0) add({at(ring, step), at(ring + 1, step + 1), at(ring, step + 1)});
      }
  }
  void wires(const Eigen::Vector3f& middle, float radius, int numCircles, QRgb color) {
    constexpr int kSteps = 60;
    for (int circle = 0; circle < numCircles; ++circle) {
      const float tilt =
          std::numbers::pi_v<float> * static_cast<float>(circle) / static_cast<float>(numCircles);
      const Eigen::Vector3f u(std::cos(tilt), std::sin(tilt), 0.0F), v = Eigen::Vector3f::UnitZ();
      const auto at = [&](int step) -> Eigen::Vector3f {
        const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(step) / kSteps;
        return middle + radius * (std::cos(turn) * u + std::sin(turn) * v);
      };
      for (int step = 0; step < kSteps; ++step)
        scene.lines.push_back(
            {.fromMm = at(step), .toMm = at(step + 1), .widthPx = 1.0F, .color = color});
    }
  }
};

// Looks at it from a good place.
inline HandCamera sampleCamera() {
  HandCamera camera;
  camera.targetMm = {0.0, 0.0, 95.0};
  camera.distanceMm = 640.0;
  return camera;
}

inline HandScene sampleScene() {
  SceneMaker make;
  HandScene& scene = make.scene;
  scene.background = qRgb(30, 33, 38);
  make.box({0, 0, -12}, {55, 45, 12}, qRgb(96, 102, 112));
  for (int finger = 0; finger < 3; ++finger) {
    const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(finger) / 3.0F;
    const Eigen::Vector3f foot(42.0F * std::cos(turn), 42.0F * std::sin(turn), 0.0F);
    const Eigen::Vector3f inwards(-std::cos(turn), -std::sin(turn), 0.0F);
    const Eigen::Vector3f across = Eigen::Vector3f::UnitZ().cross(inwards);
    for (int link = 0; link < 2; ++link) {
      const Eigen::Vector3f middle = foot + Eigen::Vector3f(0, 0, link ? 125.0F : 45.0F);
      make.ellipsoid(scene.solid, middle, {15, 15, 44}, 14, qRgb(170, 176, 184));
      // 14 x 6 taxels of 3.4 mm on a plate before it, each a colour of its own.
      const Eigen::Vector3f plate = middle + 16.0F * inwards;
      for (int row = 0; row < 14; ++row)
        for (int column = 0; column < 6; ++column) {
          const auto corner = [&](float a, float b) -> Eigen::Vector3f {
            return plate + across * (3.4F * (static_cast<float>(column) - 2.5F) + a) +
                   Eigen::Vector3f::UnitZ() * (3.4F * (static_cast<float>(row) - 6.5F) + b);
          };
          const QRgb color = qRgb(40 + 15 * row, 30 + 30 * column, 160 - 9 * row);
          make.quad(
              {corner(-1.5F, -1.5F), corner(1.5F, -1.5F), corner(1.5F, 1.5F), corner(-1.5F, 1.5F)},
              Eigen::Vector3f::Zero(),
              color);
        }
      scene.lines.push_back({.fromMm = plate,
                             .toMm = plate + 25.0F * inwards,
                             .widthPx = 2.0F,
                             .color = qRgb(255, 214, 10)});
      scene.points.push_back({.atMm = plate, .radiusPx = 5.0F, .color = qRgb(255, 90, 60)});
      scene.labels.push_back({plate.cast<double>(), "finger", QColor(235, 238, 242)});
    }
  }
  const Eigen::Vector3f ball(0, 0, 110);
  make.ellipsoid(scene.clear, ball, {30, 30, 30}, 14, qRgba(90, 180, 255, 70));
  make.wires(ball, 30.0F, 12, qRgb(120, 190, 250));
  // A grid on the table.
  for (int i = -10; i <= 10; ++i) {
    const auto at = 12.0F * static_cast<float>(i);
    for (int piece = 0; piece < 6; ++piece) {
      const float from = -120.0F + 40.0F * static_cast<float>(piece), to = from + 40.0F;
      scene.lines.push_back(
          {.fromMm = {at, from, -25}, .toMm = {at, to, -25}, .color = qRgb(70, 76, 86)});
      scene.lines.push_back(
          {.fromMm = {from, at, -25}, .toMm = {to, at, -25}, .color = qRgb(70, 76, 86)});
    }
  }
  return std::move(scene);
}

}  // namespace palpate::gui::samples
