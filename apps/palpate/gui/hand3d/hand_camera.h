// From where the hand is looked at in space: an eye that circles around a point (orbit), moves
// sideways (pan), comes near (zoom). Lengths in mm in the hand's base frame (z up from the palm),
// angles in degrees.
#pragma once

#include <QPointF>
#include <QSizeF>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace palpate::gui {

struct HandCamera {
  Eigen::Vector3d targetMm{0.0, 0.0, 90.0};  // in the middle of the picture
  double azimuthDeg = -22.0;                 // where the eye stands: about z, from x towards y
  double elevationDeg = 14.0;                // above the plane of the palm, -89..89
  double distanceMm = 620.0;                 // from the target, kMinDistanceMm..kMaxDistanceMm
  double fieldDeg = 28.0;                    // angle of view from bottom to top

  static constexpr double kMinDistanceMm = 20.0;
  static constexpr double kMaxDistanceMm = 5000.0;
  // Whatever the fields hold (NaN, out of range), every function below reckons with this, which is
  // in range: what isn't a number counts as the default.
  HandCamera inRange() const;

  Eigen::Vector3d eyeMm() const;
  // Of the eye's frame (x right, y up, z from the target towards the eye), as rows: rotates base
  // into eye.
  Eigen::Matrix3d eyeFromBase() const;
  // What is nearer to the eye, or further from it, isn't drawn [mm].
  double nearMm() const;
  double farMm() const;
  // To OpenGL's clip space (x right, y up, -w <= x, y, z <= w), for a picture of that width /
  // height.
  Eigen::Matrix4d clipFromBase(double aspect) const;
  // Of a point [mm] in a picture of that size: x right, y down [px], and how far in front of the
  // eye [mm]. Nothing: beside or behind the eye.
  struct Projected {
    QPointF at;
    double depthMm = 0.0;
  };
  std::optional<Projected> project(const Eigen::Vector3d& pointMm, const QSizeF& size) const;
  // Unit vector from the eye through a point of the picture.
  Eigen::Vector3d rayAt(const QPointF& at, const QSizeF& size) const;
  // How large a mm at the target's distance is [px].
  double pxPerMm(double heightPx) const;

  // A drag of that many px turns (once around is two heights), moves sideways with the mouse, comes
  // nearer by a factor
  // (> 1), where the point `at` of the picture stays where it is.
  void orbit(const QPointF& byPx, double heightPx);
  void pan(const QPointF& byPx, double heightPx);
  void zoom(double factor, const QPointF& at, const QSizeF& size);
  // The whole of the points in the picture, looked at from where the eye is, with a margin; as far
  // as kMaxDistanceMm allows. Points that aren't numbers don't count; without any other, nothing
  // changes.
  void fit(const std::vector<Eigen::Vector3d>& pointsMm, double aspect);
  bool operator==(const HandCamera&) const = default;
};

}  // namespace palpate::gui
