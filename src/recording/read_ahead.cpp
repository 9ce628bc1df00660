#include "palpate/recording/read_ahead.h"

#include <algorithm>
#include <system_error>

namespace palpate {

std::size_t readAheadThreads(std::size_t numFiles) noexcept {
  // Each takes about 6 MB of memory, and as much as a recording of kReadAheadBytes fills.
  constexpr std::size_t kMaxReadThreads = 8;
  const std::size_t threads =
      std::min<std::size_t>({numFiles, std::thread::hardware_concurrency(), kMaxReadThreads});
  return threads > 1 ? threads : 0;
}

bool isReadAhead(const std::filesystem::path& file) noexcept {
  // Native recordings are not read when they are opened.
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  return !failure && size <= kReadAheadBytes && file.extension() == ".dsa";
}

std::size_t threadsBesideOthers(const std::filesystem::path& file) noexcept {
  return isReadAhead(file) ? 1 : 0;
}

}  // namespace palpate
