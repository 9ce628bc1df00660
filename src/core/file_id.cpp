#include "palpate/core/file_id.h"

#include <cerrno>
#include <system_error>

#include <sys/stat.h>

#include "palpate/core/error.h"

namespace palpate {
namespace fs = std::filesystem;

std::optional<FileId> fileIdOf(const fs::path& path) noexcept {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return std::nullopt;
  return FileId{facts.st_dev, facts.st_ino};
}

std::optional<FileId> fileIdOf(int descriptor) noexcept {
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0) return std::nullopt;
  return FileId{facts.st_dev, facts.st_ino};
}

bool leadsTo(const fs::path& path, const FileId& file) noexcept {
  if (const auto found = fileIdOf(path)) return *found == file;
  return errno != ENOENT && errno != ENOTDIR && errno != ELOOP;
}

void requireLeadsTo(const fs::path& path, const FileId& file) {
  if (leadsTo(path, file)) return;
  std::error_code failure;
  const fs::path folder = path.parent_path();
  if (!folder.empty() && !fs::exists(folder, failure) && !failure)
    throw FileError(path, "is gone: its folder was moved, renamed or deleted");
  if (fs::exists(fs::symlink_status(path, failure)))
    throw FileError(path, "is gone: something else was put in its place");
  throw FileError(path, "is gone: the file was moved, renamed or deleted");
}

}  // namespace palpate
