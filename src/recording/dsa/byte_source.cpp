#include "recording/dsa/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace {

std::string reasonOf(int error) { return std::generic_category().message(error); }

}  // namespace

// Without O_NONBLOCK a named pipe would wait for a writer for ever.
FileSource::FileSource(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_.get() < 0) throw FileError(path_, "can't be opened: " + reasonOf(errno));
  struct stat status {};
  const int failed = ::fstat(descriptor_.get(), &status);
  const int error = errno;
  if (failed == 0 && S_ISREG(status.st_mode)) {
    numBytes_ = static_cast<std::uint64_t>(status.st_size);
    return;
  }
  if (failed != 0) throw FileError(path_, "can't be read: " + reasonOf(error));
  throw FileError(
      path_, S_ISDIR(status.st_mode) ? "is a folder, not a recording" : "is not a regular file");
}

std::size_t FileSource::read(std::span<char> out) {
  std::size_t size = 0;
  while (size < out.size()) {
    const ssize_t got = ::read(descriptor_.get(), out.data() + size, out.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(path_, "can't be read: " + reasonOf(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  return size;
}

void FileSource::rewind() {
  if (::lseek(descriptor_.get(), 0, SEEK_SET) != 0)
    throw FileError(path_, "can't be read: " + reasonOf(errno));
}

std::size_t MemorySource::read(std::span<char> out) {
  const std::size_t size = std::min(out.size(), bytes_.size() - position_);
  if (size > 0) std::memcpy(out.data(), bytes_.data() + position_, size);
  position_ += size;
  return size;
}

}  // namespace palpate
