#include "palpate/core/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// A rename is only on disk when its folder is.
void syncFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // the file itself is safe; not every file system lets a folder sync
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void requireWritable(const fs::path& path, Overwrite overwrite) {
  std::error_code ignored;
  const auto status = fs::symlink_status(path, ignored);
  if (fs::is_directory(fs::status(path, ignored))) throw FileError(path, "is a folder");
  if (overwrite == Overwrite::kRefuse && fs::exists(status))
    throw FileError(path, "exists already; give another name, or --force to replace it");
}

void publishFile(const fs::path& written, const fs::path& path, Overwrite overwrite) {
  if (overwrite == Overwrite::kRefuse) {
    // link() fails where the name was taken meanwhile; rename() would replace it.
    if (::link(written.c_str(), path.c_str()) == 0) {
      ::unlink(written.c_str());
    } else if (errno == EEXIST) {
      requireWritable(path, overwrite);
      throw FileError(path, "exists already");
    } else {  // a file system without hard links
      requireWritable(path, overwrite);
      if (::rename(written.c_str(), path.c_str()) != 0)
        throw FileError(path, "can't be written: " + reason(errno));
    }
  } else if (::rename(written.c_str(), path.c_str()) != 0) {
    throw FileError(path, "can't be written: " + reason(errno));
  }
  syncFolder(folderOf(path));
}

OutputFile::OutputFile(fs::path path, Overwrite overwrite)
    : path_(std::move(path)), overwrite_(overwrite) {
  requireWritable(path_, overwrite_);
  std::string name = path_.filename().string();
  name.insert(0, 1, '.');
  name += ".XXXXXX";
  std::string pattern = (folderOf(path_) / name).string();
  descriptor_ = ::mkostemp(pattern.data(), O_CLOEXEC);
  if (descriptor_ < 0) throw FileError(path_, "can't be written: " + reason(errno));
  temporary_ = pattern;
  const mode_t mask = ::umask(0);  // mkostemp makes 0600; a recording is as readable as any file
  ::umask(mask);
  ::fchmod(descriptor_, 0666 & ~mask);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw FileError(path_, "can't be written: " + reason(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  if (::fsync(descriptor_) != 0) throw FileError(path_, "can't be written: " + reason(errno));
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) throw FileError(path_, "can't be written: " + reason(errno));
  publishFile(temporary_, path_, overwrite_);
  committed_ = true;
}

}  // namespace palpate
