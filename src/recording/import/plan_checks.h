// What a plan of an import leaves in doubt, and why columns can't be used. Private to this module.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/recording/import_plan.h"

namespace palpate {

// Why columns of a file hold no numbers, or have one name, for a message; empty: nothing of it.
std::string unusableText(const std::vector<TableColumn>& columns);

// What the numbers in the names of the taxels' columns leave open: one is left out, or they begin
// late. Nothing where they are those of the places that have a taxel.
std::vector<std::string> numberingDoubts(const std::vector<TableColumn>& columns,
                                         const PlannedSeries& frames,
                                         const SensorLayout& layout);

// Whether the last axis of the arrays is the frames by its name ("time"), or the first one is;
// nothing: no array has such a name. Throws Error: it is another axis.
std::optional<bool> frameAxisByName(const std::vector<TableColumn>& columns);

// Adds the columns of a text that say what a row is from (sensor, topic, device_id) to a series.
void addOrigins(const std::vector<TableColumn>& columns, PlannedSeries& series);

}  // namespace palpate
