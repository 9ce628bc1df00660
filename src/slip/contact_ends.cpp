#include "palpate/slip/contact_ends.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

namespace palpate {
namespace {

constexpr int kMotionUnknowns = 4;
constexpr float kAboveSilence = 2.0F;
constexpr float kAboveNoise = 3.0F;

}  // namespace

double loadAtTwoSides(const MatrixLayout& layout, const ConstMatrixMap& frame) {
  if (frame.rows() != layout.rows || frame.cols() != layout.columns)
    throw std::invalid_argument("loadAtTwoSides: the frame doesn't have the size of the layout");
  const auto isMissing = [&](int y, int x) {
    return y < 0 || x < 0 || y >= layout.rows || x >= layout.columns || !layout.enabled(y, x);
  };
  // Largest reading at the left, right, upper and lower sides.
  std::array<float, 4> sides{};
  float largest = 0.0F;
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      const float value = frame(y, x);
      if (!isTouched(value) || isMissing(y, x)) continue;
      largest = std::max(largest, value);
      if (isMissing(y, x - 1)) sides[0] = std::max(sides[0], value);
      if (isMissing(y, x + 1)) sides[1] = std::max(sides[1], value);
      if (isMissing(y - 1, x)) sides[2] = std::max(sides[2], value);
      if (isMissing(y + 1, x)) sides[3] = std::max(sides[3], value);
    }
  std::sort(sides.begin(), sides.end(), std::greater<>());
  if (!(largest > 0.0F)) return 2.0;
  return static_cast<double>(sides[0] + sides[1]) / static_cast<double>(largest);
}

bool isStrongContact(const ConstMatrixMap& frame, double noiseCounts) noexcept {
  const float* end = frame.data() + frame.size();
  float least = 0.0F;
  for (const float* value = frame.data(); value != end; ++value)
    if (isTouched(*value)) least = least == 0.0F ? *value : std::min(least, *value);
  const float strong =
      kAboveSilence * std::max(least, kAboveNoise * static_cast<float>(noiseCounts));
  return least > 0.0F && std::count_if(frame.data(), end, [&](float value) {
                           return value >= strong;
                         }) > kMotionUnknowns;
}

}  // namespace palpate
