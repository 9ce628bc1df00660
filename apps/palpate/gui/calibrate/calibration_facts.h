// Describes a calibration in words and numbers for the page Pressure: its formula, its quality, and
// the data that it was made from.
#pragma once

#include <vector>

#include <palpate/calibration/calibration.h>
#include <palpate/core/text_table.h>

#include "gui/calibrate/calibration_making.h"
#include "gui/widgets/facts_view.h"

namespace palpate::gui {

// The formula as text, such as "P = 31.90 − 0.625 T + 0.0978 K", without the terms that the fit
// left out; `x` is the name of the first variable.
QString formulaOf(const Surface& surface, const QString& x);
std::vector<Fact> calibrationFacts(const Calibration& calibration);
// Why the values of this hand can't be calibrated, in one sentence: they have a physical unit
// already. Empty when they are counts.
QString notCalibratable(const HandDescription& hand);
// Tables for export and copying: the samples of a calibration, each with the pressure that the
// calibration gives for it; and any list of facts.
TextTable sampleTable(const ShownCalibrationPtr& shown);
TextTable factTable(const std::vector<Fact>& facts);

}  // namespace palpate::gui
