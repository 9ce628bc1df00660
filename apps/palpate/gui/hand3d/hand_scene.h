// The scene of a hand in 3-D, ready to draw: triangles, lines and points in the hand's base frame
// [mm], and how they are lit. hand_raster.h (without OpenGL) and hand_gl.h (with OpenGL) draw the
// same picture from it.
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
  // Unit vector out of the surface; zero: not lit, the colour stays as it is.
  std::array<float, 3> normal{};
  QRgb color = 0;
};

// Whether position and normal are numbers.
bool isFinite(const SceneVertex& vertex);

struct SceneLine {
  Eigen::Vector3f fromMm, toMm;
  float widthPx = 1.0F;
  QRgb color = 0;
};

// A point, drawn as a disc that faces the eye.
struct ScenePoint {
  Eigen::Vector3f atMm;
  float radiusPx = 2.0F;
  QRgb color = 0;
};

// A text at a place, drawn in front of everything.
struct SceneLabel {
  Eigen::Vector3d atMm;
  QString text;
  QColor color;
};

struct HandScene {
  // Opaque triangles, three vertices each, counter-clockwise seen from outside.
  std::vector<SceneVertex> solid;
  // Transparent triangles, drawn after the solid ones and visible from both sides.
  std::vector<SceneVertex> clear;
  // Lines, hidden by solid triangles in front of them.
  std::vector<SceneLine> lines;
  // Points, hidden in the same way.
  std::vector<ScenePoint> points;
  std::vector<SceneLabel> labels;
  QRgb background = 0;

  // Empties the scene but keeps its memory.
  void clearAll();
};

// The light is above and to the left of the eye and moves with it. A lit colour is
//   color * (kAmbient + kDiffuse * |n . l|), l = kTowardsLight in the eye's frame.
// (|.|: a surface seen from behind is lit as well.)
inline constexpr float kAmbient = 0.38F;
inline constexpr float kDiffuse = 0.66F;
inline const Eigen::Vector3f kTowardsLight = Eigen::Vector3f(-0.35F, 0.55F, 0.76F).normalized();
QRgb litColor(QRgb color, const Eigen::Vector3f& normal, const Eigen::Matrix3f& eyeFromBase);

// Converts lines and points into triangles that face the eye, in clip space, three vertices each;
// both ways to draw use them. They are moved a little nearer to the eye, so that the surface on
// which they lie doesn't hide them.
struct ClipVertex {
  std::array<float, 4> clip{};
  QRgb color = 0;
};
void appendLinesAndPoints(const HandScene& scene,
                          const HandCamera& camera,
                          const QSizeF& size,
                          std::vector<ClipVertex>& out);

// Paints the labels of a scene over its picture.
void paintLabels(QPainter& painter,
                 const HandScene& scene,
                 const HandCamera& camera,
                 const QSizeF& size);

}  // namespace palpate::gui
