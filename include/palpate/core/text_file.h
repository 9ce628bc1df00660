// Small files that a person names and the program reads whole: models, calibrations, recipes,
// tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace palpate {

// All bytes of a file. Never holds more than `byteLimit` + 1 of them in memory: a file that is
// larger is not what it should be. Throws FileError (can't be opened, says why; is a folder; can't
// be read), FormatError (larger than `byteLimit`).
std::string readTextFile(const std::filesystem::path& path, std::uint64_t byteLimit);

// What a file begins with, `byteLimit` of it at most; empty where it can't be read.
std::string beginningOfFile(const std::filesystem::path& path, std::size_t byteLimit);

}  // namespace palpate
