// Tells files apart whatever their names are: a file that is deleted, renamed or replaced while it
// is open is noticed because its name no longer leads to it.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace palpate {

// Identity of a file while it exists. Another file under the same name has another identity, and a
// renamed file keeps its own.
struct FileId {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  auto operator<=>(const FileId&) const = default;
};

// Follow symbolic links. Empty: there is no such file, or the system doesn't say.
std::optional<FileId> fileIdOf(const std::filesystem::path& path) noexcept;
std::optional<FileId> fileIdOf(int descriptor) noexcept;

// Whether `path` leads to that file. A name that can't be looked up now (no permission, an error of
// the disk or the network) counts as unchanged.
bool leadsTo(const std::filesystem::path& path, const FileId& file) noexcept;
// Throws FileError (the file or its folder was moved, renamed or deleted, or another file was put
// in its place) unless `path` leads to that file.
void requireLeadsTo(const std::filesystem::path& path, const FileId& file);

}  // namespace palpate
