#include "recording/native/palpate_connection.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/file_id.h"
#include "palpate/core/text_file.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/recording_lock.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// Which journal lies there, to see whether it still does; nothing is different from any.
std::array<std::int64_t, 5> palpateAccessStampOf(const fs::path& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return {};
  return {static_cast<std::int64_t>(facts.st_dev),
          static_cast<std::int64_t>(facts.st_ino),
          facts.st_size,
          facts.st_mtim.tv_sec,
          facts.st_mtim.tv_nsec};
}

// Whether SQLite would read it through a write-ahead log, and make files of its own for that: a
// recording never has one (the database file format of SQLite, section 1.3.3).
bool asksForWriteAheadLog(const fs::path& recording) {
  constexpr std::size_t kVersionsAt = 18;
  constexpr char kWriteAhead = 2;
  fs::path log = recording;
  log += "-wal";
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(log, ignored))) return true;
  const std::string header = beginningOfFile(recording, kVersionsAt + 2);
  return header.size() == kVersionsAt + 2 &&
         (header[kVersionsAt] == kWriteAhead || header[kVersionsAt + 1] == kWriteAhead);
}

// Copies all of a file. False: errno says why.
bool copyBytes(int from, int to) {
  std::vector<char> buffer(1u << 20);
  for (;;) {
    const ssize_t got = ::read(from, buffer.data(), buffer.size());
    if (got == 0) return true;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    for (ssize_t done = 0; done < got;) {
      const ssize_t written =
          ::write(to, buffer.data() + done, static_cast<std::size_t>(got - done));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      done += written;
    }
  }
}

[[noreturn]] void throwNoCopy(const fs::path& recording) {
  throw FileError(recording,
                  "can't be copied for opening: " + std::generic_category().message(errno));
}

// A copy in a folder of its own, for SQLite to play the journal back into. While it is being made
// it has no name where the file system allows that: a process that is killed leaves nothing.
fs::path copyWithJournal(const fs::path& recording) {
  const fs::path parent = fs::temp_directory_path();
  const FileDescriptor from(::open(recording.c_str(), O_RDONLY | O_CLOEXEC));
  if (from.get() < 0) throwNoCopy(recording);
  const FileDescriptor to(::open(parent.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (to.get() >= 0 && !copyBytes(from.get(), to.get())) throwNoCopy(recording);
  std::string pattern = (parent / "palpate-open-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw FileError(recording, "no temporary folder to copy it to");
  const fs::path folder = pattern;
  const fs::path copy = folder / "copy.palpate";
  const std::string self = "/proc/self/fd/" + std::to_string(to.get());
  std::error_code failure;
  if (to.get() < 0 ||
      ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, copy.c_str(), AT_SYMLINK_FOLLOW) != 0)
    fs::copy_file(recording, copy, failure);
  if (!failure) fs::copy_file(journalPathOf(recording), journalPathOf(copy), failure);
  if (failure) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw FileError(recording, "can't be copied for opening: " + failure.message());
  }
  return folder;
}

}  // namespace

bool hasHotJournal(const fs::path& recording) {
  const fs::path path = journalPathOf(recording);
  std::error_code failure;
  const auto status = fs::status(path, failure);
  if (!fs::exists(status)) return false;
  if (!fs::is_regular_file(status))
    throw FileError(path,
                    "is not a regular file, and has the name of the recording's journal: move it "
                    "away first");
  const std::string first = beginningOfFile(path, 1);
  return !first.empty() && first[0] != '\0';
}

void refuseForeignJournal(const fs::path& recording) {
  std::error_code ignored;
  const fs::path journal = journalPathOf(recording);
  if (fs::is_regular_file(journal, ignored) && hasHotJournal(recording))
    throw FileError(journal,
                    "belongs to an unfinished recording of that name; move both together, or give "
                    "another name");
}

PalpateConnection::PalpateConnection(const fs::path& path) {
  std::error_code ignored;
  try {
    // Journal and lock lie beside the file itself, not beside a link to it.
    open(fs::is_symlink(path, ignored) ? fs::canonical(path, ignored) : path);
  } catch (...) {
    database_.reset();
    if (!copyFolder_.empty()) fs::remove_all(copyFolder_, ignored);
    throw;
  }
}

void PalpateConnection::open(const fs::path& path) {
  std::error_code failure;
  const auto status = fs::status(path, failure);
  if (!fs::exists(status)) throw FileError(path, "No such file");
  if (!fs::is_regular_file(status))
    throw FileError(path, fs::is_directory(status) ? "is a folder" : "is not a regular file");
  const std::uintmax_t size = fs::file_size(path, failure);
  if (failure) throw FileError(path, "can't be read: " + failure.message());
  path_ = path;
  file_ = fileIdOf(path);
  const bool isHeld = RecordingLock::isHeld(path) || !copyHot();
  if (!copyFolder_.empty()) {
    database_ = std::make_unique<SqliteDatabase>(copyFolder_ / "copy.palpate",
                                                 SqliteDatabase::Mode::kReadWrite);
  } else {
    const bool locks = isHeld || !asksForWriteAheadLog(path);
    database_ = std::make_unique<SqliteDatabase>(
        path, locks ? SqliteDatabase::Mode::kReadOnly : SqliteDatabase::Mode::kUnlocked);
  }
  database_->limitWork(size);
  database_->execute("PRAGMA cell_size_check=ON");
  if (!copyFolder_.empty()) {
    // Plays the journal back. From then on the copy needs no name: it goes with whoever reads it.
    database_->integerOf("SELECT count(*) FROM sqlite_schema");
    fs::remove_all(copyFolder_, failure);
  }
  if (!isHeld) database_->execute("BEGIN");
  if (size == 0 && copyFolder_.empty()) throw FormatError(path, "is empty");
  if (database_->integerOf("PRAGMA application_id") != kPalpateApplicationId)
    throw FormatError(path, "is an SQLite file, but not a palpate recording");
  const std::int64_t version = database_->integerOf("PRAGMA user_version");
  if (version < kPalpateVersion || version > kPalpateVersionWithSeries)
    throw FormatError(
        path,
        "has version " + std::to_string(version) + " of the format; this program reads versions " +
            std::to_string(kPalpateVersion) + " to " + std::to_string(kPalpateVersionWithSeries));
  checkTables(*database_);
  meta_ = readMeta(*database_);
  const bool finished = meta_["finished"] == "1";
  beingWritten_ = isHeld && !finished;  // of a finished one only the events are written anew
  unfinished_ = !isHeld && !finished;
  if (isHeld && finished) database_->execute("BEGIN");
}

// A recording whose writer died inside a commit is copied with its journal. False: by now somebody
// holds its lock.
bool PalpateConnection::copyHot() {
  std::error_code ignored;
  while (hasHotJournal(path_)) {
    const auto journal = palpateAccessStampOf(journalPathOf(path_));
    if (RecordingLock::isHeld(path_)) return false;
    try {
      copyFolder_ = copyWithJournal(path_);
    } catch (const FileError&) {
      if (palpateAccessStampOf(journalPathOf(path_)) == journal) throw;
    }
    // Somebody's commit, not a dead one's, when the journal has gone or changed meanwhile.
    if (palpateAccessStampOf(journalPathOf(path_)) == journal && !RecordingLock::isHeld(path_))
      return true;
    fs::remove_all(copyFolder_, ignored);
    copyFolder_.clear();
  }
  return true;
}

void PalpateConnection::readBlocksOnly() {
  if (beingWritten_ || unfinished_ || !copyFolder_.empty()) return;
  auto database = std::make_unique<SqliteDatabase>(path_, SqliteDatabase::Mode::kUnlocked);
  std::error_code ignored;
  database->limitWork(fs::file_size(path_, ignored));
  database->execute("PRAGMA cell_size_check=ON");
  database->prepare("SELECT 1 FROM block LIMIT 1").next();  // reads the schema while nobody writes
  if (fileIdOf(path_) != file_)
    throw FileError(path_, "was replaced while it was being opened; open it again");
  database_ = std::move(database);
}

PalpateConnection::~PalpateConnection() {
  database_.reset();
  std::error_code ignored;
  if (!copyFolder_.empty()) fs::remove_all(copyFolder_, ignored);
}

}  // namespace palpate
