#include "palpate/library/recording_files.h"

#include <stdexcept>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/file_name.h"
#include "palpate/core/output_file.h"
#include "palpate/recording/recording_lock.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

fs::path withMore(const fs::path& path, const char* more) {
  fs::path longer = path;
  longer += more;
  return longer;
}

constexpr const char* kRecordingJournal = "-journal";

void requireFreeOfWriters(const fs::path& part) {
  if (isBeingWritten(part)) throw FileError(part, "is being written; end that first");
}

// Removes the lock that a killed writer has left, which would stay without its recording.
void removeFreeLock(const fs::path& part) {
  if (lowerEndingOf(part) != ".palpate" || !isThere(lockPathOf(part))) return;
  try {
    const RecordingLock released(part);
  } catch (const Error&) {
    // It is somebody's, or the folder can't be written: it stays.
  }
}

// The new name of a file of a part: the stem of the first part, with which it begins, is replaced.
fs::path renamed(const fs::path& file, const std::string& oldStem, const std::string& stem) {
  const std::string name = file.filename().string();
  return file.parent_path() / (stem + name.substr(oldStem.size()));
}

}  // namespace

bool isBeingWritten(const fs::path& recording) {
  return lowerEndingOf(recording) == ".palpate" && isThere(recording) &&
         RecordingLock::isHeld(recording);
}

std::vector<fs::path> filesOfRecording(const fs::path& recording) {
  std::vector<fs::path> files;
  if (isThere(recording)) files.push_back(recording);
  const auto add = [&](const fs::path& path) {
    if (isThere(path)) files.push_back(path);
  };
  if (lowerEndingOf(recording) == ".palpate") {
    add(fs::path(recording).replace_extension(".mcap"));
    add(withMore(recording, kRecordingJournal));
  } else if (lowerEndingOf(recording) == ".dsa") {
    add(withMore(recording, ".notes.json"));
  }
  return files;
}

void removeFreeLocks(std::span<const fs::path> parts) {
  for (const fs::path& part : parts) removeFreeLock(part);
}

std::vector<fs::path> renameRecording(std::span<const fs::path> parts, const std::string& stem) {
  if (parts.empty()) throw std::invalid_argument("renameRecording: no parts");
  if (stem.empty() || stem.front() == '.' || stem.find('/') != std::string::npos)
    throw std::invalid_argument("renameRecording: '" + shortened(stem) + "' is not a valid name");
  const std::string oldStem = parts.front().stem().string();
  std::vector<std::pair<fs::path, fs::path>> moves;
  std::vector<fs::path> named;
  for (const fs::path& part : parts) {
    if (!isThere(part)) throw FileError(part, "isn't there any more");
    if (!part.stem().string().starts_with(oldStem))
      throw std::invalid_argument("renameRecording: " + part.string() + " is not a part of it");
    requireFreeOfWriters(part);
    if (isThere(withMore(part, kRecordingJournal)))
      throw FileError(part, "was never finished; recover it first");
    for (const fs::path& file : filesOfRecording(part))
      moves.emplace_back(file, renamed(file, oldStem, stem));
    named.push_back(renamed(part, oldStem, stem));
  }
  for (const auto& [from, to] : moves)
    if (from != to && isThere(to)) throw FileError(to, "exists already; give another name");
  std::size_t done = 0;
  try {
    for (; done < moves.size(); ++done)
      if (moves[done].first != moves[done].second)
        publishFile(moves[done].first, moves[done].second, Overwrite::kRefuse);
  } catch (...) {
    while (done-- > 0) {
      std::error_code ignored;
      if (!isThere(moves[done].first)) fs::rename(moves[done].second, moves[done].first, ignored);
    }
    throw;
  }
  removeFreeLocks(parts);
  return named;
}

void requireNotBeingWritten(std::span<const fs::path> parts) {
  for (const fs::path& part : parts) requireFreeOfWriters(part);
}

void deleteRecording(std::span<const fs::path> parts) {
  requireNotBeingWritten(parts);
  for (const fs::path& part : parts)
    for (const fs::path& file : filesOfRecording(part)) {
      std::error_code failure;
      fs::remove(file, failure);
      if (failure) throw FileError(file, "can't be deleted: " + failure.message());
    }
  removeFreeLocks(parts);
}

}  // namespace palpate
