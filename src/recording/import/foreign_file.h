// Files of other programs that an import can't read: what they are, and what to do instead.
#pragma once

#include <filesystem>
#include <string>

namespace palpate {

// "is an Excel workbook: save it as CSV"; empty for a file or folder that is not known. Throws
// FileError.
std::string foreignFileText(const std::filesystem::path& path);

}  // namespace palpate
