#include "palpate/model/taxel_selection.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace palpate {

TaxelSelection::TaxelSelection(const SensorLayout& layout) {
  for (const MatrixLayout& matrix : layout.matrices()) {
    masks_.emplace_back(matrix.numPlaces(), std::uint8_t{0});
    exists_.push_back(matrix.staticMask);
    sizes_.push_back({matrix.rows, matrix.columns});
  }
}

std::size_t TaxelSelection::count() const noexcept {
  std::size_t chosen = 0;
  for (const Mask& mask : masks_)
    chosen += static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{1}));
  return chosen;
}

bool TaxelSelection::contains(std::size_t matrix, int y, int x) const {
  const Size& size = sizes_.at(matrix);
  if (y < 0 || y >= size.rows || x < 0 || x >= size.columns)
    throw std::out_of_range("TaxelSelection: no place x " + std::to_string(x) + ", y " +
                            std::to_string(y));
  return masks_[matrix][static_cast<std::size_t>(y * size.columns + x)] != 0;
}

void TaxelSelection::clear() noexcept {
  for (Mask& mask : masks_) std::fill(mask.begin(), mask.end(), std::uint8_t{0});
}

void TaxelSelection::add(std::size_t matrix, int y0, int x0, int y1, int x1) {
  const Size& size = sizes_.at(matrix);
  const auto [top, bottom] = std::minmax(y0, y1);
  const auto [left, right] = std::minmax(x0, x1);
  for (int y = std::max(0, top); y <= std::min(size.rows - 1, bottom); ++y)
    for (int x = std::max(0, left); x <= std::min(size.columns - 1, right); ++x) {
      const auto place = static_cast<std::size_t>(y * size.columns + x);
      masks_[matrix][place] = exists_[matrix][place];
    }
}

void TaxelSelection::toggle(std::size_t matrix, int y, int x) {
  if (contains(matrix, y, x))
    masks_[matrix][static_cast<std::size_t>(y * sizes_[matrix].columns + x)] = 0;
  else
    add(matrix, y, x, y, x);
}

void TaxelSelection::addAll(std::size_t matrix) { masks_.at(matrix) = exists_.at(matrix); }

}  // namespace palpate
