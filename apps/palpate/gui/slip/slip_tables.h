// Tables of slip for export, in the form that `palpate slip` prints.
#pragma once

#include <memory>

#include <palpate/core/text_table.h>
#include <palpate/slip/slip_series.h>

namespace palpate::gui {

// One row for each touched matrix of each frame; unknown values are empty.
TextTable slipTable(const std::shared_ptr<const SlipSeries>& series);
// One row for each time span in which a matrix slips.
TextTable slipSegmentTable(const std::shared_ptr<const SlipSeries>& series);

}  // namespace palpate::gui
