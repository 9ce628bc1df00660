// The lock of a native recording: flock on NAME.palpate.lock, held by whoever writes it.
#pragma once

#include <filesystem>

#include "palpate/core/file_descriptor.h"

namespace palpate {

std::filesystem::path lockPathOf(const std::filesystem::path& recording);
std::filesystem::path journalPathOf(const std::filesystem::path& recording);

// Throws FileError when a rollback journal lies beside PATH, which isn't there itself (or is about
// to be replaced): SQLite would play it back into whatever gets that name.
void refuseForeignJournal(const std::filesystem::path& recording);

class RecordingLock {
 public:
  // Takes the lock; makes the lock file. Throws FileError: another program holds it, no permission.
  explicit RecordingLock(const std::filesystem::path& recording);
  ~RecordingLock();  // gives it back and removes the lock file
  RecordingLock(const RecordingLock&) = delete;
  RecordingLock& operator=(const RecordingLock&) = delete;

  // Whether another program (or another RecordingLock) holds it. Makes nothing.
  static bool isHeld(const std::filesystem::path& recording);

 private:
  std::filesystem::path path_;
  FileDescriptor descriptor_;
};

}  // namespace palpate
