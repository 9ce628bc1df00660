#include "recording/palpate_access.h"

#include <array>
#include <cstdlib>
#include <fstream>

#include <sys/stat.h>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/palpate_lock.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

std::pair<std::uint64_t, std::uint64_t> palpateAccessIdentityOf(const fs::path& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return {};
  return {facts.st_dev, facts.st_ino};
}

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

// What a rollback journal that is more than an empty shell looks like: its header's magic.
bool hasHotJournal(const fs::path& recording) {
  std::ifstream journal(journalPathOf(recording), std::ios::binary);
  char first = 0;
  return journal.get(first) && first != 0;
}

fs::path copyWithJournal(const fs::path& recording) {
  std::string pattern = (fs::temp_directory_path() / "palpate-open-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw FileError(recording, "no temporary folder to copy it to");
  const fs::path folder = pattern;
  std::error_code failure;
  fs::copy_file(recording, folder / "copy.palpate", failure);
  if (!failure) fs::copy_file(journalPathOf(recording), folder / "copy.palpate-journal", failure);
  if (failure) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw FileError(recording, "can't be copied for opening: " + failure.message());
  }
  return folder;
}

}  // namespace

PalpateAccess::PalpateAccess(const fs::path& path) {
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

void PalpateAccess::open(const fs::path& path) {
  std::error_code failure;
  const auto status = fs::status(path, failure);
  if (!fs::exists(status)) throw FileError(path, "No such file");
  if (!fs::is_regular_file(status))
    throw FileError(path, fs::is_directory(status) ? "is a folder" : "is not a regular file");
  const std::uintmax_t size = fs::file_size(path, failure);
  if (failure) throw FileError(path, "can't be read: " + failure.message());
  path_ = path;
  file_ = palpateAccessIdentityOf(path);
  const bool isHeld = RecordingLock::isHeld(path) || !copyHot();
  if (!copyFolder_.empty()) {
    database_ = std::make_unique<SqliteDatabase>(copyFolder_ / "copy.palpate",
                                                 SqliteDatabase::Mode::kReadWrite);
  } else {
    database_ = std::make_unique<SqliteDatabase>(path, SqliteDatabase::Mode::kReadOnly);
  }
  database_->limitWork(size);
  database_->execute("PRAGMA cell_size_check=ON");
  if (!isHeld) database_->execute("BEGIN");
  if (database_->integerOf("PRAGMA application_id") != kPalpateApplicationId)
    throw FormatError(path, "is an SQLite file, but not a palpate recording");
  const std::int64_t version = database_->integerOf("PRAGMA user_version");
  if (version != kPalpateVersion)
    throw FormatError(path,
                      "has version " + std::to_string(version) +
                          " of the format; this program reads version " +
                          std::to_string(kPalpateVersion));
  checkTables(*database_);
  meta_ = readMeta(*database_);
  const bool finished = meta_["finished"] == "1";
  beingWritten_ = isHeld && !finished;  // of a finished one only the events are written anew
  unfinished_ = !isHeld && !finished;
  if (isHeld && finished) database_->execute("BEGIN");
}

// A recording whose writer died inside a commit is copied with its journal. False: by now somebody
// holds its lock.
bool PalpateAccess::copyHot() {
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

void PalpateAccess::readBlocksOnly() {
  if (beingWritten_ || unfinished_ || !copyFolder_.empty()) return;
  auto database = std::make_unique<SqliteDatabase>(path_, SqliteDatabase::Mode::kUnlocked);
  std::error_code ignored;
  database->limitWork(fs::file_size(path_, ignored));
  database->execute("PRAGMA cell_size_check=ON");
  database->prepare("SELECT 1 FROM block LIMIT 1").next();  // reads the schema while nobody writes
  if (palpateAccessIdentityOf(path_) != file_)
    throw FileError(path_, "was replaced while it was being opened; open it again");
  database_ = std::move(database);
}

PalpateAccess::~PalpateAccess() {
  database_.reset();
  std::error_code ignored;
  if (!copyFolder_.empty()) fs::remove_all(copyFolder_, ignored);
}

}  // namespace palpate
