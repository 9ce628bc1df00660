#include "palpate/core/file_descriptor.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) ::close(fd_);
}

FileDescriptor openRegularFile(const std::filesystem::path& path) {
  const auto require = [&path](const struct stat& facts) {
    if (S_ISDIR(facts.st_mode)) throw FileError(path, "is a folder");
    if (!S_ISREG(facts.st_mode)) throw FileError(path, "is not a regular file");
  };
  struct stat facts {};
  // Opening some devices does something.
  if (::stat(path.c_str(), &facts) == 0) require(facts);
  // Without waiting, in case that it has become a FIFO meanwhile.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0 || ::fstat(file.get(), &facts) != 0)
    throw FileError(path, "can't be opened: " + std::generic_category().message(errno));
  require(facts);
  return file;
}

}  // namespace palpate
