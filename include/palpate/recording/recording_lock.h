// The lock that the writer of a native recording holds, and the files that lie beside the recording
// meanwhile.
#pragma once

#include <filesystem>

#include <palpate/core/file_descriptor.h>

namespace palpate {

// The files that lie beside a recording while it is being written: NAME.palpate.lock
// (RecordingLock) and NAME.palpate-journal, SQLite's rollback journal.
std::filesystem::path lockPathOf(const std::filesystem::path& recording);
std::filesystem::path journalPathOf(const std::filesystem::path& recording);

// The lock of a native recording: flock on NAME.palpate.lock, held by whoever writes the recording.
class RecordingLock {
 public:
  // Takes the lock; makes the lock file. Throws FileError: another program holds it, no permission.
  explicit RecordingLock(const std::filesystem::path& recording);
  ~RecordingLock();  // gives it back and removes the lock file
  RecordingLock(const RecordingLock&) = delete;
  RecordingLock& operator=(const RecordingLock&) = delete;

  // Whether the lock file is still found under its name.
  bool isThere() const noexcept;
  // Whether another program (or another RecordingLock) holds it. Makes nothing.
  static bool isHeld(const std::filesystem::path& recording);

 private:
  std::filesystem::path path_;
  FileDescriptor descriptor_;
};

}  // namespace palpate
