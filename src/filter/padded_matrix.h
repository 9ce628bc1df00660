// A matrix with its border repeated, for kernels that look around a taxel: rows and columns are
// widened by a radius, and each row by what a block of lanes may read beyond it.
#pragma once

#include <span>
#include <vector>

#include <palpate/model/matrix_layout.h>

namespace palpate::detail {

class PaddedMatrix {
 public:
  PaddedMatrix(const MatrixLayout& layout, int radius);

  // Copies the matrix in; masked places get `maskedValue`.
  void fill(const float* values, float maskedValue);
  // Writes the enabled taxels of a plane laid out like values() into a matrix; changes the others
  // of the plane.
  void writeBack(std::vector<float>& plane, float* values) const;
  // 1 at places that stand for an enabled taxel, else 0, widened like the values.
  std::vector<float> onPlane() const;

  int rows() const noexcept { return layout_.rows; }
  int columns() const noexcept { return layout_.columns; }
  int radius() const noexcept { return radius_; }
  int stride() const noexcept { return stride_; }
  std::size_t size() const noexcept { return values_.size(); }
  // Index of row y, column x; both from -radius to below rows (columns) + radius.
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
