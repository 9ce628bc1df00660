#include "palpate/core/text_file.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"

namespace palpate {
namespace {

std::string sizeText(std::uint64_t bytes) {
  constexpr std::uint64_t kMegabyte = 1u << 20;
  return bytes >= kMegabyte ? std::to_string(bytes / kMegabyte) + " MB"
                            : std::to_string(bytes) + " bytes";
}

// At most `byteLimit` bytes, read piece by piece: a file may grow while it is read.
std::string firstBytes(const FileDescriptor& file,
                       std::uint64_t byteLimit,
                       const std::filesystem::path& path) {
  constexpr std::uint64_t kPiece = 1u << 16;
  std::string text;
  while (text.size() < byteLimit) {
    const std::size_t before = text.size();
    text.resize(before + static_cast<std::size_t>(std::min(kPiece, byteLimit - before)));
    const ssize_t count = ::read(file.get(), text.data() + before, text.size() - before);
    const int reason = errno;
    text.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0) break;
    if (count < 0 && reason != EINTR)
      throw FileError(path, "can't be read: " + std::generic_category().message(reason));
  }
  return text;
}

}  // namespace

std::string readTextFile(const std::filesystem::path& path, std::uint64_t byteLimit) {
  const FileDescriptor file = openRegularFile(path);
  std::string text = firstBytes(file, byteLimit + 1, path);
  if (text.size() > byteLimit)
    throw FormatError(path, "is too large: more than " + sizeText(byteLimit));
  return text;
}

std::string beginningOfFile(const std::filesystem::path& path, std::size_t byteLimit) {
  try {
    return firstBytes(openRegularFile(path), byteLimit, path);
  } catch (const FileError&) {
    return {};
  }
}

}  // namespace palpate
