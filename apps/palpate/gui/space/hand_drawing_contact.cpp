// What the drawing of a hand adds of the contact: enclosing sphere, centroids, axes, normals.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "gui/space/hand_drawing.h"

namespace palpate::gui {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kHandDrawingContactAround = 48;  // segments of a circle
constexpr int kRings = 24;                     // of a sphere from pole to pole
constexpr float kNormalMm = 5.0F;
constexpr float kMeanNormalMm = 18.0F;
constexpr float kAxisMm = 45.0F;
constexpr float kClearestGlass = 0.07F;  // seen head on
constexpr float kDensestGlass = 0.55F;   // at its rim
constexpr double kLeastRadiusMm = 0.1;   // of a sphere that is seen

QRgb withAlpha(const QColor& color, float alpha) {
  return qRgba(color.red(), color.green(), color.blue(), static_cast<int>(alpha * 255.0F));
}

Vector3f onSphere(int ring, int step) {
  const double down = std::numbers::pi * ring / kRings;
  const double around = 2.0 * std::numbers::pi * step / kHandDrawingContactAround;
  return Vector3d(
             std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down))
      .cast<float>();
}

void addCircle(HandScene& scene,
               const Sphere& sphere,
               const Vector3d& u,
               const Vector3d& v,
               float widthPx,
               QRgb color) {
  const auto at = [&](int step) {
    const double angle = 2.0 * std::numbers::pi * step / kHandDrawingContactAround;
    return Vector3f(
        (sphere.centreMm + sphere.radiusMm * (std::cos(angle) * u + std::sin(angle) * v))
            .cast<float>());
  };
  for (int step = 0; step < kHandDrawingContactAround; ++step)
    scene.lines.push_back({at(step), at(step + 1), widthPx, color});
}

}  // namespace

HandCamera HandDrawing::usualCamera(const HandLook& wanted) const {
  constexpr double kFlatElevationDeg = 89.0, kBarsElevationDeg = 48.0;
  constexpr double kAsideDeg = 25.0, kAboveDeg = 10.0;  // of a matrix alone: depth is seen
  constexpr double kSteepestDeg = 80.0;
  HandCamera camera;
  const HandLook look = effective(wanted);
  if (isFlat(look.taxels)) {
    camera.azimuthDeg = -90.0;
    camera.elevationDeg =
        look.taxels == TaxelShape::kFlatBars ? kBarsElevationDeg : kFlatElevationDeg;
  } else if (look.only && hand_) {
    // From where its taxels face.
    const SensorLayout& layout = *hand_->layout;
    Vector3f facing = Vector3f::Zero();
    for (std::size_t i = 0; i < layout.matrix(*look.only).numPlaces(); ++i)
      facing += patches(look)[layout.offset(*look.only) + i].normal;
    const auto degrees = [](float y, float x) {
      return static_cast<double>(std::atan2(y, x)) * 180.0 / std::numbers::pi;
    };
    camera.azimuthDeg = degrees(facing.y(), facing.x()) + kAsideDeg;
    camera.elevationDeg = std::clamp(
        degrees(facing.z(), facing.head<2>().norm()) + kAboveDeg, -kSteepestDeg, kSteepestDeg);
  }
  return camera;
}

const Sphere* HandDrawing::sphereOf(const HandLook& look) const {
  const auto& sphere = look.sphereOf == SphereOf::kTaxels ? moment_.contact.taxelSphere
                                                          : moment_.contact.centroidSphere;
  return sphere && sphere->radiusMm >= kLeastRadiusMm ? &*sphere : nullptr;
}

void HandDrawing::addSphere(HandScene& scene,
                            const HandLook& look,
                            const HandCamera& camera) const {
  const Sphere* sphere = sphereOf(look);
  if (!sphere || look.sphere == SphereLook::kNone || look.only) return;
  const QColor accent = colorsOf(look.theme).accent;
  const Vector3f centre = sphere->centreMm.cast<float>();
  const auto radius = static_cast<float>(sphere->radiusMm);
  if (look.sphere == SphereLook::kWire) {
    for (int i = 0; i < 6; ++i) {
      const double angle = std::numbers::pi * i / 6.0;
      addCircle(scene,
                *sphere,
                {std::cos(angle), std::sin(angle), 0.0},
                Vector3d::UnitZ(),
                1.0F,
                withAlpha(accent, 0.8F));
    }
    for (int ring = 3; ring < kRings; ring += 3) {
      const double down = std::numbers::pi * ring / kRings;
      const Sphere smaller{sphere->centreMm + Vector3d(0.0, 0.0, sphere->radiusMm * std::cos(down)),
                           sphere->radiusMm * std::sin(down)};
      addCircle(
          scene, smaller, Vector3d::UnitX(), Vector3d::UnitY(), 1.0F, withAlpha(accent, 0.8F));
    }
    return;
  }
  const bool glass = look.sphere == SphereLook::kGlass;
  const Vector3f eye = camera.eyeMm().cast<float>();
  const auto corner = [&](int ring, int step) {
    const Vector3f normal = onSphere(ring, step);
    const Vector3f at = centre + radius * normal;
    float alpha = 1.0F;
    if (glass) {
      // Like glass it is denser where it is looked through aslant.
      const float aslant = 1.0F - std::abs(normal.dot((eye - at).normalized()));
      alpha = kClearestGlass + (kDensestGlass - kClearestGlass) * aslant * aslant * aslant;
    }
    return SceneVertex{
        {at.x(), at.y(), at.z()}, {normal.x(), normal.y(), normal.z()}, withAlpha(accent, alpha)};
  };
  std::vector<SceneVertex>& to = glass ? scene.clear : scene.solid;
  for (int ring = 0; ring < kRings; ++ring)
    for (int step = 0; step < kHandDrawingContactAround; ++step) {
      const SceneVertex a = corner(ring, step), b = corner(ring + 1, step),
                        c = corner(ring + 1, step + 1), d = corner(ring, step + 1);
      if (ring + 1 < kRings) to.insert(to.end(), {a, b, c});
      if (ring > 0) to.insert(to.end(), {a, c, d});
    }
}

void HandDrawing::addContacts(HandScene& scene, const HandLook& look) const {
  const ThemeColors& colors = colorsOf(look.theme);
  const HandContact& contact = moment_.contact;
  for (std::size_t m = 0; m < contact.matrices.size(); ++m) {
    const MatrixContact& touch = contact.matrices[m];
    if (touch.numActive == 0 || (look.only && *look.only != m)) continue;
    const QRgb color = colors.text.rgb();
    const Vector3f at = (touch.centroidMm + 0.9 * touch.meanNormal).cast<float>();
    for (const auto& [axis, sdMm] : {std::pair(touch.majorAxis, touch.majorSdMm),
                                     std::pair(touch.minorAxis, touch.minorSdMm)}) {
      const Vector3f half = (axis * sdMm).cast<float>();
      scene.lines.push_back({at - half, at + half, 2.0F, color});
    }
    scene.lines.push_back(
        {at, at + touch.meanNormal.cast<float>() * kMeanNormalMm, 2.0F, colors.accent.rgb()});
    scene.points.push_back({at, 4.0F, color});
  }
  if (contact.centroidMm && !look.only)
    scene.points.push_back({contact.centroidMm->cast<float>(), 5.0F, colors.accent.rgb()});
}

void HandDrawing::addNormals(HandScene& scene, const HandLook& look) const {
  const TaxelPatches& places = patches(look);
  const QRgb resting = colorsOf(look.theme).muted.rgb(), touched = colorsOf(look.theme).text.rgb();
  const SensorLayout& layout = *hand_->layout;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    if (look.only && *look.only != m) continue;
    const MatrixLayout& matrix = layout.matrix(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x) {
        if (!matrix.exists(y, x)) continue;
        const std::size_t place =
            layout.offset(m) + static_cast<std::size_t>(y * matrix.columns + x);
        const TaxelPatch& patch = places[place];
        const bool active = moment_.frame && moment_.frame->values[place] > 0.0F;
        scene.lines.push_back({patch.centreMm,
                               patch.centreMm + patch.normal * kNormalMm,
                               1.0F,
                               active ? touched : resting});
      }
  }
}

void HandDrawing::addAxes(HandScene& scene, const HandLook& look) const {
  struct Axis {
    Vector3f along;
    const char* name;
    QColor color;
  };
  const bool dark = look.theme == Theme::kDark;
  const Axis axes[] = {
      {Vector3f::UnitX(), "x", dark ? QColor(0xff, 0x7b, 0x72) : QColor(0xb4, 0x2a, 0x22)},
      {Vector3f::UnitY(), "y", dark ? QColor(0x7e, 0xe7, 0x87) : QColor(0x1f, 0x7a, 0x35)},
      {Vector3f::UnitZ(), "z", dark ? QColor(0x79, 0xb8, 0xff) : QColor(0x1f, 0x5f, 0xbf)}};
  for (const Axis& axis : axes) {
    const Vector3f tip = axis.along * kAxisMm;
    scene.lines.push_back({Vector3f::Zero(), tip, 2.5F, axis.color.rgb()});
    scene.labels.push_back({(tip * 1.12F).cast<double>(), axis.name, axis.color});
  }
}

}  // namespace palpate::gui
