// Slip as tables to be taken away: as `palpate slip` prints it.
#pragma once

#include <memory>

#include <palpate/core/text_table.h>
#include <palpate/slip/slip_series.h>

namespace palpate::gui {

// A row for each matrix that is touched in a frame; what isn't known is empty.
TextTable slipTable(const std::shared_ptr<const SlipSeries>& series);
// A row for each stretch in which a matrix slips.
TextTable slipSegmentTable(const std::shared_ptr<const SlipSeries>& series);

}  // namespace palpate::gui
