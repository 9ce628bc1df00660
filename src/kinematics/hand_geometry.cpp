#include "palpate/kinematics/hand_geometry.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/model/hand_description.h"

namespace palpate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// --- the SDH-2 ------------------------------------------------------------------------------------

constexpr double kFingerSideMm = 66.0;  // of the triangle of the fingers' bases
constexpr double kBaseLinkMm = 16.7;
constexpr double kProximalLinkMm = 86.5;
constexpr double kDistalLinkMm = 68.5;
constexpr double kSensorStartMm = 17.5;  // from the joint to the sensor's housing
constexpr double kProximalEdgeMm = 4.1;  // from there to the last row
constexpr double kDistalEdgeMm = 4.95;
constexpr double kProximalHeightMm = 15.4;
constexpr double kDistalHeightMm = 14.8;
constexpr double kDistalBendRow = 8.5;

// Exact at multiples of a right angle, so that a straight finger is straight.
double sinDeg(double deg) {
  const double turn = std::remainder(deg, 360.0);
  if (turn == 0.0 || std::abs(turn) == 180.0) return 0.0;
  if (std::abs(turn) == 90.0) return turn > 0.0 ? 1.0 : -1.0;
  return std::sin(turn * std::numbers::pi / 180.0);
}
double cosDeg(double deg) { return sinDeg(deg + 90.0); }

struct SurfacePoint {
  double xMm, yMm, normalX, normalY;
};

SurfacePoint surfaceAt(const SensorSurface& surface, double pitchMm, double row) {
  if (!surface.bendRow || row > *surface.bendRow)
    return {surface.row0Mm - pitchMm * row, surface.heightMm, 0.0, 1.0};
  const double angle = (*surface.bendRow - row) * pitchMm / surface.radiusMm;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  return {surface.row0Mm - pitchMm * *surface.bendRow + surface.radiusMm * sine,
          surface.heightMm - surface.radiusMm * (1.0 - cosine),
          sine,
          cosine};
}

[[noreturn]] void misfit(const std::string& what) {
  throw std::invalid_argument("GeometryDescription: " + what);
}

}  // namespace

GeometryDescription sdh2Geometry(double fingertipRadiusMm) {
  if (!(fingertipRadiusMm > 0.0 && std::isfinite(fingertipRadiusMm)))
    throw std::invalid_argument("sdh2Geometry: fingertip radius must be positive");
  GeometryDescription hand;
  hand.layout = *sdh2().layout;
  hand.numAxes = sdh2().axes.size();
  const double inner = kFingerSideMm / 2.0 / std::sqrt(3.0);
  const double outer = kFingerSideMm / std::sqrt(3.0);
  const Vector3d bases[] = {
      {inner, -kFingerSideMm / 2.0, 0.0}, {-outer, 0.0, 0.0}, {inner, kFingerSideMm / 2.0, 0.0}};
  // The base of fingers 0 and 2 turns against each other by axis 0; finger 1 doesn't turn.
  const DhLink turns[] = {{0, -1.0, 0.0, kBaseLinkMm, 0.0, -90.0},
                          {std::nullopt, 1.0, 180.0, kBaseLinkMm, 0.0, -90.0},
                          {0, 1.0, 0.0, kBaseLinkMm, 0.0, -90.0}};
  for (std::size_t f = 0; f < 3; ++f) {
    Finger finger;
    finger.baseMm = bases[f];
    finger.baseRotation = Vector3d(-1.0, -1.0, 1.0).asDiagonal();
    finger.links = {turns[f],
                    {2 * f + 1, 1.0, -90.0, 0.0, kProximalLinkMm, 0.0},
                    {2 * f + 2, 1.0, 0.0, 0.0, kDistalLinkMm, 0.0}};
    hand.fingers.push_back(std::move(finger));
    const MatrixLayout& proximal = hand.layout.matrix(2 * f);
    const MatrixLayout& distal = hand.layout.matrix(2 * f + 1);
    const auto column0 = [](const MatrixLayout& matrix) {
      return -matrix.pitchMm * (matrix.columns - 1) / 2.0;
    };
    hand.surfaces.push_back({f,
                             1,
                             (proximal.rows - 1) * proximal.pitchMm - kProximalLinkMm +
                                 kSensorStartMm + kProximalEdgeMm,
                             kProximalHeightMm,
                             column0(proximal),
                             std::nullopt,
                             0.0});
    hand.surfaces.push_back(
        {f,
         2,
         (distal.rows - 1) * distal.pitchMm - kDistalLinkMm + kSensorStartMm + kDistalEdgeMm,
         kDistalHeightMm,
         column0(distal),
         kDistalBendRow,
         fingertipRadiusMm});
  }
  return hand;
}

// --- poses ----------------------------------------------------------------------------------------

HandGeometry::HandGeometry(GeometryDescription description) : description_(std::move(description)) {
  if (description_.surfaces.size() != description_.layout.numMatrices())
    misfit(std::to_string(description_.surfaces.size()) + " surfaces for " +
           std::to_string(description_.layout.numMatrices()) + " matrices");
  for (const Finger& finger : description_.fingers)
    for (const DhLink& link : finger.links)
      if (link.axis && *link.axis >= description_.numAxes)
        misfit("there is no axis " + std::to_string(*link.axis));
  for (std::size_t m = 0; m < description_.surfaces.size(); ++m) {
    const SensorSurface& surface = description_.surfaces[m];
    if (surface.finger >= description_.fingers.size() ||
        surface.link >= description_.fingers[surface.finger].links.size())
      misfit("matrix " + std::to_string(m) + " sits on a link that isn't there");
    if (surface.bendRow && !(surface.radiusMm > 0.0))
      misfit("matrix " + std::to_string(m) + " is bent with a radius that isn't positive");
    const MatrixLayout& layout = description_.layout.matrix(m);
    std::vector<Row> rows;
    for (int y = 0; y < layout.rows; ++y) {
      const SurfacePoint at = surfaceAt(surface, layout.pitchMm, y);
      rows.push_back({at.xMm, at.yMm, at.normalX, at.normalY});
    }
    rows_.push_back(std::move(rows));
  }
}

HandPose HandGeometry::pose(const std::vector<double>& anglesDeg) const {
  HandPose out;
  pose(anglesDeg, out);
  return out;
}

void HandGeometry::pose(const std::vector<double>& anglesDeg, HandPose& out) const {
  if (anglesDeg.size() != description_.numAxes)
    throw std::invalid_argument("HandGeometry: " + std::to_string(anglesDeg.size()) +
                                " angles for " + std::to_string(description_.numAxes) + " axes");
  for (std::size_t i = 0; i < anglesDeg.size(); ++i)
    if (!std::isfinite(anglesDeg[i]))
      throw std::invalid_argument("HandGeometry: angle " + std::to_string(i) + " is not a number");

  out.description_ = &description_;
  out.frames_.resize(description_.surfaces.size());
  out.jointLines_.clear();
  for (std::size_t f = 0; f < description_.fingers.size(); ++f) {
    const Finger& finger = description_.fingers[f];
    Matrix3d rotation = finger.baseRotation;
    Vector3d originMm = finger.baseMm;
    for (std::size_t l = 0; l < finger.links.size(); ++l) {
      const DhLink& link = finger.links[l];
      if (link.axis)
        out.jointLines_.push_back({*link.axis, f, l, originMm, link.sign * rotation.col(2)});
      const double thetaDeg =
          (link.axis ? link.sign * anglesDeg[*link.axis] : 0.0) + link.offsetDeg;
      const double ct = cosDeg(thetaDeg), st = sinDeg(thetaDeg);
      const double ca = cosDeg(link.alphaDeg), sa = sinDeg(link.alphaDeg);
      originMm += rotation * Vector3d(link.rMm * ct, link.rMm * st, link.dMm);
      Matrix3d turn;
      turn << ct, -st * ca, st * sa, st, ct * ca, -ct * sa, 0.0, sa, ca;
      rotation = (rotation * turn).eval();
      for (std::size_t m = 0; m < description_.surfaces.size(); ++m)
        if (description_.surfaces[m].finger == f && description_.surfaces[m].link == l)
          out.frames_[m] = {rotation, originMm};
    }
  }

  out.positionsMm_.resize(description_.layout.numPlaces());
  out.normals_.resize(description_.layout.numPlaces());
  std::size_t place = 0;
  for (std::size_t m = 0; m < out.frames_.size(); ++m) {
    const HandPose::Frame& frame = out.frames_[m];
    const MatrixLayout& layout = description_.layout.matrix(m);
    const Vector3d across = frame.rotation.col(2);
    for (const Row& row : rows_[m]) {
      const Vector3d normal =
          frame.rotation.col(0) * row.normalX + frame.rotation.col(1) * row.normalY;
      const Vector3d middle =
          frame.originMm + frame.rotation.col(0) * row.xMm + frame.rotation.col(1) * row.yMm;
      for (int x = 0; x < layout.columns; ++x, ++place) {
        out.positionsMm_[place] =
            middle + across * (description_.surfaces[m].column0Mm + layout.pitchMm * x);
        out.normals_[place] = normal;
      }
    }
  }
}

namespace {

std::size_t placeOf(const SensorLayout& layout, std::size_t matrix, int y, int x) {
  const MatrixLayout& of = layout.matrix(matrix);
  if (y < 0 || y >= of.rows || x < 0 || x >= of.columns)
    throw std::out_of_range("matrix " + std::to_string(matrix) + " has no place (" +
                            std::to_string(x) + ", " + std::to_string(y) + ")");
  return layout.offset(matrix) + static_cast<std::size_t>(y * of.columns + x);
}

void requireFinite(double xMm, double yMm) {
  if (!std::isfinite(xMm) || !std::isfinite(yMm))
    throw std::invalid_argument("HandPose: a point that is not a number");
}

}  // namespace

const Vector3d& HandPose::positionMm(std::size_t matrix, int y, int x) const {
  return positionsMm_[placeOf(description_->layout, matrix, y, x)];
}

const Vector3d& HandPose::normal(std::size_t matrix, int y, int x) const {
  return normals_[placeOf(description_->layout, matrix, y, x)];
}

Vector3d HandPose::pointMm(std::size_t matrix, double xMm, double yMm) const {
  requireFinite(xMm, yMm);
  const SensorSurface& surface = description_->surfaces.at(matrix);
  const double pitchMm = description_->layout.matrix(matrix).pitchMm;
  const SurfacePoint at = surfaceAt(surface, pitchMm, yMm / pitchMm);
  const Frame& frame = frames_[matrix];
  return frame.originMm + frame.rotation * Vector3d(at.xMm, at.yMm, surface.column0Mm + xMm);
}

Vector3d HandPose::normalAt(std::size_t matrix, double xMm, double yMm) const {
  requireFinite(xMm, yMm);
  const SensorSurface& surface = description_->surfaces.at(matrix);
  const double pitchMm = description_->layout.matrix(matrix).pitchMm;
  const SurfacePoint at = surfaceAt(surface, pitchMm, yMm / pitchMm);
  return frames_[matrix].rotation * Vector3d(at.normalX, at.normalY, 0.0);
}

}  // namespace palpate
