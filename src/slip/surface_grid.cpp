#include "palpate/slip/surface_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "slip/surface_readings.h"

namespace palpate {

// The margin, and one knot more for the reach of the spline, lie before the first taxel.
SurfaceGrid::SurfaceGrid(const MatrixLayout& layout, int border)
    : before_(2 * kMargin + 1 + border),
      columns_(2 * layout.columns + 2 * before_),
      rows_(2 * layout.rows + 2 * before_) {
  if (border < 0) throw std::invalid_argument("SurfaceGrid: border is " + std::to_string(border));
  const auto size = static_cast<std::size_t>(columns_ * rows_);
  coefficients_.resize(size);
  variances_.resize(size);
}

// Coefficients of the same surface with half the knot distance: filter (1 4 6 4 1)/8 along either
// axis.
void SurfaceGrid::begin(const KeyFrame& key,
                        const std::vector<float>& ofTaxels,
                        float largest,
                        const Uncertainty& beyond) noexcept {
  const int rows = key.layout().rows;
  const int columns = key.layout().columns;
  const float* filled = key.filled().data();
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int halfY = row - before_;
      const int halfX = column - before_;
      const int y = static_cast<int>(std::floor(0.5 * halfY));
      const int x = static_cast<int>(std::floor(0.5 * halfX));
      const bool oddY = halfY != 2 * y;
      const bool oddX = halfX != 2 * x;
      float value = 0.0F;
      for (int j = -1; j <= 1; ++j) {
        const float weightY = oddY ? (j < 0 ? 0.0F : 0.5F) : (j == 0 ? 0.75F : 0.125F);
        if (weightY == 0.0F) continue;
        for (int i = -1; i <= 1; ++i) {
          const float weightX = oddX ? (i < 0 ? 0.0F : 0.5F) : (i == 0 ? 0.75F : 0.125F);
          if (weightX != 0.0F) value += weightY * weightX * key.coefficient(y + j, x + i);
        }
      }
      const auto place = static_cast<std::size_t>(row * columns_ + column);
      const bool isOutside =
          halfX < -1 || halfY < -1 || halfX > 2 * columns - 1 || halfY > 2 * rows - 1;
      const int nearX = std::clamp(x, 0, columns - 1);
      const int nearY = std::clamp(y, 0, rows - 1);
      const int nextX = std::clamp(x + (oddX ? 1 : 0), 0, columns - 1);
      const int nextY = std::clamp(y + (oddY ? 1 : 0), 0, rows - 1);
      const auto taxel = [&](int ty, int tx) {
        return ofTaxels[static_cast<std::size_t>(ty * columns + tx)];
      };
      variances_[place] = 0.25F * (taxel(nearY, nearX) + taxel(nearY, nextX) + taxel(nextY, nearX) +
                                   taxel(nextY, nextX));
      if (isOutside) {
        value = std::clamp(value, 0.0F, largest);
        variances_[place] +=
            isTouched(filled[nearY * columns + nearX]) ? beyond.outside : beyond.silence;
      }
      coefficients_[place] = value;
    }
}

SurfaceGrid::Sample SurfaceGrid::at(float x, float y) const noexcept {
  return registration::sampleOf(*this, x, y);
}

}  // namespace palpate
