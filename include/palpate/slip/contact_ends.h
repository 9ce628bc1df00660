// Whether one frame of a contact supports a surface that ends: MostProbableSurface is used for such
// contacts only.
#pragma once

#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Whether the contact ends inside the matrix in every direction: the two largest of the readings at
// its four sides are together less than the largest reading. A taxel beside a masked one lies at a
// side too. A contact that goes on over two sides, with a load that is constant or linear along it,
// as a bottle that spans the matrix or a bar across a corner, never ends inside; a contact that goes
// on over one side ends at the opposite one. False without contact. Throws std::invalid_argument
// when the frame has another size.
bool hasEndsInside(const MatrixLayout& layout, const ConstMatrixMap& frame);

// Whether a frame tells more of a surface than of its motion: more than four taxels (the motion has
// the four unknowns dx, dy, angle and gain) read at least twice the smallest active value, and twice
// three standard deviations of the noise [counts]. A taxel below the threshold is uncertain by the
// threshold; where no reading is far above it, the shape of the contact is not known.
bool isStrongContact(const ConstMatrixMap& frame, double noiseCounts) noexcept;

}  // namespace palpate
