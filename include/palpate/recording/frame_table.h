// The taxels of one frame as a table, for pasting and for CSV.
#pragma once

#include <string>

#include <palpate/core/text_table.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// `frame,time_ms,matrix,y,x,value`: a row per taxel that is scanned, at rest or not, matrix after
// matrix, row by row. `index`: what stands in the column frame; empty of a live one.
TextTable taxelTable(const TactileFrame& frame, const std::string& index);

}  // namespace palpate
