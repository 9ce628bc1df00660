// The curves that the timeline shows, as a table.
#pragma once

#include <vector>

#include <palpate/core/text_table.h>

#include "gui/chart/plotted_curve.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// A row per frame of the span: frame, time_ms, time_s, then a column per curve with its unit. Joint
// angles and temperatures are the last ones at or before the frame. Rows are made when they are
// asked for, in any thread.
TextTable curveTable(const OpenedRecordingPtr& recording,
                     const std::vector<PlottedCurve>& curves,
                     const FrameSpan& span);

}  // namespace palpate::gui
