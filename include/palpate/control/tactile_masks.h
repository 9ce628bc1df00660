// Which taxels the tactile controller scans (its dynamic masks), as a choice of a person: only
// some, all but some, all.
#pragma once

#include <vector>

#include <palpate/device/device.h>
#include <palpate/model/matrix_layout.h>
#include <palpate/model/taxel_selection.h>

namespace palpate {

enum class MaskChoice {
  kOnly,     // scan what is chosen, in the matrices that something is chosen of; the others stay
  kWithout,  // as now, without what is chosen
  kAlso,     // as now, and what is chosen, too
  kAll,      // scan every taxel
};

// What leads from the masks of `layout` to the choice: one command for each matrix whose mask
// changes. Throws std::invalid_argument when the selection is one of another sensor, or when
// nothing at all would be scanned any more.
std::vector<DeviceCommand> maskCommands(const SensorLayout& layout,
                                        const TaxelSelection& selection,
                                        MaskChoice choice);

}  // namespace palpate
