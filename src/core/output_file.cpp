#include "palpate/core/output_file.h"

#include <cerrno>
#include <cstdio>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void throwCantWrite(const fs::path& path, int error) {
  if (error == ENOENT) throw FileError(path, "can't be written: its folder does not exist");
  throw FileError(path, "can't be written: " + writeFailureText(error));
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Returns an unused name in the folder of `path`; it is short, however long that name is.
fs::path temporaryName(const fs::path& path) {
  std::random_device random;
  char name[32];
  std::snprintf(name, sizeof name, ".palpate-%08x%08x", random(), random());
  return folderOf(path) / name;
}

// A rename is permanent only when the folder is synced.
void syncFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return;  // the file itself is safe, and some file systems cannot sync a folder
  ::fsync(descriptor);
  ::close(descriptor);
}

// Returns the target of a symbolic link, so that the target is written and not the link.
fs::path followed(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_symlink(fs::symlink_status(path, failure))) return path;
  const fs::path target = fs::weakly_canonical(path, failure);
  return failure ? path : target;
}

}  // namespace

std::string writeFailureText(int error) {
  return error == ENOSPC ? "the disk is full" : std::generic_category().message(error);
}

void requireWritable(const fs::path& path, Overwrite overwrite) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::is_directory(status)) throw FileError(path, "is a folder");
  if (overwrite == Overwrite::kRefuse && fs::exists(fs::symlink_status(path, ignored)))
    throw FileError(path, "exists already; give another name, or --force to replace it");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw FileError(path, "is not a regular file; give another name");
}

void publishFile(const fs::path& written, const fs::path& path, Overwrite overwrite) {
  if (overwrite == Overwrite::kRefuse) {
    // link() fails when the name was taken in the meantime; rename() would replace that file.
    if (::link(written.c_str(), path.c_str()) == 0) {
      ::unlink(written.c_str());
    } else if (errno == EEXIST) {
      requireWritable(path, overwrite);
      throw FileError(path, "exists already");
    } else {  // a file system without hard links
      requireWritable(path, overwrite);
      if (::rename(written.c_str(), path.c_str()) != 0) throwCantWrite(path, errno);
    }
  } else if (::rename(written.c_str(), path.c_str()) != 0) {
    throwCantWrite(path, errno);
  }
  syncFolder(folderOf(path));
}

OutputFile::OutputFile(fs::path path, Overwrite overwrite)
    : path_(std::move(path)), overwrite_(overwrite) {
  requireWritable(path_, overwrite_);
  if (overwrite_ == Overwrite::kReplace) path_ = followed(path_);
  constexpr mode_t kMode = 0666;  // reduced by the umask, as for other files
  descriptor_ = ::open(folderOf(path_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kMode);
  if (descriptor_ >= 0) return;
  // Not every file system supports files without a name.
  temporary_ = temporaryName(path_);
  descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  if (descriptor_ >= 0) return;
  const int error = errno;
  temporary_.clear();
  throwCantWrite(path_, error);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throwCantWrite(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::nameTemporarily() {
  const fs::path name = temporaryName(path_);
  const std::string self = "/proc/self/fd/" + std::to_string(descriptor_);
  if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0)
    throwCantWrite(path_, errno);
  temporary_ = name;
}

void OutputFile::sync() {
  if (::fsync(descriptor_) != 0) throwCantWrite(path_, errno);
}

void OutputFile::commit() {
  sync();
  if (temporary_.empty()) nameTemporarily();
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) throwCantWrite(path_, errno);
  publishFile(temporary_, path_, overwrite_);
  temporary_.clear();
}

void commitTogether(std::span<OutputFile* const> files) {
  for (OutputFile* file : files) file->sync();
  std::size_t named = 0;
  try {
    for (OutputFile* file : files) {
      file->commit();
      ++named;
    }
  } catch (const FileError&) {
    for (const OutputFile* file : files.first(named))
      if (file->overwrite() == Overwrite::kRefuse) ::unlink(file->path().c_str());
    throw;
  }
}

}  // namespace palpate
