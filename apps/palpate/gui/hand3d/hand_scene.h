// What is to be seen of a hand in space, ready to draw: triangles, lines and points in the hand's
// base frame [mm], and how they are lit. Both ways to draw it (hand_raster.h without OpenGL,
// hand_gl.h with it) give the same picture.
#pragma once

#include <QColor>
#include <QString>
#include <array>
#include <vector>

#include <Eigen/Core>

#include "gui/hand3d/hand_camera.h"

class QPainter;

namespace palpate::gui {

struct SceneVertex {
  std::array<float, 3> positionMm{};
  // unit vector out of the surface; zero: not lit, the colour as it is
  std::array<float, 3> normal{};
  QRgb color = 0;
};

// Position and normal are numbers.
bool isFinite(const SceneVertex& vertex);

struct SceneLine {
  Eigen::Vector3f fromMm, toMm;
  float widthPx = 1.0F;
  QRgb color = 0;
};

// A disc that faces the eye.
struct ScenePoint {
  Eigen::Vector3f atMm;
  float radiusPx = 2.0F;
  QRgb color = 0;
};

// Words at a place, in front of everything.
struct SceneLabel {
  Eigen::Vector3d atMm;
  QString text;
  QColor color;
};

struct HandScene {
  // triangles, three each, counter-clockwise seen from outside; opaque
  std::vector<SceneVertex> solid;
  // the same, transparent: after what is solid, seen from both sides
  std::vector<SceneVertex> clear;
  std::vector<SceneLine> lines;    // hidden by what is solid
  std::vector<ScenePoint> points;  // the same
  std::vector<SceneLabel> labels;
  QRgb background = 0;

  void clearAll();  // keeps the memory
};

// The light stands at the eye's left shoulder and moves with it. A lit colour is
//   color * (kAmbient + kDiffuse * |n . l|), l = kTowardsLight in the eye's frame.
// (|.|: a surface seen from behind is lit as well.)
inline constexpr float kAmbient = 0.38F;
inline constexpr float kDiffuse = 0.66F;
inline const Eigen::Vector3f kTowardsLight = Eigen::Vector3f(-0.35F, 0.55F, 0.76F).normalized();
QRgb litColor(QRgb color, const Eigen::Vector3f& normal, const Eigen::Matrix3f& eyeFromBase);

// Lines and points as triangles that face the eye, in clip space, three vertices each: how both
// ways draw them. A little nearer than they are, so that what lies on a surface isn't hidden by it.
struct ClipVertex {
  std::array<float, 4> clip{};
  QRgb color = 0;
};
void appendLinesAndPoints(const HandScene& scene,
                          const HandCamera& camera,
                          const QSizeF& size,
                          std::vector<ClipVertex>& out);

// The words of a scene, over its picture.
void paintLabels(QPainter& painter,
                 const HandScene& scene,
                 const HandCamera& camera,
                 const QSizeF& size);

}  // namespace palpate::gui
