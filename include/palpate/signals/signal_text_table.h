// The characteristic signals of one frame as a table, to paste into other programs and for CSV.
#pragma once

#include <palpate/core/text_table.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Makes one row per matrix, with its name in the hand's description, and a last row for the whole
// frame. Values are in counts unless the header names a unit.
TextTable signalTextTable(const TactileFrame& frame, const HandDescription& hand);

}  // namespace palpate
