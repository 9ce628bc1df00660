// What the views draw of readings with a sign or three components: their normal component with its
// sign, or their magnitude; and their shear as arrows.
#pragma once

#include <QPointF>

#include <palpate/model/tactile_frame.h>

#include "gui/appearance/taxel_view.h"

namespace palpate::gui {

// Whether a matrix has readings with a sign; three components, of which arrows are drawn.
bool hasSign(const SensorLayout& layout);
bool hasShear(const SensorLayout& layout);
// Whether values have a sign in this view: the frame has readings, and a matrix of it has a sign.
bool isDrawnSigned(const TactileFrame& frame, TaxelView view);
// The values of a matrix as they are drawn [unit of the readings]; a frame without readings gives
// allValues(). Throws std::out_of_range for a matrix that does not exist.
MatrixValues drawnValues(const TactileFrame& frame, std::size_t matrix, TaxelView view);
// The largest of the drawn values without their signs, 0 without readings.
double largestDrawn(const TactileFrame& frame, TaxelView view);
// Shear of a touched taxel: x towards the next column, y towards the next row [unit of the
// readings]; 0 of one that isn't touched.
QPointF shearAt(const TactileFrame& frame, const TaxelPlace& place);

}  // namespace palpate::gui
