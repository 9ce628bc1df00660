// Which form a recording has. Private to this module.
#pragma once

#include <filesystem>
#include <string>

namespace palpate {

// Ending of a name in small letters, with its dot.
std::string lowerEndingOf(const std::filesystem::path& path);

// Whether a file is a native recording, else a .dsa: by the first bytes; where these are neither
// SQLite's nor a .dsa's (damaged), by the name. Throws FileError.
bool isNativeRecording(const std::filesystem::path& path);

}  // namespace palpate
