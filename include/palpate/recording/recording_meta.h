// What was said of a recording as a whole when it was made: the device about itself, the operator
// about the run.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace palpate {

// Keys and values of the table `meta` of a native recording (docs/palpate_format.md): "serial",
// "firmware", "settings" (JSON), "operator", ..; a .dsa has none. Throws FileError, FormatError.
std::map<std::string, std::string> readRecordingMeta(const std::filesystem::path& path);

}  // namespace palpate
