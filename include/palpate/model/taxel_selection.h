// A set of taxels of a sensor: the taxels that a user selected in the window, or those to be
// scanned.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/model/matrix_layout.h>

namespace palpate {

// Only places that hold a taxel can be selected; other places are ignored.
class TaxelSelection {
 public:
  // An empty selection that belongs to no sensor.
  TaxelSelection() = default;
  explicit TaxelSelection(const SensorLayout& layout);

  std::size_t numMatrices() const noexcept { return masks_.size(); }
  std::size_t count() const noexcept;
  bool empty() const noexcept { return count() == 0; }
  // Throws std::out_of_range for a matrix or place that does not exist.
  bool contains(std::size_t matrix, int y, int x) const;
  const Mask& mask(std::size_t matrix) const { return masks_.at(matrix); }

  void clear() noexcept;
  // Adds all taxels of a rectangle, given by two opposite corners, both inclusive, in any order;
  // clamped to the matrix.
  void add(std::size_t matrix, int y0, int x0, int y1, int x1);
  void toggle(std::size_t matrix, int y, int x);
  void addAll(std::size_t matrix);

  // Returns whether both selections are of sensors with the same matrix sizes.
  bool sameSensor(const TaxelSelection& other) const noexcept { return sizes_ == other.sizes_; }
  // Text of a selection, and back: for each matrix the selected places (y * columns + x), for
  // example "1:14,15;5:3". fromText() returns nothing when the text has another form or names a
  // place that holds no taxel of `layout`.
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
