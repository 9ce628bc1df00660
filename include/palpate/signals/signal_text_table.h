// The characteristic signals of one frame as a table, for pasting and for CSV.
#pragma once

#include <palpate/core/text_table.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// A row per matrix, named as the hand names it, and one of all together, last; counts but where the
// header says a unit.
TextTable signalTextTable(const TactileFrame& frame, const HandDescription& hand);

}  // namespace palpate
