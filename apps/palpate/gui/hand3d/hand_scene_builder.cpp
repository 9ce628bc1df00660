#include "gui/hand3d/hand_scene_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include <palpate/core/error.h>
#include <palpate/slip/object_motion.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/difference_map.h"
#include "gui/matrices/drawn_taxels.h"
#include "gui/matrices/matrices_painter.h"

namespace palpate::gui {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// Share of a taxel's side that is filled; the body remains visible between the taxels.
constexpr float kCellShare = 0.93F;
constexpr float kCellLiftMm = 0.15F;
constexpr float kBarShare = 0.8F;
// Height of a bar at the upper end of the colour range.
constexpr float kTallestBarMm = 30.0F;
constexpr float kOutlineLiftMm = 0.45F;
constexpr float kTaxelDotPx = 3.2F;
constexpr double kShortestShearMm = 0.1;
constexpr float kShearLiftMm = 0.6F;
constexpr float kShearPx = 1.5F;
// Opacity of an object once it is touched: the taxels behind it are seen.
constexpr int kTouchedObjectAlpha = 70;
// Share of the background colour in a greyed hand.
constexpr double kBodyVeil = 0.62;

QColor bodyColor(HandBodyRole role, Theme theme) {
  const bool dark = theme == Theme::kDark;
  switch (role) {
    case HandBodyRole::kPalm:
      return dark ? QColor(0x5a, 0x62, 0x6e) : QColor(0xae, 0xb6, 0xc1);
    case HandBodyRole::kKnuckle:
      return dark ? QColor(0x45, 0x4c, 0x57) : QColor(0x8d, 0x97, 0xa5);
    case HandBodyRole::kLink:
      break;
  }
  return dark ? QColor(0x76, 0x7f, 0x8c) : QColor(0xc9, 0xd0, 0xd9);
}

QColor objectColor(Theme theme) {
  return theme == Theme::kDark ? QColor(0x9a, 0x7b, 0x5b) : QColor(0xc9, 0xa7, 0x7f);
}

SceneVertex vertex(const Vector3f& at, const Vector3f& normal, QRgb color) {
  return {{at.x(), at.y(), at.z()}, {normal.x(), normal.y(), normal.z()}, color};
}

void addQuad(std::vector<SceneVertex>& to,
             const std::array<Vector3f, 4>& corners,
             const Vector3f& normal,
             QRgb color) {
  for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U})
    to.push_back(vertex(corners[i], normal, color));
}

std::array<Vector3f, 4> shrunk(const TaxelPatch& patch, float share, float liftMm) {
  std::array<Vector3f, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] =
        patch.centreMm + (patch.cornersMm[i] - patch.centreMm) * share + patch.normal * liftMm;
  return corners;
}

void addOutline(HandScene& scene,
                const std::array<Vector3f, 4>& corners,
                float widthPx,
                QRgb color) {
  for (std::size_t i = 0; i < 4; ++i)
    scene.lines.push_back({corners[i], corners[(i + 1) % 4], widthPx, color});
}

void addBar(HandScene& scene, const TaxelPatch& patch, float heightMm, QRgb color) {
  const auto foot = shrunk(patch, kBarShare, 0.0F);
  auto top = foot;
  for (Vector3f& corner : top) corner += patch.normal * heightMm;
  addQuad(scene.solid, top, Vector3f::Zero(), color);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const Vector3f out = (foot[next] - foot[i]).cross(patch.normal).normalized();
    addQuad(scene.solid, {foot[i], foot[next], top[next], top[i]}, out, color);
  }
}

// Calls visit(place, matrix, y, x) for places that have a taxel and are shown.
template <class Visit>
void eachTaxel(const SensorLayout& layout, const HandLook& look, Visit visit) {
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    if (look.only && *look.only != m) continue;
    const MatrixLayout& matrix = layout.matrix(m);
    std::size_t place = layout.offset(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x, ++place)
        if (matrix.exists(y, x)) visit(place, m, y, x);
  }
}

using Eigen::Vector3d;
using Eigen::Vector3f;

// Segments of a circle.
constexpr int kHandSceneBuilderContactAround = 48;
// Rings of a sphere from pole to pole.
constexpr int kRings = 24;
constexpr float kNormalMm = 5.0F;
constexpr float kMeanNormalMm = 18.0F;
constexpr float kAxisMm = 45.0F;
// Opacity of the sphere where the surface faces the eye.
constexpr float kClearestGlass = 0.07F;
// Opacity at the rim of the sphere.
constexpr float kDensestGlass = 0.55F;
// Least radius of a sphere that is drawn.
constexpr double kMinRadiusMm = 0.1;

QRgb withAlpha(const QColor& color, float alpha) {
  return qRgba(color.red(), color.green(), color.blue(), static_cast<int>(alpha * 255.0F));
}

Vector3f onSphere(int ring, int step) {
  const double down = std::numbers::pi * ring / kRings;
  const double around = 2.0 * std::numbers::pi * step / kHandSceneBuilderContactAround;
  return Vector3d(
             std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down))
      .cast<float>();
}

// Ring by ring, each with its first direction again at its end.
const std::vector<Vector3f>& directionsOfSphere() {
  static const std::vector<Vector3f> directions = [] {
    std::vector<Vector3f> made;
    for (int ring = 0; ring <= kRings; ++ring)
      for (int step = 0; step <= kHandSceneBuilderContactAround; ++step)
        made.push_back(onSphere(ring, step));
    return made;
  }();
  return directions;
}

void addCircle(HandScene& scene,
               const Sphere& sphere,
               const Vector3d& u,
               const Vector3d& v,
               float widthPx,
               QRgb color) {
  const auto at = [&](int step) {
    const double angle = 2.0 * std::numbers::pi * step / kHandSceneBuilderContactAround;
    return Vector3f(
        (sphere.centreMm + sphere.radiusMm * (std::cos(angle) * u + std::sin(angle) * v))
            .cast<float>());
  };
  for (int step = 0; step < kHandSceneBuilderContactAround; ++step)
    scene.lines.push_back({at(step), at(step + 1), widthPx, color});
}

using Eigen::Vector3d;
using Eigen::Vector3f;

// Least motion that is drawn.
constexpr double kHandSceneBuilderSlipLeastMm = 0.2;
constexpr double kMinTurnDeg = 1.0;
// Largest motion of the object that is drawn. A larger estimate is noise, amplified because the
// contacts are nearly in one line.
constexpr double kMaxMm = 40.0;
constexpr double kMaxDeg = 60.0;
// Height above the surface.
constexpr double kLiftMm = 1.2;
constexpr double kHeadMm = 5.0;
// Radius of the arc that shows the rotation of the object.
constexpr double kArcMm = 22.0;
constexpr int kArcSteps = 24;
constexpr float kContactPx = 3.0F;
constexpr float kObjectPx = 4.5F;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
// With fewer known components of the six, the motion of the object isn't drawn.
constexpr int kMinRank = 2;
constexpr int kWholeRank = 6;

void addHead(HandScene& scene,
             const Vector3d& tip,
             const Vector3d& along,
             float widthPx,
             QRgb color,
             double headMm = kHeadMm) {
  const Vector3d side = along.unitOrthogonal(), other = along.cross(side);
  for (const Vector3d& way : {side, Vector3d(-side), other, Vector3d(-other)})
    scene.lines.push_back({tip.cast<float>(),
                           (tip - headMm * along + 0.45 * headMm * way).cast<float>(),
                           widthPx,
                           color});
}

void addArrow(HandScene& scene,
              const Vector3d& from,
              const Vector3d& way,
              float widthPx,
              QRgb color,
              double headMm = kHeadMm) {
  const Vector3d tip = from + way;
  scene.lines.push_back({from.cast<float>(), tip.cast<float>(), widthPx, color});
  addHead(scene, tip, way.normalized(), widthPx, color, headMm);
}

// Adds an arc for a rotation about an axis through `centre`, as long as the angle.
void addTurn(HandScene& scene, const Vector3d& centre, const Vector3d& turn, QRgb color) {
  const Vector3d axis = turn.normalized();
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const double sweep = std::min(turn.norm(), 1.75 * std::numbers::pi);
  const auto at = [&](double angle) {
    return Vector3d(centre + kArcMm * (std::cos(angle) * u + std::sin(angle) * v));
  };
  for (int i = 0; i < kArcSteps; ++i)
    scene.lines.push_back({at(sweep * i / kArcSteps).cast<float>(),
                           at(sweep * (i + 1) / kArcSteps).cast<float>(),
                           kObjectPx,
                           color});
  addHead(scene, at(sweep), -std::sin(sweep) * u + std::cos(sweep) * v, kObjectPx, color);
}

bool hasMeshes(const HandGeometry& geometry) {
  const auto& shapes = geometry.description().shapes;
  return std::any_of(shapes.begin(), shapes.end(), [](const LinkShape& shape) {
    return shape.kind == LinkShape::Kind::kMesh;
  });
}

}  // namespace

std::shared_ptr<const HandGeometry> geometryOf(const HandDescription& hand) {
  if (!hasGeometry(hand)) return nullptr;
  try {
    return std::make_shared<const HandGeometry>(describeGeometry(hand));
  } catch (const Error&) {  // an URDF that does not fit; `palpate hands check` says why
    return nullptr;
  }
}

bool HandSceneBuilder::drawsMeshes() const {
  return geometry_ && !missing_ && hasMeshes(*geometry_);
}

void HandSceneBuilder::setHand(const HandDescription& hand, bool withMeshes) {
  // Other scanned taxels don't change the bodies.
  const bool keeps = drawsMeshes() && hand_->file == hand.file && hand_->name == hand.name;
  hand_ = hand;
  geometry_ = geometryOf(hand);
  slip_.clear();
  objects_.clear();
  if (!keeps) bodies_.clear();
  missing_.reset();
  handState_ = {};
  onHand_.clear();
  patchesLaidFlat(hand, flat_);
  if (!selection_.sameSensor(TaxelSelection(*hand.layout))) selection_ = {};
  if (!geometry_) return;
  if (!keeps && !withMeshes && hasMeshes(*geometry_))
    missing_ = geometry_;
  else if (!keeps)
    bodies_ = handBodies(*geometry_);
  geometry_->pose(std::vector<double>(geometry_->description().numAxes, 0.0), pose_);
  patchesOnHand(pose_, *hand.layout, onHand_);
}

void HandSceneBuilder::setBodies(std::vector<HandBody> bodies) {
  bodies_ = std::move(bodies);
  missing_.reset();
}

void HandSceneBuilder::clear() {
  hand_.reset();
  geometry_.reset();
  missing_.reset();
  bodies_.clear();
  objects_.clear();
  handState_ = {};
  slip_.clear();
  selection_ = {};
}

void HandSceneBuilder::setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  if (!hand_) return;
  handState_.frame = frame;
  handState_.anglesDeg.clear();
  if (!geometry_) return;
  const bool known = anglesDeg.size() == geometry_->description().numAxes &&
                     std::all_of(anglesDeg.begin(), anglesDeg.end(), [](double angle) {
                       return std::isfinite(angle);
                     });
  if (known) handState_.anglesDeg = anglesDeg;
  geometry_->pose(known ? anglesDeg : std::vector<double>(geometry_->description().numAxes, 0.0),
                  pose_);
  patchesOnHand(pose_, *hand_->layout, onHand_);
  handState_.contact = known ? contactOf(frame, pose_) : HandContact{};
}

bool HandSceneBuilder::setObjects(const std::vector<SceneObject>& objects) {
  bool changes = objects.size() != objects_.size();
  objects_.resize(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const SceneObject &now = objects[i], &before = objects_[i].object;
    if (objects_[i].triangles.empty() || now.shape.kind != before.shape.kind ||
        now.shape.sizeMm != before.shape.sizeMm)
      objects_[i].triangles = trianglesOf(now.shape);
    else if (now.positionMm == before.positionMm && now.rotation == before.rotation)
      continue;
    objects_[i].object = now;
    changes = true;
  }
  return changes;
}

HandLook HandSceneBuilder::effective(HandLook look) const {
  if (hand_ && !geometry_ && !isFlat(look.taxels)) look.taxels = TaxelShape::kFlatCells;
  if (hand_ && look.only && *look.only >= hand_->layout->numMatrices()) look.only.reset();
  return look;
}

const TaxelPatches& HandSceneBuilder::patches(const HandLook& look) const {
  return isFlat(look.taxels) ? flat_ : onHand_;
}

bool HandSceneBuilder::isShown(const HandBody& body, const HandLook& look) const {
  if (!look.only) return true;
  const SensorSurface& surface = geometry_->description().surfaces.at(*look.only);
  return body.place == surface.place && body.role != HandBodyRole::kKnuckle;
}

void HandSceneBuilder::addBodies(HandScene& scene, const HandLook& look) const {
  const QColor background = colorsOf(look.theme).window;
  for (const HandBody& body : bodies_) {
    if (!isShown(body, look)) continue;
    QColor color = bodyColor(body.role, look.theme);
    if (!posed()) color = mixed(color, background, kBodyVeil);
    const QRgb rgb = color.rgb();
    const Eigen::Isometry3f to = pose_.baseFrom(body.place).cast<float>();
    if (look.wire) {
      for (const auto& [from, until] : body.edges)
        scene.lines.push_back({to * from, to * until, 1.0F, rgb});
      continue;
    }
    for (const HandBody::Corner& corner : body.triangles)
      scene.solid.push_back(vertex(to * corner.atMm, to.linear() * corner.normal, rgb));
  }
}

void HandSceneBuilder::addObjects(HandScene& scene, const HandLook& look) const {
  if (look.only) return;
  const bool touched = handState_.frame && handState_.contact.centroidMm;
  QColor color = objectColor(look.theme);
  if (touched) color.setAlpha(kTouchedObjectAlpha);
  std::vector<SceneVertex>& to = touched ? scene.clear : scene.solid;
  for (const auto& [object, triangles] : objects_)
    for (const HandBody::Corner& corner : triangles)
      to.push_back(
          vertex((object.rotation.cast<float>() * corner.atMm) + object.positionMm.cast<float>(),
                 object.rotation.cast<float>() * corner.normal,
                 color.rgba()));
}

void HandSceneBuilder::addTaxels(HandScene& scene, const HandLook& look) const {
  const TaxelPatches& places = patches(look);
  const ColorTable& table = look.isSigned ? differenceTable(look.theme) : colorTable(look.map);
  const ThemeColors& colors = colorsOf(look.theme);
  // As in the heat maps.
  QColor resting = look.isSigned ? colors.taxel : colorsOf(Theme::kDark).taxel;
  if (!posed() && !isFlat(look.taxels)) resting = mixed(resting, colors.window, kBodyVeil);
  const bool bars = look.taxels == TaxelShape::kBars || look.taxels == TaxelShape::kFlatBars;
  // Bars of signed values are as long as their size.
  const double lowest = look.isSigned ? 0.0 : look.range.minimum;
  const double span = std::max(1e-9, look.range.maximum - lowest);
  const SensorLayout& layout = *hand_->layout;
  const float least = leastSeen(*hand_);
  std::vector<MatrixValues> ofReadings;
  if (handState_.frame && (look.isSigned || look.view == TaxelView::kMagnitude))
    for (std::size_t m = 0; m < layout.numMatrices(); ++m)
      ofReadings.push_back(drawnValues(*handState_.frame, m, look.view));
  eachTaxel(layout, look, [&](std::size_t place, std::size_t m, int y, int x) {
    const TaxelPatch& patch = places[place];
    const float value = !ofReadings.empty() ? ofReadings[m](y, x)
                        : handState_.frame  ? handState_.frame->allValues()[place]
                                            : 0.0F;
    const float size = look.isSigned ? std::abs(value) : value;
    const bool active = handState_.frame && isSeen(handState_.frame->values[place], size, least);
    const bool scanned = layout.matrix(m).enabled(y, x);
    const QRgb color =
        active ? table[static_cast<std::size_t>(colorIndex(
                     static_cast<double>(value), look.range.minimum, look.range.maximum))]
               : resting.rgb();
    if (look.taxels == TaxelShape::kPoints) {
      if (scanned)
        scene.points.push_back({patch.centreMm + patch.normal * kOutlineLiftMm,
                                active ? kTaxelDotPx * 1.5F : kTaxelDotPx * 0.7F,
                                color});
      return;
    }
    if (look.wire || !scanned) {
      addOutline(scene,
                 shrunk(patch, kBarShare, kCellLiftMm),
                 1.0F,
                 scanned ? color : colors.maskedLine.rgb());
      if (!scanned || !active) return;
    }
    // A taxel at rest is lit like the hand; a value has exactly its colour of the colour bar.
    addQuad(scene.solid,
            shrunk(patch, kCellShare, kCellLiftMm),
            active ? Vector3f(Vector3f::Zero()) : patch.normal,
            color);
    if (!bars || !active) return;
    const double share =
        std::clamp((static_cast<double>(size) - std::min(0.0, lowest)) / span, 0.0, 1.0);
    addBar(scene, patch, kTallestBarMm * static_cast<float>(share), color);
  });
}

void HandSceneBuilder::addSelection(HandScene& scene, const HandLook& look) const {
  if (selection_.numMatrices() != hand_->layout->numMatrices()) return;
  const TaxelPatches& places = patches(look);
  const QRgb accent = colorsOf(look.theme).accent.rgb();
  eachTaxel(*hand_->layout, look, [&](std::size_t place, std::size_t m, int y, int x) {
    if (selection_.contains(m, y, x))
      addOutline(scene, shrunk(places[place], 1.0F, kOutlineLiftMm), 2.0F, accent);
  });
}

void HandSceneBuilder::fill(HandScene& scene,
                            const HandLook& wanted,
                            const HandCamera& camera) const {
  scene.clearAll();
  scene.background = colorsOf(wanted.theme).window.rgb();
  if (!hand_) return;
  const HandLook look = effective(wanted);
  const bool flat = isFlat(look.taxels);
  if (!flat) addBodies(scene, look);
  if (!flat) addObjects(scene, look);
  addTaxels(scene, look);
  addSelection(scene, look);
  addShear(scene, look);
  if (look.normals) addNormals(scene, look);
  if (look.axes && !flat) addAxes(scene, look);
  if (flat) return;
  if (look.contacts) addContacts(scene, look);
  if (look.slip) addSlip(scene, look, camera);
  addSphere(scene, look, camera);
}

std::vector<Vector3d> HandSceneBuilder::extent(const HandLook& wanted) const {
  std::vector<Vector3d> points;
  if (!hand_) return points;
  const HandLook look = effective(wanted);
  const TaxelPatches& places = patches(look);
  const bool bars = look.taxels == TaxelShape::kBars || look.taxels == TaxelShape::kFlatBars;
  eachTaxel(*hand_->layout, look, [&](std::size_t place, std::size_t, int, int) {
    points.push_back(places[place].centreMm.cast<double>());
    if (bars)
      points.push_back(
          (places[place].centreMm + kTallestBarMm * places[place].normal).cast<double>());
  });
  if (isFlat(look.taxels)) return points;
  if (const Sphere* sphere = sphereOf(look);
      sphere && look.sphere != SphereLook::kNone && !look.only)
    for (int i = 0; i < 3; ++i)
      for (const double side : {-1.0, 1.0})
        points.push_back(sphere->centreMm + side * sphere->radiusMm * Vector3d::Unit(i));
  for (const auto& [object, triangles] : objects_)
    for (int corner = 0; corner < 8 && !look.only; ++corner) {
      const Vector3d side(
          corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
      points.push_back(object.positionMm +
                       object.rotation * side.cwiseProduct(object.shape.sizeMm));
    }
  for (const HandBody& body : bodies_) {
    if (!isShown(body, look)) continue;
    const Eigen::Isometry3d to = pose_.baseFrom(body.place);
    for (const HandBody::Corner& corner : body.triangles)
      points.push_back(to * corner.atMm.cast<double>());
  }
  return points;
}

std::optional<TaxelPlace> HandSceneBuilder::taxelUnder(const Vector3d& eyeMm,
                                                       const Vector3d& ray,
                                                       const HandLook& wanted) const {
  if (!hand_) return std::nullopt;
  const HandLook look = effective(wanted);
  const Vector3f eye = eyeMm.cast<float>(), along = ray.cast<float>();
  // Distance along the ray at which it hits a triangle (Moeller and Trumbore).
  const auto met = [&](const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    const Vector3f ab = b - a, ac = c - a, p = along.cross(ac);
    const float det = ab.dot(p);
    if (std::abs(det) < 1e-9F) return kNever;
    const Vector3f from = eye - a, q = from.cross(ab);
    const float u = from.dot(p) / det, v = along.dot(q) / det;
    if (u < 0.0F || v < 0.0F || u + v > 1.0F) return kNever;
    const float distance = ac.dot(q) / det;
    return distance > 0.0F ? distance : kNever;
  };
  float nearest = std::numeric_limits<float>::infinity();
  std::optional<TaxelPlace> found;
  const TaxelPatches& places = patches(look);
  eachTaxel(*hand_->layout, look, [&](std::size_t place, std::size_t m, int y, int x) {
    const auto& patch = places[place];
    if (patch.normal.dot(along) >= 0.0F) return;
    const auto& at = patch.cornersMm;
    const float distance = std::min(met(at[0], at[1], at[2]), met(at[0], at[2], at[3]));
    if (distance >= nearest) return;
    nearest = distance;
    found = TaxelPlace{m, y, x};
  });
  if (!found || isFlat(look.taxels) || look.wire) return found;
  // Tolerance, because the surface of a link is just below its taxels.
  constexpr float kSkinMm = 1.0F;
  for (const HandBody& body : bodies_) {
    if (!isShown(body, look)) continue;
    const Eigen::Isometry3f to = pose_.baseFrom(body.place).cast<float>();
    for (std::size_t i = 0; i + 2 < body.triangles.size(); i += 3)
      if (met(to * body.triangles[i].atMm,
              to * body.triangles[i + 1].atMm,
              to * body.triangles[i + 2].atMm) < nearest - kSkinMm)
        return std::nullopt;
  }
  return found;
}

HandCamera HandSceneBuilder::usualCamera(const HandLook& wanted) const {
  constexpr double kFlatElevationDeg = 89.0, kBarsElevationDeg = 48.0;
  // Oblique view of a single matrix, so that depth is visible.
  constexpr double kAsideDeg = 25.0, kAboveDeg = 10.0;
  constexpr double kSteepestDeg = 80.0;
  HandCamera camera;
  const HandLook look = effective(wanted);
  if (isFlat(look.taxels)) {
    camera.azimuthDeg = -90.0;
    camera.elevationDeg =
        look.taxels == TaxelShape::kFlatBars ? kBarsElevationDeg : kFlatElevationDeg;
  } else if (look.only && hand_) {
    // The camera is placed where the taxels face it.
    const SensorLayout& layout = *hand_->layout;
    Vector3f facing = Vector3f::Zero();
    for (std::size_t i = 0; i < layout.matrix(*look.only).numCells(); ++i)
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

const Sphere* HandSceneBuilder::sphereOf(const HandLook& look) const {
  const auto& sphere = look.sphereOf == SphereOf::kTaxels ? handState_.contact.taxelSphere
                                                          : handState_.contact.centroidSphere;
  return sphere && sphere->radiusMm >= kMinRadiusMm ? &*sphere : nullptr;
}

void HandSceneBuilder::addSphere(HandScene& scene,
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
  const auto made = [&](const Vector3f& normal) {
    const Vector3f at = centre + radius * normal;
    float alpha = 1.0F;
    if (glass) {
      // Like glass, the sphere is less transparent where the view is oblique.
      const float aslant = 1.0F - std::abs(normal.dot((eye - at).normalized()));
      alpha = kClearestGlass + (kDensestGlass - kClearestGlass) * aslant * aslant * aslant;
    }
    return SceneVertex{
        {at.x(), at.y(), at.z()}, {normal.x(), normal.y(), normal.z()}, withAlpha(accent, alpha)};
  };
  // Each corner is made once: it belongs to up to six triangles.
  std::vector<SceneVertex> corners;
  corners.reserve(directionsOfSphere().size());
  for (const Vector3f& normal : directionsOfSphere()) corners.push_back(made(normal));
  const auto corner = [&](int ring, int step) -> const SceneVertex& {
    return corners[static_cast<std::size_t>(ring * (kHandSceneBuilderContactAround + 1) + step)];
  };
  std::vector<SceneVertex>& to = glass ? scene.clear : scene.solid;
  for (int ring = 0; ring < kRings; ++ring)
    for (int step = 0; step < kHandSceneBuilderContactAround; ++step) {
      const SceneVertex &a = corner(ring, step), &b = corner(ring + 1, step),
                        &c = corner(ring + 1, step + 1), &d = corner(ring, step + 1);
      if (ring + 1 < kRings) to.insert(to.end(), {a, b, c});
      if (ring > 0) to.insert(to.end(), {a, c, d});
    }
}

void HandSceneBuilder::addContacts(HandScene& scene, const HandLook& look) const {
  const ThemeColors& colors = colorsOf(look.theme);
  const HandContact& contact = handState_.contact;
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

void HandSceneBuilder::addNormals(HandScene& scene, const HandLook& look) const {
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
        const bool active = handState_.frame && isTouched(handState_.frame->values[place]);
        scene.lines.push_back({patch.centreMm,
                               patch.centreMm + patch.normal * kNormalMm,
                               1.0F,
                               active ? touched : resting});
      }
  }
}

void HandSceneBuilder::addShear(HandScene& scene, const HandLook& look) const {
  const double scale = arrowScale(look.range, look.arrows);
  if (!handState_.frame || !(scale > 0.0) || !hasShear(*hand_->layout)) return;
  const TaxelPatches& places = patches(look);
  const QRgb color = colorsOf(look.theme).text.rgb();
  eachTaxel(*hand_->layout, look, [&](std::size_t place, std::size_t m, int y, int x) {
    const MatrixLayout& matrix = hand_->layout->matrix(m);
    if (matrix.touch.components != 3 || !matrix.enabled(y, x)) return;
    const TaxelPatch& patch = places[place];
    const double pitchMm = std::min(matrix.pitchMm.x, matrix.pitchMm.y);
    const QPointF shear = scale * pitchMm * shearAt(*handState_.frame, {m, y, x});
    if (std::hypot(shear.x(), shear.y()) < kShortestShearMm) return;
    const Vector3f way =
        static_cast<float>(shear.x()) * patch.alongX + static_cast<float>(shear.y()) * patch.alongY;
    addArrow(scene,
             (patch.centreMm + kShearLiftMm * patch.normal).cast<double>(),
             way.cast<double>(),
             kShearPx,
             color,
             0.4 * std::min(pitchMm, std::hypot(shear.x(), shear.y())));
  });
}

void HandSceneBuilder::addAxes(HandScene& scene, const HandLook& look) const {
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

void HandSceneBuilder::addSlip(HandScene& scene,
                               const HandLook& look,
                               const HandCamera& camera) const {
  if (slip_.empty() || !hand_ || !geometry_ || isFlat(look.taxels)) return;
  const ThemeColors& colors = colorsOf(look.theme);
  std::vector<SlipArrow> arrows;
  bool moves = false;
  for (const HandSlip& slip : slip_) {
    if (slip.matrix >= hand_->layout->numMatrices()) continue;
    const MatrixLayout& matrix = hand_->layout->matrix(slip.matrix);
    arrows.push_back(slipArrow(
        pose_, slip.matrix, matrix.pitchMm, slip.x, slip.y, slip.dx, slip.dy, slip.turnDeg));
    const SlipArrow& arrow = arrows.back();
    const double mm = arrow.vectorMm.norm();
    moves = moves || slip.slipping;
    if (mm < kHandSceneBuilderSlipLeastMm || (look.only && *look.only != slip.matrix)) continue;
    const QColor color = slip.slipping ? colors.danger : colors.text;
    const Vector3d from = arrow.originMm + kLiftMm * arrow.normal;
    const Vector3d way = static_cast<double>(kSlipEnlarged) * arrow.vectorMm;
    addArrow(scene, from, way, kContactPx, color.rgb());
    // The back of a finger hides the arrow: its words would seem to belong to what covers it.
    if (arrow.normal.dot(camera.eyeMm() - from) <= 0.0) continue;
    // A hand at rest, because nothing is known of its joints, is shown without sizes.
    QString words = slip.slipping ? "slip" : "moved";
    if (posed()) words += " " + figure(mm, 1) + " mm";
    scene.labels.push_back({from + way, words, color});
  }
  // The motion of the object is drawn only while a contact slips; otherwise it is noise and the
  // effect of the load. It needs the pose of the fingers.
  if (!moves || arrows.size() < 2 || look.only || !posed()) return;
  const ObjectMotion object = objectMotion(arrows);
  if (object.rank < kMinRank) return;
  const double mm = object.translationMm.norm(), deg = object.rotationRad.norm() * kDegPerRad;
  if (mm > kMaxMm || deg > kMaxDeg) return;
  const QColor color = colors.accent;
  const double enlarged = static_cast<double>(kSlipEnlarged);
  if (mm >= kHandSceneBuilderSlipLeastMm)
    addArrow(scene, object.centerMm, enlarged * object.translationMm, kObjectPx, color.rgb());
  if (deg >= kMinTurnDeg)
    addTurn(scene, object.centerMm, enlarged * object.rotationRad, color.rgb());
  QString words = "object " + figure(mm, 1) + " mm, " + figure(deg, 0) + "°";
  if (object.rank < kWholeRank) words += " (" + QString::number(object.rank) + " of 6 known)";
  words += ", residual " + figure(object.residualMm, 1) + " mm";
  scene.labels.push_back({object.centerMm + enlarged * object.translationMm, words, color});
}

}  // namespace palpate::gui
