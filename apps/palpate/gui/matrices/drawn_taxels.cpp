#include "gui/matrices/drawn_taxels.h"

#include <algorithm>

#include <palpate/model/touch.h>

namespace palpate::gui {

bool hasSign(const SensorLayout& layout) {
  return std::ranges::any_of(layout.matrices(),
                             [](const MatrixLayout& matrix) { return matrix.touch.isSigned; });
}

bool hasShear(const SensorLayout& layout) {
  return std::ranges::any_of(
      layout.matrices(), [](const MatrixLayout& matrix) { return matrix.touch.components == 3; });
}

bool isDrawnSigned(const TactileFrame& frame, TaxelView view) {
  return view == TaxelView::kNormal && !frame.readings.empty() && hasSign(*frame.layout);
}

MatrixValues drawnValues(const TactileFrame& frame, std::size_t matrix, TaxelView view) {
  if (frame.readings.empty()) return frame.allValues(matrix);
  const MatrixLayout& layout = frame.layout->matrix(matrix);
  MatrixValues drawn = MatrixValues::Zero(layout.rows, layout.columns);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      if (!layout.enabled(y, x)) continue;
      const std::array<float, 3> force = forceAt(frame, {matrix, y, x});
      drawn(y, x) = view == TaxelView::kNormal
                        ? force[2]
                        : Eigen::Map<const Eigen::Vector3f>(force.data()).norm();
    }
  return drawn;
}

double largestDrawn(const TactileFrame& frame, TaxelView view) {
  double largest = 0.0;
  if (frame.readings.empty()) return largest;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m)
    largest =
        std::max(largest, static_cast<double>(drawnValues(frame, m, view).cwiseAbs().maxCoeff()));
  return largest;
}

QPointF shearAt(const TactileFrame& frame, const TaxelPlace& place) {
  if (frame.readings.empty() || !isTouched(frame.matrix(place.matrix)(place.y, place.x))) return {};
  const std::array<float, 3> force = forceAt(frame, place);
  return {static_cast<double>(force[0]), static_cast<double>(force[1])};
}

}  // namespace palpate::gui
