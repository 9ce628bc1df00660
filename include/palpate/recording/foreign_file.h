// What a file or folder of another program is, and what to do with it.
#pragma once

#include <filesystem>
#include <string>

namespace palpate {

// By its first bytes: a format of other programs that Palpate doesn't read; empty: none of the
// known ones. For messages behind the name of the file.
std::string foreignFormatText(const std::filesystem::path& path);
// Of a folder of a bag of ROS 2; empty: it is none.
std::string bagFolderText(const std::filesystem::path& folder);
// Why a file or folder is no table for an import; empty: it may be one.
std::string foreignFileText(const std::filesystem::path& path);

}  // namespace palpate
