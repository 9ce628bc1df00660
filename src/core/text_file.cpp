#include "palpate/core/text_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "palpate/core/error.h"

namespace palpate {
namespace {

std::string sizeText(std::uint64_t bytes) {
  constexpr std::uint64_t kMegabyte = 1u << 20;
  return bytes >= kMegabyte ? std::to_string(bytes / kMegabyte) + " MB"
                            : std::to_string(bytes) + " bytes";
}

}  // namespace

std::string readTextFile(const std::filesystem::path& path, std::uint64_t byteLimit) {
  constexpr std::uint64_t kPiece = 1u << 16;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw FileError(path, "is a folder");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    const int reason = errno;
    throw FileError(
        path,
        "can't be opened" + (reason != 0 ? ": " + std::generic_category().message(reason) : ""));
  }
  // Read piece by piece, since the size of a file that is not regular is not known.
  std::string text;
  while (in && text.size() <= byteLimit) {
    const std::size_t before = text.size();
    const std::uint64_t room = byteLimit + 1 - before;
    text.resize(before + static_cast<std::size_t>(std::min(kPiece, room)));
    in.read(text.data() + before, static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw FileError(path, "can't be read");
  if (text.size() > byteLimit)
    throw FormatError(path, "is too large: more than " + sizeText(byteLimit));
  return text;
}

std::string beginningOfFile(const std::filesystem::path& path, std::size_t byteLimit) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(byteLimit, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(byteLimit));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace palpate
