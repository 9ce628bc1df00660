// Small profiles and frames of the SDH-2 with known content; no window.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/model/profile.h>

namespace palpate::gui {

// A profile of the SDH-2 with one frame per stamp [ms]; frame i has the value 10 * (i + 1) counts
// in row 7, column 2 of finger 0 distal (matrix 1), and nothing else.
Profile profileWithStamps(const std::vector<std::int64_t>& stampsMs);
// As above with 20 frames, 50 ms apart.
Profile twentyFrames();
// Three frames whose times count from 0.
Profile undatedFrames();
// One frame of the SDH-2, all zero.
TactileFrame emptyFrame();

}  // namespace palpate::gui
