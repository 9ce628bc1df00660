#include <algorithm>
#include <stdexcept>

#include <sys/statvfs.h>
#include <unistd.h>

#include "palpate/capture/recorder.h"
#include "palpate/core/error.h"

#include "capture/recording_parts.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kMinBytes = 64 << 10;

void requireRecordingOptions(bool right, const std::string& message) {
  if (!right) throw std::invalid_argument("RecordingOptions: " + message);
}

}  // namespace

// Reports problems at once that would otherwise appear at the first frame.
void requireNewFile(const fs::path& path) {
  std::error_code failure;
  if (fs::exists(fs::symlink_status(path, failure)))
    throw FileError(path, "exists already; a recording is never replaced: give another name");
  requireWritableFolder(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

void requireWritableFolder(const fs::path& folder) {
  std::error_code failure;
  if (!fs::is_directory(folder, failure))
    throw FileError(folder, "isn't a folder: create it first");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw FileError(folder, "can't be written: choose another folder, or change its permissions");
}

void RecordingOptions::validate() const {
  requireRecordingOptions(
      path.extension() == ".palpate" && path.stem() != "",
      "a recording's name must end in .palpate, not '" + path.filename().string() + "'");
  const auto atLeast = [](const auto& value, auto least, const char* name) {
    requireRecordingOptions(!value || *value >= least, std::string(name) + " is too small");
  };
  requireRecordingOptions(preTriggerS >= 0.0 && preTriggerS <= 60.0, "preTriggerS must be 0..60");
  const auto finite = [](const std::optional<double>& value, const char* name) {
    requireRecordingOptions(!value || (*value > 0.0 && *value <= 1e9),
                            std::string(name) + " must be 0..1e9 s");
  };
  finite(splitS, "splitS");
  finite(stopAfterS, "stopAfterS");
  atLeast(splitS, 1.0, "splitS");
  atLeast(splitBytes, kMinBytes, "splitBytes");
  atLeast(stopAfterFrames, std::int64_t{1}, "stopAfterFrames");
  atLeast(stopAfterBytes, kMinBytes, "stopAfterBytes");
  contact.validate();
  if (stopWithoutContactS)
    OptionCheck{"RecordingOptions"}(
        kStopWithoutContactS, "stopWithoutContactS", *stopWithoutContactS);
  if (mcap) mcap->validate();
  requireRecordingOptions(mcapQueueItems > 0, "mcapQueueItems must be at least 1");
  for (const auto& [key, value] : meta)
    requireRecordingOptions(!isReservedMeta(key), "meta '" + key + "' is the recording's own");
}

fs::path mcapPathOf(const fs::path& path) { return fs::path(path).replace_extension(".mcap"); }

fs::path partPath(const fs::path& path, int part) {
  if (part <= 1) return path;
  std::string number = std::to_string(part);
  number.insert(0, 3 - std::min<std::size_t>(3, number.size()), '0');
  fs::path next = path;
  return next.replace_filename(path.stem().string() + "_" + number + path.extension().string());
}

std::optional<std::uint64_t> freeBytesOf(const fs::path& folder) {
  // For a folder that does not exist yet, uses the nearest existing folder above it.
  std::error_code failure;
  fs::path there = fs::absolute(folder, failure);
  while (!fs::exists(there, failure) && there.has_relative_path()) there = there.parent_path();
  struct statvfs found {};
  if (::statvfs(there.c_str(), &found) != 0) return {};
  return static_cast<std::uint64_t>(found.f_bavail) * found.f_frsize;
}

}  // namespace palpate
