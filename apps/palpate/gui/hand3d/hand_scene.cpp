#include "gui/hand3d/hand_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::gui {

namespace {

// Lines and points are drawn nearer to the eye by at most this share of their depth.
constexpr double kMaxNearer = 0.05;

int litChannel(int value, float light) {
  return std::clamp(static_cast<int>(static_cast<float>(value) * light + 0.5F), 0, 255);
}

// Transforms from the base frame to the eye's frame, and from there to pixels and clip space.
class Eye {
 public:
  Eye(const HandCamera& camera, const QSizeF& size)
      : axes_(camera.eyeFromBase()),
        eyeMm_(camera.eyeMm()),
        // Doubled, because what is moved nearer must still be behind the near plane.
        nearMm_(2.0 * kMaxNearer * camera.nearMm() + camera.nearMm()),
        mmPerPxAndMm_(2.0 * std::tan(camera.inRange().fieldDeg * std::numbers::pi / 360.0) /
                      size.height()),
        clipPerEyeX_(2.0 / (mmPerPxAndMm_ * size.width())),
        clipPerEyeY_(2.0 / (mmPerPxAndMm_ * size.height())),
        clipPerPxX_(2.0 / size.width()),
        clipPerPxY_(2.0 / size.height()) {
    const double near = camera.nearMm(), far = camera.farMm();
    depthScale_ = (far + near) / (near - far);
    depthOffset_ = 2.0 * far * near / (near - far);
  }

  Eigen::Vector3d operator()(const Eigen::Vector3f& mm) const {
    return axes_ * (mm.cast<double>() - eyeMm_);
  }
  bool inFront(const Eigen::Vector3d& inEye) const { return -inEye.z() >= nearMm_; }
  double nearMm() const { return nearMm_; }
  // Moves a point nearer to the eye by `px` plus one pixel, so that a shape that extends `px` to
  // all sides isn't hidden by the surface on which it lies, up to a slope of 45 degrees.
  Eigen::Vector3d nearer(const Eigen::Vector3d& inEye, double px) const {
    return inEye * (1.0 - std::min(kMaxNearer, (px + 1.0) * mmPerPxAndMm_));
  }
  // Position in the picture from its middle, x right, y up [px].
  Eigen::Vector2d px(const Eigen::Vector3d& inEye) const {
    return inEye.head<2>() / (-inEye.z() * mmPerPxAndMm_);
  }
  ClipVertex clip(const Eigen::Vector3d& inEye, const Eigen::Vector2d& byPx, QRgb color) const {
    const double w = -inEye.z();
    return {.clip = {static_cast<float>(inEye.x() * clipPerEyeX_ + byPx.x() * clipPerPxX_ * w),
                     static_cast<float>(inEye.y() * clipPerEyeY_ + byPx.y() * clipPerPxY_ * w),
                     static_cast<float>(depthScale_ * inEye.z() + depthOffset_),
                     static_cast<float>(w)},
            .color = color};
  }

 private:
  Eigen::Matrix3d axes_;
  Eigen::Vector3d eyeMm_;
  double nearMm_ = 0.0;
  // Width of a pixel per mm of depth.
  double mmPerPxAndMm_ = 0.0;
  double clipPerEyeX_, clipPerEyeY_;
  double clipPerPxX_, clipPerPxY_;
  double depthScale_ = 0.0, depthOffset_ = 0.0;
};

// Shortens a line to its part in front of the eye; false: it has none.
bool cutBehind(const Eye& eye, Eigen::Vector3d& from, Eigen::Vector3d& to) {
  if (!eye.inFront(from) && !eye.inFront(to)) return false;
  const auto onPlane = [&](const Eigen::Vector3d& behind, const Eigen::Vector3d& front) {
    const double part = (-eye.nearMm() - front.z()) / (behind.z() - front.z());
    Eigen::Vector3d cut = front + part * (behind - front);
    cut.z() = -eye.nearMm();
    return cut;
  };
  if (!eye.inFront(from))
    from = onPlane(from, to);
  else if (!eye.inFront(to))
    to = onPlane(to, from);
  return true;
}

void appendLine(const Eye& eye, const SceneLine& line, std::vector<ClipVertex>& out) {
  if (!line.fromMm.allFinite() || !line.toMm.allFinite() || !(line.widthPx > 0.0F)) return;
  Eigen::Vector3d from = eye(line.fromMm), to = eye(line.toMm);
  if (!cutBehind(eye, from, to)) return;
  const double half = 0.5 * std::min(static_cast<double>(line.widthPx), 1000.0);
  from = eye.nearer(from, half);
  to = eye.nearer(to, half);
  // Longer by half a width at both ends, so that joined lines show no notch.
  Eigen::Vector2d along = eye.px(to) - eye.px(from);
  const double length = along.norm();
  along = length > 1e-9 ? Eigen::Vector2d(along * (half / length)) : Eigen::Vector2d(half, 0.0);
  const Eigen::Vector2d across(-along.y(), along.x());
  const ClipVertex a = eye.clip(from, -along - across, line.color);
  const ClipVertex b = eye.clip(to, along - across, line.color);
  const ClipVertex c = eye.clip(to, along + across, line.color);
  const ClipVertex d = eye.clip(from, -along + across, line.color);
  out.insert(out.end(), {a, b, c, a, c, d});
}

void appendPoint(const Eye& eye, const ScenePoint& point, std::vector<ClipVertex>& out) {
  if (!point.atMm.allFinite() || !(point.radiusPx > 0.0F)) return;
  const Eigen::Vector3d inEye = eye(point.atMm);
  if (!eye.inFront(inEye)) return;
  const double radius = std::min(static_cast<double>(point.radiusPx), 1000.0);
  const Eigen::Vector3d at = eye.nearer(inEye, radius);
  const int corners = std::clamp(static_cast<int>(std::ceil(2.0 * radius)) + 6, 8, 48);
  const ClipVertex middle = eye.clip(at, {0.0, 0.0}, point.color);
  const auto corner = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * (i % corners) / corners;
    return eye.clip(at, radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), point.color);
  };
  ClipVertex before = corner(0);
  for (int i = 1; i <= corners; ++i) {
    const ClipVertex next = corner(i);
    out.insert(out.end(), {middle, before, next});
    before = next;
  }
}

}  // namespace

bool isFinite(const SceneVertex& vertex) {
  const auto& p = vertex.positionMm;
  const auto& n = vertex.normal;
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) && std::isfinite(n[0]) &&
         std::isfinite(n[1]) && std::isfinite(n[2]);
}

void HandScene::clearAll() {
  solid.clear();
  clear.clear();
  lines.clear();
  points.clear();
  labels.clear();
  background = 0;
}

QRgb litColor(QRgb color, const Eigen::Vector3f& normal, const Eigen::Matrix3f& eyeFromBase) {
  const float squared = normal.squaredNorm();
  if (!std::isfinite(squared) || squared <= 0.0F) return color;
  const float light = kAmbient + kDiffuse * std::abs((eyeFromBase * normal).dot(kTowardsLight));
  return qRgba(litChannel(qRed(color), light),
               litChannel(qGreen(color), light),
               litChannel(qBlue(color), light),
               qAlpha(color));
}

void appendLinesAndPoints(const HandScene& scene,
                          const HandCamera& camera,
                          const QSizeF& size,
                          std::vector<ClipVertex>& out) {
  if (!(size.width() > 0.0) || !(size.height() > 0.0)) return;
  const Eye eye(camera, size);
  for (const SceneLine& line : scene.lines) appendLine(eye, line, out);
  for (const ScenePoint& point : scene.points) appendPoint(eye, point, out);
}

}  // namespace palpate::gui
