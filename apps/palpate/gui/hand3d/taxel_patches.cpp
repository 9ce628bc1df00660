#include "gui/hand3d/taxel_patches.h"

#include <algorithm>
#include <map>

namespace palpate::gui {
namespace {

constexpr float kApart = 2.0F;  // [taxels] between matrices laid flat

template <class Visit>
void eachPlace(const MatrixLayout& layout, Visit visit) {
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) visit(y, x);
}

}  // namespace

void patchesOnHand(const HandPose& pose, const SensorLayout& layout, TaxelPatches& out) {
  out.resize(layout.numCells());
  std::size_t place = 0;
  std::vector<Eigen::Vector3d> grid;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    pose.cornersMm(m, grid);
    eachPlace(matrix, [&](int y, int x) {
      const auto corner = [&](int dy, int dx) {
        const int index = (y + dy) * (matrix.columns + 1) + x + dx;
        return Eigen::Vector3f(grid[static_cast<std::size_t>(index)].cast<float>());
      };
      TaxelPatch& patch = out[place++];
      patch.centreMm = pose.positionMm(m, y, x).cast<float>();
      patch.normal = pose.normal(m, y, x).cast<float>();
      patch.cornersMm = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
      patch.alongX = (corner(0, 1) + corner(1, 1) - corner(0, 0) - corner(1, 0)).normalized();
      patch.alongY = (corner(1, 0) + corner(1, 1) - corner(0, 0) - corner(0, 1)).normalized();
      // The sense of rotation of the corners depends on the surface's frame.
      const Eigen::Vector3f facing =
          (patch.cornersMm[1] - patch.cornersMm[0]).cross(patch.cornersMm[3] - patch.cornersMm[0]);
      if (facing.dot(patch.normal) < 0.0F) std::swap(patch.cornersMm[1], patch.cornersMm[3]);
    });
  }
}

void patchesLaidFlat(const HandDescription& hand, TaxelPatches& out) {
  const SensorLayout& layout = *hand.layout;
  out.resize(layout.numCells());
  // The widest matrix of each column and the highest of each row define the grid.
  std::map<int, float> widths, heights;
  float pitch = 0.0F;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    pitch = std::max(pitch, static_cast<float>(std::max(matrix.pitchMm.x, matrix.pitchMm.y)));
    float& width = widths[hand.matrices[m].pictureColumn];
    float& height = heights[hand.matrices[m].pictureRow];
    width = std::max(width, static_cast<float>(matrix.columns * matrix.pitchMm.x));
    height = std::max(height, static_cast<float>(matrix.rows * matrix.pitchMm.y));
  }
  const auto before = [&](const std::map<int, float>& sizes, int index) {
    float sum = 0.0F;
    for (const auto& [at, size] : sizes)
      if (at < index) sum += size + kApart * pitch;
    return sum;
  };
  const auto whole = [&](const std::map<int, float>& sizes) {
    return sizes.empty() ? 0.0F : before(sizes, sizes.rbegin()->first) + sizes.rbegin()->second;
  };
  const float wholeX = whole(widths), wholeY = whole(heights);
  std::size_t place = 0;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    const auto wide = static_cast<float>(matrix.pitchMm.x);
    const auto high = static_cast<float>(matrix.pitchMm.y);
    const float left = before(widths, hand.matrices[m].pictureColumn) - wholeX / 2.0F;
    const float top = wholeY / 2.0F - before(heights, hand.matrices[m].pictureRow);
    eachPlace(matrix, [&](int y, int x) {
      TaxelPatch& patch = out[place++];
      const Eigen::Vector3f corner(
          left + wide * static_cast<float>(x), top - high * static_cast<float>(y), 0.0F);
      const Eigen::Vector3f right(wide, 0.0F, 0.0F), down(0.0F, -high, 0.0F);
      patch.cornersMm = {corner, corner + down, corner + down + right, corner + right};
      patch.centreMm = corner + 0.5F * (right + down);
      patch.normal = Eigen::Vector3f::UnitZ();
      patch.alongX = Eigen::Vector3f::UnitX();
      patch.alongY = -Eigen::Vector3f::UnitY();
    });
  }
}

}  // namespace palpate::gui
