// Hashes of files. Models, calibrations and exports store them to identify the files that they were
// made from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace palpate {

// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);
// SHA-256 of a whole file, which is read in pieces. Throws FileError.
std::string sha256OfFile(const std::filesystem::path& path);
// SHA-256 of an open file from byte `from` to its end. The position of the
// descriptor doesn't change. `path` names the file in messages. Throws FileError.
std::string sha256OfDescriptor(int descriptor,
                               std::uint64_t from,
                               const std::filesystem::path& path);

}  // namespace palpate
