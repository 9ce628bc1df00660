// File hashes: what a model, a calibration or an export says about the files it was made from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace palpate {

// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);
// Of a whole file, read in pieces. Throws FileError.
std::string sha256OfFile(const std::filesystem::path& path);

}  // namespace palpate
