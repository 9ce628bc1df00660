// The surface of a contact as a cubic B-spline with a knot every half taxel, and how uncertain it
// is: each coefficient has a variance. LearnedSurface and MostProbableSurface differ in how they
// estimate the coefficients.
// x = column, y = row, in taxels; the surface reaches kMargin taxels beyond the outer taxels.
#pragma once

#include <vector>

#include <palpate/slip/key_frame.h>

namespace palpate {

class SurfaceGrid {
 public:
  static constexpr int kMargin = 2;  // [taxels]

  struct Sample {
    float value = 0.0F;
    float alongX = 0.0F;  // [counts per taxel]
    float alongY = 0.0F;
    // Variance of the value [counts^2].
    float variance = 0.0F;
  };
  // Variances with which a surface begins [counts^2].
  struct Uncertainty {
    // Outside of the matrix, beside an active taxel.
    float outside = 0.0F;
    // Outside of the matrix, beside a taxel below the threshold.
    float silence = 0.0F;
  };

  // border: number of coefficients beyond those that the surface depends on, on every side, >= 0.
  // Throws std::invalid_argument.
  explicit SurfaceGrid(const MatrixLayout& layout, int border = 0);

  // Begins with the surface of a key frame of this matrix, limited to 0..`largest` [counts]
  // outside of the matrix. ofTaxels: variance at each taxel, row by row [counts^2].
  void begin(const KeyFrame& key,
             const std::vector<float>& ofTaxels,
             float largest,
             const Uncertainty& beyond) noexcept;
  // Value of the surface at x within -kMargin .. columns - 1 + kMargin; y alike [taxels].
  Sample at(float x, float y) const noexcept;

  // Number of coefficients along y and x.
  int rows() const noexcept { return rows_; }
  int columns() const noexcept { return columns_; }
  // Index of the first of the 4 x 4 coefficients around a place whose last knot before it along
  // either axis is this one, counted in half taxels from the centre of the first taxel.
  int cornerOf(int halfY, int halfX) const noexcept {
    return (halfY + before_ - 1) * columns_ + halfX + before_ - 1;
  }
  // Row by row.
  float* coefficients() noexcept { return coefficients_.data(); }
  const float* coefficients() const noexcept { return coefficients_.data(); }
  float* variances() noexcept { return variances_.data(); }
  const float* variances() const noexcept { return variances_.data(); }

 private:
  // Number of knots before the first taxel.
  int before_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> coefficients_;
  std::vector<float> variances_;
};

}  // namespace palpate
