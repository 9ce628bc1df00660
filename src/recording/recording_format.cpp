#include "recording/recording_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "recording/dsa/byte_source.h"
#include "recording/native/palpate_lock.h"

namespace palpate {
namespace {

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};

}  // namespace

std::string lowerEndingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return ending;
}

bool isNativeRecording(const std::filesystem::path& path) {
  // Closing a file that this very process writes would drop SQLite's locks on it.
  if (RecordingLock::isHeld(path)) return true;
  FileSource source(path);
  std::array<char, kSqliteStart.size()> first{};
  const std::string_view start(first.data(), source.read(first));
  if (start == kSqliteStart) return true;
  return lowerEndingOf(path) == ".palpate" && !start.starts_with("BZh") && !start.starts_with('<');
}

}  // namespace palpate
