// A set of taxels of a sensor: what a person has chosen, or what is to be scanned.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/model/matrix_layout.h>

namespace palpate {

// Only places with a taxel can be chosen; others are passed over.
class TaxelSelection {
 public:
  TaxelSelection() = default;  // of no sensor
  explicit TaxelSelection(const SensorLayout& layout);

  std::size_t numMatrices() const noexcept { return masks_.size(); }
  std::size_t count() const noexcept;
  bool empty() const noexcept { return count() == 0; }
  // Throws std::out_of_range for a matrix or place that isn't there.
  bool contains(std::size_t matrix, int y, int x) const;
  const Mask& mask(std::size_t matrix) const { return masks_.at(matrix); }

  void clear() noexcept;
  // All taxels within two opposite corners, both inclusive, in any order; clamped to the matrix.
  void add(std::size_t matrix, int y0, int x0, int y1, int x1);
  void toggle(std::size_t matrix, int y, int x);
  void addAll(std::size_t matrix);

  // Whether it is of matrices of the same sizes.
  bool sameSensor(const TaxelSelection& other) const noexcept { return sizes_ == other.sizes_; }
  // "1:14,15;5:3": of each matrix the places (y * columns + x) that are chosen; and back. Nothing:
  // the text is no such list, or names a place that `layout` hasn't.
  std::string text() const;
  static std::optional<TaxelSelection> fromText(std::string_view text, const SensorLayout& layout);

  bool operator==(const TaxelSelection&) const = default;

 private:
  struct Size {
    int rows = 0;
    int columns = 0;
    bool operator==(const Size&) const = default;
  };
  std::vector<Mask> masks_;
  std::vector<Mask> exists_;
  std::vector<Size> sizes_;
};

}  // namespace palpate
