// The columns of a table that are joint angles or temperatures. Private to this module.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "palpate/recording/import_plan.h"

#include "recording/import/column_choice.h"

namespace palpate {

// A number for each of these names of a hand's axes, or of its temperature sensors, by the names of
// the columns; none where they are not there. Adds to the notes what was guessed, and to
// `otherColumns` the columns of other quantities of joints, which are no taxels either.
std::vector<TableElement> findSamples(const std::vector<TableColumn>& columns,
                                      PlannedSeries::Kind kind,
                                      const std::vector<std::string>& names,
                                      std::vector<std::string>& notes,
                                      std::set<std::size_t>& otherColumns);

}  // namespace palpate
