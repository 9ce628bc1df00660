#include "imports/random_reader.h"

#include <cerrno>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {

RandomReader::RandomReader(const std::filesystem::path& path)
    : path_(path), file_(openRegularFile(path)) {
  struct stat facts {};
  if (::fstat(file_.get(), &facts) != 0)
    throw FileError(path, "can't be read: " + std::generic_category().message(errno));
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

void RandomReader::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (offset > size_ || bytes.size() > size_ - offset)
    throw FormatError(path_, "is cut off: it ends after " + std::to_string(size_) + " bytes");
  while (!bytes.empty()) {
    const ssize_t count =
        ::pread(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw FileError(path_, "can't be read: " + std::generic_category().message(errno));
    if (count == 0) throw FormatError(path_, "was cut off while it was read");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
}

}  // namespace palpate
