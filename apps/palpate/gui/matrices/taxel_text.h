// Text for the taxel under the mouse pointer: where it is and what it measures.
#pragma once

#include <QString>
#include <optional>

#include <palpate/calibration/pressure_map.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

#include "gui/appearance/display_units.h"
#include "gui/matrices/matrices_painter.h"

namespace palpate::gui {

// "finger 0 distal · x 3, y 5 · 812 counts"; of readings all components, with their signs:
// "pad · x 3, y 5 · x 3, y -2, z 60 counts"; with pressures also " · 12.3 kPa · 0.14 N".
QString taxelText(const HandDescription& hand,
                  const TaxelPlace& place,
                  const std::optional<TactileFrame>& frame,
                  const PressureFrame* pressure = nullptr,
                  const DisplayUnits& units = {});

}  // namespace palpate::gui
