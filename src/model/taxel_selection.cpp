#include "palpate/model/taxel_selection.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>

namespace palpate {

TaxelSelection::TaxelSelection(const SensorLayout& layout) {
  for (const MatrixLayout& matrix : layout.matrices()) {
    masks_.emplace_back(matrix.numCells(), std::uint8_t{0});
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

std::string TaxelSelection::text() const {
  std::string out;
  for (std::size_t m = 0; m < masks_.size(); ++m) {
    char before = ':';
    for (std::size_t i = 0; i < masks_[m].size(); ++i) {
      if (masks_[m][i] == 0) continue;
      if (before == ':') out += (out.empty() ? "" : ";") + std::to_string(m);
      out += before + std::to_string(i);
      before = ',';
    }
  }
  return out;
}

std::optional<TaxelSelection> TaxelSelection::fromText(std::string_view text,
                                                       const SensorLayout& layout) {
  TaxelSelection selection(layout);
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&](std::size_t& value) {
    const auto [next, failure] = std::from_chars(at, end, value);
    if (failure != std::errc()) return false;
    at = next;
    return true;
  };
  while (at != end) {
    std::size_t matrix = 0;
    if (!number(matrix) || matrix >= selection.masks_.size() || at == end || *at != ':')
      return std::nullopt;
    Mask& mask = selection.masks_[matrix];
    do {
      ++at;  // ':' or ','
      std::size_t place = 0;
      if (!number(place) || place >= mask.size() || selection.exists_[matrix][place] == 0)
        return std::nullopt;
      mask[place] = 1;
    } while (at != end && *at == ',');
    if (at == end) break;
    if (*at != ';' || ++at == end) return std::nullopt;
  }
  return selection;
}

}  // namespace palpate
