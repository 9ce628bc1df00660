#include "recording/recording_format.h"

#include <array>
#include <string_view>

#include "palpate/core/file_ending.h"

#include "recording/dsa/byte_source.h"
#include "recording/native/palpate_lock.h"

namespace palpate {
namespace {

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};

}  // namespace

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
