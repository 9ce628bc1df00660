#include "gui/hand3d/hand_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpate::gui {

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kLargestElevationDeg = 89.0;
constexpr double kLargestTargetMm = 1e6;
// Share of the picture that fit() fills.
constexpr double kFilledByFit = 0.92;
// Height that fit() shows at least, so that a sensor of a few taxels leaves room for the scale.
constexpr double kMinShownMm = 20.0;

double finiteOr(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

double tanOfHalfField(const HandCamera& camera) {
  return std::tan(0.5 * kRadPerDeg * camera.fieldDeg);
}

bool hasArea(const QSizeF& size) {
  return std::isfinite(size.width()) && std::isfinite(size.height()) && size.width() > 0.0 &&
         size.height() > 0.0;
}

// Rows: right, up, towards the eye. Computed from the angles, so that it is also valid at the
// poles.
Eigen::Matrix3d axesOf(const HandCamera& camera) {
  const double azimuth = kRadPerDeg * camera.azimuthDeg;
  const double elevation = kRadPerDeg * camera.elevationDeg;
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  Eigen::Matrix3d axes;
  axes << -sa, ca, 0.0,        //
      -se * ca, -se * sa, ce,  //
      ce * ca, ce * sa, se;
  return axes;
}

}  // namespace

HandCamera HandCamera::inRange() const {
  const HandCamera usual;
  HandCamera sane = *this;
  for (int i = 0; i < 3; ++i)
    sane.targetMm[i] =
        std::clamp(finiteOr(targetMm[i], usual.targetMm[i]), -kLargestTargetMm, kLargestTargetMm);
  sane.azimuthDeg = std::remainder(finiteOr(azimuthDeg, usual.azimuthDeg), 360.0);
  sane.elevationDeg = std::clamp(
      finiteOr(elevationDeg, usual.elevationDeg), -kLargestElevationDeg, kLargestElevationDeg);
  sane.distanceMm =
      std::clamp(finiteOr(distanceMm, usual.distanceMm), kMinDistanceMm, kMaxDistanceMm);
  sane.fieldDeg = std::clamp(finiteOr(fieldDeg, usual.fieldDeg), 1.0, 120.0);
  return sane;
}

Eigen::Vector3d HandCamera::eyeMm() const {
  const HandCamera sane = inRange();
  return sane.targetMm + sane.distanceMm * axesOf(sane).row(2).transpose();
}

Eigen::Matrix3d HandCamera::eyeFromBase() const { return axesOf(inRange()); }

double HandCamera::nearMm() const { return std::max(0.5, 0.02 * inRange().distanceMm); }

double HandCamera::farMm() const { return inRange().distanceMm + 4000.0; }

Eigen::Matrix4d HandCamera::clipFromBase(double aspect) const {
  const double sideways = std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
  const HandCamera sane = inRange();
  const Eigen::Matrix3d axes = axesOf(sane);
  Eigen::Matrix4d eyeFromBase = Eigen::Matrix4d::Identity();
  eyeFromBase.topLeftCorner<3, 3>() = axes;
  eyeFromBase.topRightCorner<3, 1>() = -axes * sane.eyeMm();
  const double scale = 1.0 / tanOfHalfField(sane);
  const double near = sane.nearMm(), far = sane.farMm();
  Eigen::Matrix4d clipFromEye = Eigen::Matrix4d::Zero();
  clipFromEye(0, 0) = scale / sideways;
  clipFromEye(1, 1) = scale;
  clipFromEye(2, 2) = (far + near) / (near - far);
  clipFromEye(2, 3) = 2.0 * far * near / (near - far);
  clipFromEye(3, 2) = -1.0;
  return clipFromEye * eyeFromBase;
}

std::optional<HandCamera::Projected> HandCamera::project(const Eigen::Vector3d& pointMm,
                                                         const QSizeF& size) const {
  if (!hasArea(size) || !pointMm.allFinite()) return std::nullopt;
  const HandCamera sane = inRange();
  const Eigen::Vector3d inEye = axesOf(sane) * (pointMm - sane.eyeMm());
  const double depth = -inEye.z();
  if (!(depth >= sane.nearMm())) return std::nullopt;
  const double pxPerSlope = 0.5 * size.height() / tanOfHalfField(sane);
  return Projected{.at = {0.5 * size.width() + pxPerSlope * inEye.x() / depth,
                          0.5 * size.height() - pxPerSlope * inEye.y() / depth},
                   .depthMm = depth};
}

Eigen::Vector3d HandCamera::rayAt(const QPointF& at, const QSizeF& size) const {
  const HandCamera sane = inRange();
  Eigen::Vector3d inEye(0.0, 0.0, -1.0);
  if (hasArea(size)) {
    const double slopePerPx = 2.0 * tanOfHalfField(sane) / size.height();
    const double half = 0.5 * size.width();
    inEye.x() = slopePerPx * (finiteOr(at.x(), half) - half);
    inEye.y() = -slopePerPx * (finiteOr(at.y(), 0.5 * size.height()) - 0.5 * size.height());
  }
  return (axesOf(sane).transpose() * inEye).normalized();
}

double HandCamera::pxPerMm(double heightPx) const {
  const HandCamera sane = inRange();
  return std::max(0.0, finiteOr(heightPx, 0.0)) / (2.0 * tanOfHalfField(sane) * sane.distanceMm);
}

void HandCamera::orbit(const QPointF& byPx, double heightPx) {
  *this = inRange();
  if (!(heightPx > 0.0) || !std::isfinite(byPx.x()) || !std::isfinite(byPx.y())) return;
  const double degPerPx = 180.0 / heightPx;
  azimuthDeg -= degPerPx * byPx.x();
  elevationDeg += degPerPx * byPx.y();
  *this = inRange();
}

void HandCamera::pan(const QPointF& byPx, double heightPx) {
  *this = inRange();
  const double scale = pxPerMm(heightPx);
  if (!(scale > 0.0) || !std::isfinite(byPx.x()) || !std::isfinite(byPx.y())) return;
  const Eigen::Matrix3d axes = axesOf(*this);
  targetMm += (axes.row(1) * byPx.y() - axes.row(0) * byPx.x()).transpose() / scale;
  *this = inRange();
}

void HandCamera::zoom(double factor, const QPointF& at, const QSizeF& size) {
  *this = inRange();
  if (!std::isfinite(factor) || !(factor > 0.0)) return;
  const double before = distanceMm;
  const double scale = hasArea(size) ? pxPerMm(size.height()) : 0.0;
  distanceMm = std::clamp(before / factor, kMinDistanceMm, kMaxDistanceMm);
  if (!(scale > 0.0) || !std::isfinite(at.x()) || !std::isfinite(at.y())) return;
  // The point of the target's plane under the mouse pointer keeps its place when its offset from
  // the target shrinks in proportion to the distance.
  const Eigen::Matrix3d axes = axesOf(*this);
  const Eigen::Vector3d offsetMm =
      (axes.row(0) * (at.x() - 0.5 * size.width()) - axes.row(1) * (at.y() - 0.5 * size.height()))
          .transpose() /
      scale;
  targetMm += offsetMm * (1.0 - distanceMm / before);
  *this = inRange();
}

// In the eye's axes (x right, y up, z towards it) an eye at (cx, cy, ez) has a point (x, y, z) in
// its picture when
//   |x - cx| <= t (ez - z), t = tangent of half the angle of view sideways;  the same for y.
// So t ez + cx >= max(x + t z) and t ez - cx >= max(t z - x): the two maxima give the smallest ez
// and the cx in the middle, separately for x and y; the larger ez is valid for both.
void HandCamera::fit(const std::vector<Eigen::Vector3d>& pointsMm, double aspect) {
  *this = inRange();
  const double sideways = std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
  const Eigen::Matrix3d axes = axesOf(*this);
  const double tangent[2] = {kFilledByFit * tanOfHalfField(*this) * sideways,
                             kFilledByFit * tanOfHalfField(*this)};
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  double upper[2] = {kNone, kNone}, lower[2] = {kNone, kNone};
  double nearest = kNone, furthest = -kNone;
  for (const Eigen::Vector3d& pointMm : pointsMm) {
    if (!pointMm.allFinite()) continue;
    const Eigen::Vector3d p = axes * pointMm;
    for (int i = 0; i < 2; ++i) {
      upper[i] = std::max(upper[i], p[i] + tangent[i] * p.z());
      lower[i] = std::max(lower[i], tangent[i] * p.z() - p[i]);
    }
    nearest = std::max(nearest, p.z());
    furthest = std::min(furthest, p.z());
  }
  if (nearest < furthest) return;
  // Keeps the nearest point in front of the near plane.
  double eye = nearest + std::max(kMinDistanceMm, 0.05 * (nearest - furthest));
  for (int i = 0; i < 2; ++i) eye = std::max(eye, 0.5 * (upper[i] + lower[i]) / tangent[i]);
  eye = std::max(eye, 0.5 * (nearest + furthest) + 0.5 * kMinShownMm / tanOfHalfField(*this));
  const Eigen::Vector3d middle(
      0.5 * (upper[0] - lower[0]), 0.5 * (upper[1] - lower[1]), 0.5 * (nearest + furthest));
  targetMm = axes.transpose() * middle;
  distanceMm = eye - middle.z();
  *this = inRange();
}

}  // namespace palpate::gui
