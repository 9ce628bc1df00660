#include "emulator/pad_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate {
namespace {

constexpr double kDeepestMm = 8.0;  // no rubber is thicker
// margin of the quick check, because surfaces are curved
constexpr double kPadContactReachMm = 8.0;
constexpr double kFacing = 0.0;  // normals of touching pads point towards each other

double radiusMm(const MatrixLayout& matrix) {
  return std::hypot(matrix.rows * matrix.pitchMm.y, matrix.columns * matrix.pitchMm.x) / 2.0;
}

bool mayMeet(const GeometryDescription& hand, const HandPose& pose, std::size_t a, std::size_t b) {
  const MatrixLayout &first = hand.layout.matrix(a), &second = hand.layout.matrix(b);
  const Eigen::Vector3d apart = pose.positionMm(a, first.rows / 2, first.columns / 2) -
                                pose.positionMm(b, second.rows / 2, second.columns / 2);
  const double reach = radiusMm(first) + radiusMm(second) + kPadContactReachMm;
  return apart.squaredNorm() < reach * reach;
}

// Matrices of one finger, and those on the palm, don't press on each other.
bool sameBody(const LinkPlace& a, const LinkPlace& b) {
  return a.link && b.link ? a.finger == b.finger : !a.link && !b.link;
}

// A surface that is described by its taxels: the depth behind the plane of the nearest one.
double depthBehindTaxels(const GeometryDescription& hand,
                         const HandPose& pose,
                         std::size_t matrix,
                         const Eigen::Vector3d& pointMm) {
  const MatrixLayout& layout = hand.layout.matrix(matrix);
  const std::size_t first = hand.layout.offset(matrix);
  std::size_t nearest = first;
  double leastMm2 = std::numeric_limits<double>::infinity();
  for (std::size_t place = first; place < first + layout.numCells(); ++place) {
    const double apartMm2 = (pose.positionsMm()[place] - pointMm).squaredNorm();
    if (apartMm2 >= leastMm2) continue;
    leastMm2 = apartMm2;
    nearest = place;
  }
  const Eigen::Vector3d apart = pose.positionsMm()[nearest] - pointMm;
  const double depth = apart.dot(pose.normals()[nearest]);
  const double besideMm = (apart - depth * pose.normals()[nearest]).norm();
  return depth > 0.0 && depth < kDeepestMm &&
                 besideMm <= std::max(layout.pitchMm.x, layout.pitchMm.y)
             ? depth
             : 0.0;
}

}  // namespace

double depthBehindPad(const GeometryDescription& hand,
                      const HandPose& pose,
                      std::size_t matrix,
                      const Eigen::Vector3d& pointMm) {
  const SensorSurface& surface = hand.surfaces.at(matrix);
  const MatrixLayout& layout = hand.layout.matrix(matrix);
  if (!surface.positionsMm.empty()) return depthBehindTaxels(hand, pose, matrix, pointMm);
  const Eigen::Vector3d at = pose.baseFromMatrix(matrix).inverse(Eigen::Isometry) * pointMm;
  const double column = at.x() / layout.pitchMm.x;
  double row = at.y() / layout.pitchMm.y;
  if (surface.bendRow && row < *surface.bendRow) {
    const double sine = (*surface.bendRow - row) * layout.pitchMm.y / surface.radiusMm;
    if (sine >= 1.0) return 0.0;
    row = *surface.bendRow - std::asin(sine) * surface.radiusMm / layout.pitchMm.y;
  }
  if (column < -0.5 || column > layout.columns - 0.5 || row < -0.5 || row > layout.rows - 0.5)
    return 0.0;
  const SurfaceRow there = surfaceRow(surface, layout.pitchMm, row);
  const double depth = (there.zMm - at.z()) * there.normalZ;
  return depth > 0.0 && depth < kDeepestMm ? depth : 0.0;
}

void findPadContacts(
    const HandPose& pose,
    const std::function<void(std::size_t matrix, int y, int x, double depthMm)>& touch) {
  const GeometryDescription& hand = pose.description();
  const std::size_t count = hand.surfaces.size();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      if (sameBody(hand.surfaces[a].place, hand.surfaces[b].place) || !mayMeet(hand, pose, a, b))
        continue;
      const MatrixLayout& layout = hand.layout.matrix(a);
      const Eigen::Vector3d facing = -pose.baseFromMatrix(b).linear().col(2);
      std::size_t place = hand.layout.offset(a);
      for (int y = 0; y < layout.rows; ++y)
        for (int x = 0; x < layout.columns; ++x, ++place) {
          if (!layout.exists(y, x) || pose.normals()[place].dot(facing) >= kFacing) continue;
          const double depth = depthBehindPad(hand, pose, b, pose.positionsMm()[place]);
          if (depth > 0.0) touch(a, y, x, depth);
        }
    }
}

}  // namespace palpate
