// Changes of the dynamic masks, that is, which taxels the tactile controller scans, from a
// selection made by the user.
#pragma once

#include <vector>

#include <palpate/device/device.h>
#include <palpate/model/matrix_layout.h>
#include <palpate/model/taxel_selection.h>

namespace palpate {

enum class MaskChoice {
  kOnly,  // scan the selected taxels only, and no taxel of a matrix without a selection
  // Scan only the selected taxels in matrices with a selection; the other matrices stay as they
  // are.
  kOnlyInTheirMatrices,
  kWithout,  // scan as now, without the selected taxels
  kAlso,     // scan as now, and the selected taxels, too
  kAll,      // scan every taxel
};

// The commands that change the masks of `layout` as chosen: one for each matrix whose mask changes.
// Throws std::invalid_argument when the selection belongs to another sensor, or when no taxel would
// be scanned any more, with kOnly also when nothing is selected.
std::vector<DeviceCommand> maskCommands(const SensorLayout& layout,
                                        const TaxelSelection& selection,
                                        MaskChoice choice);

}  // namespace palpate
