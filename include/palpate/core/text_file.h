// Reads small files that a user selects and the program reads as a whole: models, calibrations,
// recipes, tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace palpate {

// Returns all bytes of a file. Never keeps more than `byteLimit` + 1 bytes in memory, since a
// larger file cannot be the right one. Throws FileError (cannot be opened, with the reason; is a
// folder, FIFO, device and so on; cannot be read), FormatError (larger than `byteLimit`).
std::string readTextFile(const std::filesystem::path& path, std::uint64_t byteLimit);

// Returns the first bytes of a file, at most `byteLimit`; empty when it cannot be read or is no
// regular file.
std::string beginningOfFile(const std::filesystem::path& path, std::size_t byteLimit);

}  // namespace palpate
