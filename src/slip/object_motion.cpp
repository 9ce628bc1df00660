#include "palpate/slip/object_motion.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/SVD>

namespace palpate {
namespace {

constexpr double kObjectMotionRadians = std::numbers::pi / 180.0;
// Smallest singular value that is used, relative to the largest one.
constexpr double kMinSingular = 1e-3;

}  // namespace

SlipArrow slipArrow(const HandPose& pose,
                    std::size_t matrix,
                    const TaxelPitch& pitchMm,
                    double x,
                    double y,
                    double dx,
                    double dy,
                    std::optional<double> turnDeg,
                    double weight) {
  if (!std::isfinite(dx) || !std::isfinite(dy) || !(pitchMm.x > 0.0) || !(pitchMm.y > 0.0) ||
      !(weight > 0.0) || !std::isfinite(weight) || (turnDeg && !std::isfinite(*turnDeg)))
    throw std::invalid_argument("slipArrow: motion, pitch or weight is invalid");
  const Eigen::Isometry3d surface = pose.baseFromSurface(matrix, x * pitchMm.x, y * pitchMm.y);
  SlipArrow arrow;
  arrow.matrix = matrix;
  arrow.originMm = surface.translation();
  arrow.alongX = surface.linear().col(0);
  // The Y axis of the surface points to the fingertip, while rows rise towards the palm.
  arrow.alongY = -surface.linear().col(1);
  arrow.normal = surface.linear().col(2);
  arrow.vectorMm =
      pitchMm.isSquare()
          ? Eigen::Vector3d(pitchMm.x * (dx * arrow.alongX + dy * arrow.alongY))
          : Eigen::Vector3d(pitchMm.x * dx * arrow.alongX + pitchMm.y * dy * arrow.alongY);
  if (turnDeg) arrow.turnRad = -*turnDeg * kObjectMotionRadians;
  arrow.weight = weight;
  return arrow;
}

ObjectMotion objectMotion(std::span<const SlipArrow> arrows) {
  ObjectMotion motion;
  motion.contacts = arrows.size();
  if (arrows.empty()) return motion;
  for (const SlipArrow& arrow : arrows) {
    if (!arrow.originMm.allFinite() || !arrow.vectorMm.allFinite() || !(arrow.weight > 0.0) ||
        !std::isfinite(arrow.weight))
      throw std::invalid_argument("objectMotion: an arrow isn't finite, or has no weight");
    motion.centerMm += arrow.originMm / static_cast<double>(arrows.size());
  }
  double distance = 0.0;
  for (const SlipArrow& arrow : arrows)
    distance += (arrow.originMm - motion.centerMm).norm() / static_cast<double>(arrows.size());
  // Length [mm] that makes rotations comparable to translations.
  const double scale = distance > 1e-6 ? distance : 1.0;

  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  std::vector<double> right;
  const auto add = [&](const SlipArrow& arrow, const Eigen::Vector3d& tangent) {
    const Eigen::Vector3d lever = (arrow.originMm - motion.centerMm).cross(tangent) / scale;
    const double root = std::sqrt(arrow.weight);
    Eigen::Matrix<double, 1, 6> row;
    row << tangent.transpose(), lever.transpose();
    rows.push_back(root * row);
    right.push_back(root * tangent.dot(arrow.vectorMm));
  };
  double weights = 0.0;
  for (const SlipArrow& arrow : arrows) {
    add(arrow, arrow.alongX);
    add(arrow, arrow.alongY);
    weights += 2.0 * arrow.weight;
  }
  const std::size_t tangents = rows.size();
  for (const SlipArrow& arrow : arrows)
    if (arrow.turnRad) {
      // The rotation is scaled to a path at the mean distance of the contacts.
      const double root = std::sqrt(arrow.weight);
      Eigen::Matrix<double, 1, 6> row;
      row << 0.0, 0.0, 0.0, arrow.normal.transpose();
      rows.push_back(root * row);
      right.push_back(root * scale * *arrow.turnRad);
    }

  const auto numRows = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd system(numRows, 6);
  Eigen::VectorXd known(numRows);
  for (Eigen::Index i = 0; i < numRows; ++i) {
    system.row(i) = rows[static_cast<std::size_t>(i)];
    known(i) = right[static_cast<std::size_t>(i)];
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> solver(system, Eigen::ComputeThinU | Eigen::ComputeFullV);
  solver.setThreshold(kMinSingular);
  motion.rank = static_cast<int>(solver.rank());
  const Eigen::VectorXd solved = solver.solve(known);
  motion.translationMm = solved.head<3>();
  motion.rotationRad = solved.tail<3>() / scale;
  const Eigen::VectorXd residual =
      (system * solved - known).head(static_cast<Eigen::Index>(tangents));
  motion.residualMm = std::sqrt(residual.squaredNorm() / weights);
  for (int i = motion.rank; i < 6; ++i) motion.unknown.emplace_back(solver.matrixV().col(i));
  return motion;
}

}  // namespace palpate
