#include "gui/space/hand_drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "gui/matrices/matrices_painter.h"

namespace palpate::gui {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kCellShare =
    0.93F;  // of a taxel's side that is filled: a line of the body stays between
constexpr float kCellLiftMm = 0.15F;
constexpr float kBarShare = 0.8F;
constexpr float kTallestBarMm = 30.0F;  // at the end of the colour range
constexpr float kOutlineLiftMm = 0.45F;
constexpr float kTaxelDotPx = 3.2F;
constexpr double kBodyVeil = 0.62;  // how much of the background a greyed hand takes on

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

}  // namespace

std::shared_ptr<const HandGeometry> geometryOf(const HandDescription& hand) {
  const SensorLayout& known = *sdh2().layout;
  const bool same =
      hand.axes.size() == sdh2().axes.size() && hand.layout->numMatrices() == known.numMatrices() &&
      std::equal(known.matrices().begin(),
                 known.matrices().end(),
                 hand.layout->matrices().begin(),
                 [](const MatrixLayout& a, const MatrixLayout& b) {
                   return a.rows == b.rows && a.columns == b.columns && a.pitchMm == b.pitchMm;
                 });
  if (!same) return nullptr;
  static const auto geometry = std::make_shared<const HandGeometry>();
  return geometry;
}

void HandDrawing::setHand(const HandDescription& hand) {
  hand_ = hand;
  geometry_ = geometryOf(hand);
  slip_.clear();
  bodies_.clear();
  moment_ = {};
  onHand_.clear();
  patchesLaidFlat(hand, flat_);
  if (!selection_.sameSensor(TaxelSelection(*hand.layout))) selection_ = {};
  if (!geometry_) return;
  bodies_ = handBodies(*geometry_);
  geometry_->pose(std::vector<double>(geometry_->description().numAxes, 0.0), pose_);
  patchesOnHand(pose_, *hand.layout, onHand_);
}

void HandDrawing::clear() {
  hand_.reset();
  geometry_.reset();
  bodies_.clear();
  moment_ = {};
  slip_.clear();
  selection_ = {};
}

void HandDrawing::setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  if (!hand_) return;
  moment_.frame = frame;
  moment_.anglesDeg.clear();
  if (!geometry_) return;
  const bool known = anglesDeg.size() == geometry_->description().numAxes &&
                     std::all_of(anglesDeg.begin(), anglesDeg.end(), [](double angle) {
                       return std::isfinite(angle);
                     });
  if (known) moment_.anglesDeg = anglesDeg;
  geometry_->pose(known ? anglesDeg : std::vector<double>(geometry_->description().numAxes, 0.0),
                  pose_);
  patchesOnHand(pose_, *hand_->layout, onHand_);
  moment_.contact = known ? contactOf(frame, pose_) : HandContact{};
}

HandLook HandDrawing::effective(HandLook look) const {
  if (hand_ && !geometry_ && !isFlat(look.taxels)) look.taxels = TaxelShape::kFlatCells;
  if (hand_ && look.only && *look.only >= hand_->layout->numMatrices()) look.only.reset();
  return look;
}

const TaxelPatches& HandDrawing::patches(const HandLook& look) const {
  return isFlat(look.taxels) ? flat_ : onHand_;
}

bool HandDrawing::isShown(const HandBody& body, const HandLook& look) const {
  if (!look.only) return true;
  const SensorSurface& surface = geometry_->description().surfaces.at(*look.only);
  return body.link == surface.link && body.finger == surface.finger &&
         body.role == HandBodyRole::kLink;
}

void HandDrawing::addBodies(HandScene& scene, const HandLook& look) const {
  const QColor background = colorsOf(look.theme).window;
  for (const HandBody& body : bodies_) {
    if (!isShown(body, look)) continue;
    QColor color = bodyColor(body.role, look.theme);
    if (!posed()) color = mixed(color, background, kBodyVeil);
    const QRgb rgb = color.rgb();
    const Eigen::Isometry3f to =
        (body.link ? pose_.baseFromLink(body.finger, *body.link) : Eigen::Isometry3d::Identity())
            .cast<float>();
    if (look.wire) {
      for (const auto& [from, until] : body.edges)
        scene.lines.push_back({to * from, to * until, 1.0F, rgb});
      continue;
    }
    for (const HandBody::Corner& corner : body.triangles)
      scene.solid.push_back(vertex(to * corner.atMm, to.linear() * corner.normal, rgb));
  }
}

void HandDrawing::addTaxels(HandScene& scene, const HandLook& look) const {
  const TaxelPatches& places = patches(look);
  const ColorTable& table = colorTable(look.map);
  const ThemeColors& colors = colorsOf(look.theme);
  QColor resting = colors.taxel;
  if (!posed() && !isFlat(look.taxels)) resting = mixed(resting, colors.window, kBodyVeil);
  const bool bars = look.taxels == TaxelShape::kBars || look.taxels == TaxelShape::kFlatBars;
  const double span = std::max(1e-9, look.range.maximum - look.range.minimum);
  const SensorLayout& layout = *hand_->layout;
  eachTaxel(layout, look, [&](std::size_t place, std::size_t m, int y, int x) {
    const TaxelPatch& patch = places[place];
    const float value = moment_.frame ? moment_.frame->allValues()[place] : 0.0F;
    const bool active = moment_.frame && isSeen(moment_.frame->values[place], value);
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
    // What is at rest is part of the hand and lit like it; a value has the colour of the colour bar.
    addQuad(scene.solid,
            shrunk(patch, kCellShare, kCellLiftMm),
            active ? Vector3f(Vector3f::Zero()) : patch.normal,
            color);
    if (!bars || !active) return;
    const double share = std::clamp(
        (static_cast<double>(value) - std::min(0.0, look.range.minimum)) / span, 0.0, 1.0);
    addBar(scene, patch, kTallestBarMm * static_cast<float>(share), color);
  });
}

void HandDrawing::addSelection(HandScene& scene, const HandLook& look) const {
  if (selection_.numMatrices() != hand_->layout->numMatrices()) return;
  const TaxelPatches& places = patches(look);
  const QRgb accent = colorsOf(look.theme).accent.rgb();
  eachTaxel(*hand_->layout, look, [&](std::size_t place, std::size_t m, int y, int x) {
    if (selection_.contains(m, y, x))
      addOutline(scene, shrunk(places[place], 1.0F, kOutlineLiftMm), 2.0F, accent);
  });
}

void HandDrawing::fill(HandScene& scene, const HandLook& wanted, const HandCamera& camera) const {
  scene.clearAll();
  scene.background = colorsOf(wanted.theme).window.rgb();
  if (!hand_) return;
  const HandLook look = effective(wanted);
  const bool flat = isFlat(look.taxels);
  if (!flat) addBodies(scene, look);
  addTaxels(scene, look);
  addSelection(scene, look);
  if (look.normals) addNormals(scene, look);
  if (look.axes && !flat) addAxes(scene, look);
  if (flat) return;
  if (look.contacts) addContacts(scene, look);
  if (look.slip) addSlip(scene, look);
  addSphere(scene, look, camera);
}

std::vector<Vector3d> HandDrawing::extent(const HandLook& wanted) const {
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
  for (const HandBody& body : bodies_) {
    if (!isShown(body, look)) continue;
    const Eigen::Isometry3d to =
        body.link ? pose_.baseFromLink(body.finger, *body.link) : Eigen::Isometry3d::Identity();
    for (const HandBody::Corner& corner : body.triangles)
      points.push_back(to * corner.atMm.cast<double>());
  }
  return points;
}

std::optional<TaxelPlace> HandDrawing::taxelUnder(const Vector3d& eyeMm,
                                                  const Vector3d& ray,
                                                  const HandLook& wanted) const {
  if (!hand_) return std::nullopt;
  const HandLook look = effective(wanted);
  const Vector3f eye = eyeMm.cast<float>(), along = ray.cast<float>();
  // How far along the ray a triangle is met (Moeller and Trumbore).
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
  constexpr float kSkinMm = 1.0F;  // a link's surface lies just under its taxels
  for (const HandBody& body : bodies_) {
    if (!isShown(body, look)) continue;
    const Eigen::Isometry3f to =
        (body.link ? pose_.baseFromLink(body.finger, *body.link) : Eigen::Isometry3d::Identity())
            .cast<float>();
    for (std::size_t i = 0; i + 2 < body.triangles.size(); i += 3)
      if (met(to * body.triangles[i].atMm,
              to * body.triangles[i + 1].atMm,
              to * body.triangles[i + 2].atMm) < nearest - kSkinMm)
        return std::nullopt;
  }
  return found;
}

}  // namespace palpate::gui
