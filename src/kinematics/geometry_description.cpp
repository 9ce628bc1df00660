#include "palpate/kinematics/geometry_description.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/LU>

#include "palpate/model/hand_description.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

constexpr double kFingerSideMm = 66.0;  // side of the triangle of the fingers' bases
constexpr double kBaseLinkMm = 16.7;
constexpr double kProximalLinkMm = 86.5;
constexpr double kDistalLinkMm = 68.5;
constexpr double kSensorStartMm = 17.5;  // from the joint to the sensor's housing
constexpr double kProximalEdgeMm = 4.1;  // from the housing to the last row
constexpr double kDistalEdgeMm = 4.95;
constexpr double kProximalHeightMm = 15.4;
constexpr double kDistalHeightMm = 14.8;
constexpr double kDistalBendRow = 8.5;

[[noreturn]] void misfit(const std::string& what) {
  throw std::invalid_argument("GeometryDescription: " + what);
}

void validateFinger(const Finger& finger, const std::string& name, std::size_t numAxes) {
  if (!finger.baseMm.allFinite() || !finger.baseRotation.allFinite())
    misfit(name + " stands at a place that is not a number");
  if (!finger.baseRotation.isUnitary(1e-6) || finger.baseRotation.determinant() < 0.0)
    misfit(name + " stands turned by what is no rotation");
  for (const DhLink& link : finger.links) {
    if (link.axis && *link.axis >= numAxes)
      misfit("there is no axis " + std::to_string(*link.axis));
    for (const double value : {link.sign, link.offsetDeg, link.dMm, link.rMm, link.alphaDeg})
      if (!std::isfinite(value)) misfit("a link of " + name + " is not a number");
  }
}

}  // namespace

void GeometryDescription::validate() const {
  if (surfaces.size() != layout.numMatrices())
    misfit(std::to_string(surfaces.size()) + " surfaces for " +
           std::to_string(layout.numMatrices()) + " matrices");
  for (std::size_t f = 0; f < fingers.size(); ++f)
    validateFinger(fingers[f], "finger " + std::to_string(f), numAxes);
  for (std::size_t m = 0; m < surfaces.size(); ++m) {
    const SensorSurface& surface = surfaces[m];
    const std::string name = "matrix " + std::to_string(m);
    if (surface.finger >= fingers.size() || surface.link >= fingers[surface.finger].links.size())
      misfit(name + " sits on a link that isn't there");
    for (const double value :
         {surface.row0Mm, surface.heightMm, surface.column0Mm, surface.bendRow.value_or(0.0)})
      if (!std::isfinite(value)) misfit(name + " lies at a place that is not a number");
    if (surface.bendRow && !(surface.radiusMm > 0.0 && std::isfinite(surface.radiusMm)))
      misfit(name + " is bent with a radius that isn't positive");
  }
}

SurfaceRow surfaceRow(const SensorSurface& surface, double pitchMm, double row) {
  if (!surface.bendRow || row > *surface.bendRow)
    return {surface.row0Mm - pitchMm * row, surface.heightMm, 0.0, 1.0};
  const double angle = (*surface.bendRow - row) * pitchMm / surface.radiusMm;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  return {surface.row0Mm - pitchMm * *surface.bendRow + surface.radiusMm * sine,
          surface.heightMm - surface.radiusMm * (1.0 - cosine),
          sine,
          cosine};
}

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
  // Axis 0 turns the bases of fingers 0 and 2 in opposite directions; finger 1 has a fixed base.
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

}  // namespace palpate
