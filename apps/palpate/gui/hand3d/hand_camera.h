// The camera of the hand in 3-D: an eye that circles around a target (orbit), moves sideways
// (pan) and comes nearer (zoom). Lengths in mm in the hand's base frame (z up from the palm),
// angles in degrees.
#pragma once

#include <QPointF>
#include <QSizeF>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace palpate::gui {

struct HandCamera {
  // The point in the middle of the picture.
  Eigen::Vector3d targetMm{0.0, 0.0, 90.0};
  // Direction of the eye about z, from x towards y.
  double azimuthDeg = -22.0;
  // Above the plane of the palm, -89..89.
  double elevationDeg = 14.0;
  // From the target, kMinDistanceMm..kMaxDistanceMm.
  double distanceMm = 620.0;
  // Angle of view from bottom to top.
  double fieldDeg = 28.0;

  static constexpr double kMinDistanceMm = 20.0;
  static constexpr double kMaxDistanceMm = 5000.0;
  // Returns the camera with all fields in range; a value that isn't a number becomes the default.
  // All functions below compute with it.
  HandCamera inRange() const;

  Eigen::Vector3d eyeMm() const;
  // Rotation from the base frame into the eye's frame; its rows are the eye's axes (x right, y up,
  // z from the target towards the eye).
  Eigen::Matrix3d eyeFromBase() const;
  // Distances of the near and far clipping plane from the eye [mm].
  double nearMm() const;
  double farMm() const;
  // Transform into OpenGL's clip space (x right, y up, -w <= x, y, z <= w), for a picture with
  // aspect = width / height.
  Eigen::Matrix4d clipFromBase(double aspect) const;
  // A point projected into a picture: x right, y down [px], and its distance in front of the eye
  // [mm]. Nothing: the point is beside or behind the eye.
  struct Projected {
    QPointF at;
    double depthMm = 0.0;
  };
  std::optional<Projected> project(const Eigen::Vector3d& pointMm, const QSizeF& size) const;
  // Unit vector from the eye through a point of the picture.
  Eigen::Vector3d rayAt(const QPointF& at, const QSizeF& size) const;
  // Size of a millimetre at the target's distance [px].
  double pxPerMm(double heightPx) const;

  // A drag by so many px turns the camera (two heights are a full turn) or moves it sideways with
  // the mouse; zoom() comes nearer by a factor (> 1), while the point `at` of the picture keeps its
  // place.
  void orbit(const QPointF& byPx, double heightPx);
  void pan(const QPointF& byPx, double heightPx);
  void zoom(double factor, const QPointF& at, const QSizeF& size);
  // Moves the camera, without turning it, so that all points are in the picture with a margin, as
  // far as kMaxDistanceMm allows. Points that aren't numbers are ignored; without any other,
  // nothing changes.
  void fit(const std::vector<Eigen::Vector3d>& pointsMm, double aspect);
  bool operator==(const HandCamera&) const = default;
};

}  // namespace palpate::gui
