// Alarms of slip scored on a folder of real recordings, as JSON: a part of slip-benchmark.
#pragma once

#include <filesystem>

#include <palpate/core/json.h>

namespace palpate::commands {

// FOLDER/slip-detection holds recordings of slip, FOLDER/grasps_by_class of grasps without. Throws
// Error when there are none.
Json slipAlarms(const std::filesystem::path& folder, bool quiet);

}  // namespace palpate::commands
