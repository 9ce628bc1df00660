// Whether one frame of a contact supports a surface that ends inside the matrix.
// MostProbableSurface is used for such contacts only.
#pragma once

#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Sum of the two largest of the readings at the four sides of the matrix, as a fraction of the
// largest reading, 0..2. A taxel beside a masked one lies at a side too. Below 1 the contact ends
// inside the matrix. A contact that goes on over two sides, with a load that is constant or linear
// along it, as a bottle that spans the matrix or a bar across a corner, has at least 1. A contact
// that is cut by one side, and touches no other, has at most 1: it ends at the opposite side. 2
// without contact. Throws std::invalid_argument when the frame has another size.
double loadAtTwoSides(const MatrixLayout& layout, const ConstMatrixMap& frame);

// Whether a frame determines more of a surface than its motion: more than four taxels (the motion
// has the four unknowns dx, dy, angle and gain) read at least twice the smallest active value, and
// twice three standard deviations of the noise [counts]. A taxel below the threshold is uncertain
// by the threshold; where no reading is far above it, the shape of the contact is not known.
bool isStrongContact(const ConstMatrixMap& frame, double noiseCounts) noexcept;

}  // namespace palpate
