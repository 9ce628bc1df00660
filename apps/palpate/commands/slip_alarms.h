// Evaluates the slip alarms on a folder of real recordings, as JSON: a part of `palpate
// slip-benchmark`.
#pragma once

#include <filesystem>

#include <palpate/core/json.h>

namespace palpate::commands {

// FOLDER/slip-detection contains recordings with slip, FOLDER/grasps_by_class recordings of grasps
// without. Throws Error when there are none.
Json slipAlarms(const std::filesystem::path& folder, bool quiet);

}  // namespace palpate::commands
