// A matrix with a repeated border, for kernels that use the neighbours of a taxel. Rows and columns
// are extended by a radius, and each row also by what a block of lanes may read beyond its end.
#pragma once

#include <span>
#include <vector>

#include <palpate/model/matrix_layout.h>

namespace palpate::detail {

class PaddedMatrix {
 public:
  PaddedMatrix(const MatrixLayout& layout, int radius);

  // Copies the values of a matrix; masked places get `maskedValue`.
  void fill(const float* values, float maskedValue);
  // Writes the enabled taxels of `plane`, which has the memory order of data(), to a matrix. The
  // other places of the plane are changed.
  void writeBack(std::vector<float>& plane, float* values) const;
  // Returns a plane that is 1 at enabled taxels, otherwise 0, with a border like that of the
  // values.
  std::vector<float> onPlane() const;

  int rows() const noexcept { return layout_.rows; }
  int columns() const noexcept { return layout_.columns; }
  int radius() const noexcept { return radius_; }
  int stride() const noexcept { return stride_; }
  std::size_t size() const noexcept { return values_.size(); }
  // Index of row y, column x in the plane; both may be -radius .. rows (columns) + radius - 1.
  int at(int y, int x) const noexcept { return (y + radius_) * stride_ + x + radius_; }
  bool hasMasked() const noexcept { return !masked_.empty(); }
  const float* data() const noexcept { return values_.data(); }
  const std::vector<float>& values() const noexcept { return values_; }
  const MatrixLayout& layout() const noexcept { return layout_; }

 private:
  MatrixLayout layout_;
  int radius_ = 0;
  int stride_ = 0;
  struct MaskedPlace {
    std::size_t padded;
    std::size_t place;
  };
  std::vector<MaskedPlace> masked_;
  std::vector<float> values_;
};

}  // namespace palpate::detail
