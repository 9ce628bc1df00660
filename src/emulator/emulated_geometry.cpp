#include "palpate/emulator/emulated_geometry.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace palpate {
namespace {

// The beginning of each column or row of the picture [mm], in order.
std::map<int, double> beginnings(const std::map<int, double>& sizesMm) {
  double sumMm = 0.0;
  for (const auto& [index, sizeMm] : sizesMm) sumMm += sizeMm;
  std::map<int, double> begins;
  double atMm = -sumMm / 2.0;
  for (const auto& [index, sizeMm] : sizesMm) {
    begins[index] = atMm;
    atMm += sizeMm;
  }
  return begins;
}

using PictureCell = std::pair<int, int>;  // column, row

// The cell of each matrix in the picture; side by side when the description gives one cell to two.
std::vector<PictureCell> pictureCells(const HandDescription& hand) {
  std::vector<PictureCell> cells;
  for (const MatrixDescription& matrix : hand.matrices)
    cells.emplace_back(matrix.pictureColumn, matrix.pictureRow);
  if (std::set<PictureCell>(cells.begin(), cells.end()).size() != cells.size())
    for (std::size_t m = 0; m < cells.size(); ++m) cells[m] = {static_cast<int>(m), 0};
  return cells;
}

GeometryDescription planeOf(const HandDescription& hand) {
  const std::vector<PictureCell> cells = pictureCells(hand);
  GeometryDescription plane;
  plane.numAxes = hand.axes.size();
  plane.layout = *hand.layout;
  std::map<int, double> widthsMm, heightsMm;  // of the picture's columns and rows
  for (std::size_t m = 0; m < hand.matrices.size(); ++m) {
    const MatrixLayout& matrix = plane.layout.matrix(m);
    double& width = widthsMm[cells[m].first];
    double& height = heightsMm[cells[m].second];
    width = std::max(width, (matrix.columns + 1) * matrix.pitchMm.x);
    height = std::max(height, (matrix.rows + 1) * matrix.pitchMm.y);
  }
  const std::map<int, double> lefts = beginnings(widthsMm), tops = beginnings(heightsMm);
  for (std::size_t m = 0; m < hand.matrices.size(); ++m) {
    const TaxelPitch& pitchMm = plane.layout.matrix(m).pitchMm;
    SensorSurface surface;
    // x to the right, y down, z into the body.
    surface.linkFromSurface.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    surface.linkFromSurface.translation() = Eigen::Vector3d(
        lefts.at(cells[m].first) + pitchMm.x, -tops.at(cells[m].second) - pitchMm.y, 0.0);
    plane.surfaces.push_back(surface);
  }
  return plane;
}

}  // namespace

GeometryDescription emulatedGeometry(const HandDescription& hand) {
  return hasGeometry(hand) ? describeGeometry(hand) : planeOf(hand);
}

}  // namespace palpate
