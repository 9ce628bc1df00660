#include "palpate/recording/recording_lock.h"

#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_id.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

fs::path palpateLockWithEnding(const fs::path& path, const char* ending) {
  fs::path other = path;
  other += ending;
  return other;
}

}  // namespace

fs::path lockPathOf(const fs::path& recording) { return palpateLockWithEnding(recording, ".lock"); }
fs::path journalPathOf(const fs::path& recording) {
  return palpateLockWithEnding(recording, "-journal");
}

RecordingLock::RecordingLock(const fs::path& recording) : path_(lockPathOf(recording)) {
  for (;;) {
    FileDescriptor opened(::open(
        path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666));
    if (opened.get() < 0)
      throw FileError(recording,
                      "can't be written: " +
                          (errno == ELOOP ? "a symbolic link has the name of its lock file"
                                          : std::generic_category().message(errno)) +
                          " (" + path_.filename().string() + ")");
    int attempt = 0;
    while (::flock(opened.get(), LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      // isHeld() holds it for an instant; a writer holds it for long.
      constexpr int kAttempts = 20;
      if (reason == EWOULDBLOCK && ++attempt < kAttempts) {
        const timespec pause{0, 1'000'000};
        ::nanosleep(&pause, nullptr);
        continue;
      }
      throw FileError(recording,
                      reason == EWOULDBLOCK
                          ? "is being written by another program"
                          : "can't be locked: " + std::generic_category().message(reason));
    }
    // The former holder may have removed the file between our open and our flock: then we hold the
    // lock of a file that nobody else sees.
    if (fileIdOf(opened.get()) == fileIdOf(path_)) {
      descriptor_ = std::move(opened);
      return;
    }
  }
}

// Not the file of somebody else who recorded under that name after ours was deleted.
RecordingLock::~RecordingLock() {
  if (isThere()) ::unlink(path_.c_str());
}

bool RecordingLock::isThere() const noexcept {
  return fileIdOf(descriptor_.get()) == fileIdOf(path_);
}

bool RecordingLock::isHeld(const fs::path& recording) {
  // Never waits, whatever has that name; a writer's lock is a file.
  const FileDescriptor lock(::open(lockPathOf(recording).c_str(),
                                   O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat facts {};
  return lock.get() >= 0 && ::fstat(lock.get(), &facts) == 0 && S_ISREG(facts.st_mode) &&
         ::flock(lock.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace palpate
