// Makes a table of the curves that the timeline shows, for export.
#pragma once

#include <optional>
#include <vector>

#include <palpate/core/text_table.h>

#include "gui/chart/plotted_curve.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// One row per frame of the span: frame, time_ms, time_s, then one column per curve with its base
// unit: which units are shown changes no table.
// Joint angles and temperatures are the last ones at or before the frame. Rows are computed on
// demand, in any thread. `with`: the profile of the recording with its computed series.
TextTable curveTable(const OpenedRecordingPtr& recording,
                     const std::vector<PlottedCurve>& curves,
                     const FrameSpan& span,
                     const std::optional<Profile>& with = {});

}  // namespace palpate::gui
