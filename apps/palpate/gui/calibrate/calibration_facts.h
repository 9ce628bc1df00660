// A calibration in words and figures: what it says, what it is worth, what it was made from.
#pragma once

#include <vector>

#include <palpate/calibration/calibration.h>
#include <palpate/core/text_table.h>

#include "gui/calibrate/calibration_making.h"
#include "gui/widgets/facts_view.h"

namespace palpate::gui {

// "P = 31.90 − 0.625 T + 0.0978 K", terms that were left out left out; x stands for the first
// variable.
QString formulaOf(const Surface& surface, const QString& x);
std::vector<Fact> calibrationFacts(const Calibration& calibration);
// To be taken away: its samples with what it tells of each, and any facts.
TextTable sampleTable(const ShownCalibrationPtr& shown);
TextTable factTable(const std::vector<Fact>& facts);

}  // namespace palpate::gui
