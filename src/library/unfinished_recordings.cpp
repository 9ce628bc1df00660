#include "palpate/library/unfinished_recordings.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include <sys/stat.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/file_name.h"
#include "palpate/core/progress.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/recording_lock.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kEnding = ".palpate";
constexpr std::string_view kRecovered = "_recovered";
// Leaves room in the 255 bytes of a name for "_recovered-99.palpate-journal".
constexpr std::size_t kMaxStem = 220;

bool isRecordingName(std::string_view name) {
  return !name.starts_with('.') && lowerEndingOf(name) == kEnding;
}

// "NAME_recovered" of NAME.palpate.
std::string recoveredStem(const std::string& name) {
  const std::string_view stem = std::string_view(name).substr(0, name.size() - kEnding.size());
  return std::string(beginningOf(stem, kMaxStem)) + std::string(kRecovered);
}

// Whether `names` has NAME_recovered.palpate or NAME_recovered-N.palpate of NAME.palpate.
bool wasRecovered(const std::string& name, const std::set<std::string>& names) {
  const std::string stem = recoveredStem(name);
  for (auto at = names.lower_bound(stem); at != names.end() && at->starts_with(stem); ++at) {
    std::string_view rest = std::string_view(*at).substr(stem.size());
    if (rest == kEnding) return true;
    if (!rest.starts_with('-') || !rest.ends_with(kEnding)) continue;
    rest = rest.substr(1, rest.size() - 1 - kEnding.size());
    if (!rest.empty() && rest.find_first_not_of("0123456789") == std::string_view::npos)
      return true;
  }
  return false;
}

// Of a name that a regular file has; links aren't followed.
std::optional<struct stat> regularFile(const fs::path& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  return facts;
}

// Names of all that lies in a folder.
std::set<std::string> listed(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code failure;
  fs::directory_iterator entries(folder, failure);
  if (failure == std::errc::no_such_file_or_directory) return names;
  for (; !failure && entries != fs::directory_iterator(); entries.increment(failure))
    names.insert(entries->path().filename().string());
  if (failure) throw FileError(folder, "can't be listed: " + failure.message());
  return names;
}

}  // namespace

std::vector<UnfinishedRecording> findUnfinished(const fs::path& folder, const Progress& progress) {
  const std::set<std::string> names = listed(folder);
  std::vector<UnfinishedRecording> found;
  std::size_t seen = 0;
  for (const std::string& name : names) {
    reportProgress(progress, seen++, names.size());
    if (!isRecordingName(name) || wasRecovered(name, names)) continue;
    const fs::path path = folder / name;
    const auto facts = regularFile(path);
    if (!facts || !isUnfinishedRecording(path)) continue;
    found.push_back(
        {path,
         std::int64_t{facts->st_mtim.tv_sec} * 1'000'000 + facts->st_mtim.tv_nsec / 1000,
         static_cast<std::uintmax_t>(facts->st_size)});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.changedUs > b.changedUs;
  });
  return found;
}

fs::path recoveredPathOf(const fs::path& recording) {
  const std::string name = recording.filename().string();
  const std::string stem =
      recoveredStem(isRecordingName(name) ? name : name + std::string(kEnding));
  const auto isTaken = [](const fs::path& path) {
    std::error_code ignored;
    return fs::exists(fs::symlink_status(path, ignored)) ||
           fs::exists(fs::symlink_status(journalPathOf(path), ignored));
  };
  fs::path path = recording;
  path.replace_filename(stem + std::string(kEnding));
  for (int next = 2; isTaken(path); ++next)
    path.replace_filename(stem + "-" + std::to_string(next) + std::string(kEnding));
  return path;
}

}  // namespace palpate
