// What the drawing of a hand adds of slip: an arrow at every contact that moves, and how the object moves, as the arrows
// of all contacts together tell.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include <palpate/slip/object_motion.h>

#include "gui/look/captions.h"
#include "gui/space/hand_drawing.h"

namespace palpate::gui {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kHandDrawingSlipLeastMm = 0.2;  // motion that is drawn
constexpr double kLeastTurnDeg = 1.0;
// Within the arrows' time: more is what contacts in one line make of noise.
constexpr double kMostMm = 40.0;
constexpr double kMostDeg = 60.0;
constexpr double kLiftMm = 1.2;  // above the surface
constexpr double kHeadMm = 5.0;
constexpr double kArcMm = 22.0;  // radius of the object's turn
constexpr int kArcSteps = 24;
constexpr float kContactPx = 3.0F;
constexpr float kObjectPx = 4.5F;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr int kLeastRank = 2;  // fewer numbers of six tell nothing of an object
constexpr int kWholeRank = 6;

void addHead(
    HandScene& scene, const Vector3d& tip, const Vector3d& along, float widthPx, QRgb color) {
  const Vector3d side = along.unitOrthogonal(), other = along.cross(side);
  for (const Vector3d& way : {side, Vector3d(-side), other, Vector3d(-other)})
    scene.lines.push_back({tip.cast<float>(),
                           (tip - kHeadMm * along + 0.45 * kHeadMm * way).cast<float>(),
                           widthPx,
                           color});
}

void addArrow(
    HandScene& scene, const Vector3d& from, const Vector3d& way, float widthPx, QRgb color) {
  const Vector3d tip = from + way;
  scene.lines.push_back({from.cast<float>(), tip.cast<float>(), widthPx, color});
  addHead(scene, tip, way.normalized(), widthPx, color);
}

// Of a turn about an axis through `centre`, as far as it turns.
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

}  // namespace

void HandDrawing::addSlip(HandScene& scene, const HandLook& look) const {
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
    if (mm < kHandDrawingSlipLeastMm || (look.only && *look.only != slip.matrix)) continue;
    const QColor color = slip.slipping ? colors.danger : colors.text;
    const Vector3d from = arrow.originMm + kLiftMm * arrow.normal;
    const Vector3d way = static_cast<double>(kSlipEnlarged) * arrow.vectorMm;
    addArrow(scene, from, way, kContactPx, color.rgb());
    scene.labels.push_back({from + way, figure(mm, 1) + " mm", color});
  }
  // Of an object only while something slips: else it is noise, and what the load does.
  // Where the fingers are has to be known.
  if (!moves || arrows.size() < 2 || look.only || !posed()) return;
  const ObjectMotion object = objectMotion(arrows);
  if (object.rank < kLeastRank) return;
  const double mm = object.translationMm.norm(), deg = object.rotationRad.norm() * kDegPerRad;
  if (mm > kMostMm || deg > kMostDeg) return;
  const QColor color = colors.accent;
  const double enlarged = static_cast<double>(kSlipEnlarged);
  if (mm >= kHandDrawingSlipLeastMm)
    addArrow(scene, object.centerMm, enlarged * object.translationMm, kObjectPx, color.rgb());
  if (deg >= kLeastTurnDeg)
    addTurn(scene, object.centerMm, enlarged * object.rotationRad, color.rgb());
  QString words = "object " + figure(mm, 1) + " mm, " + figure(deg, 0) + "°";
  if (object.rank < kWholeRank) words += " (" + QString::number(object.rank) + " of 6 known)";
  words += ", residual " + figure(object.residualMm, 1) + " mm";
  scene.labels.push_back({object.centerMm + enlarged * object.translationMm, words, color});
}

}  // namespace palpate::gui
