// Which form a recording has. Private to this module.
#pragma once

#include <filesystem>

namespace palpate {

// Whether a file is a native recording, else a .dsa: by the first bytes; where these are neither
// SQLite's nor a .dsa's (damaged), by the name. Throws FileError.
bool isNativeRecording(const std::filesystem::path& path);

}  // namespace palpate
