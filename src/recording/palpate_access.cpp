#include "recording/palpate_access.h"

#include <cstdlib>
#include <fstream>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/palpate_lock.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

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
  beingWritten_ = RecordingLock::isHeld(path);
  if (!beingWritten_ && hasHotJournal(path)) {
    copyFolder_ = copyWithJournal(path);
    database_ = std::make_unique<SqliteDatabase>(copyFolder_ / "copy.palpate",
                                                 SqliteDatabase::Mode::kReadWrite);
  } else {
    database_ = std::make_unique<SqliteDatabase>(path, SqliteDatabase::Mode::kReadOnly);
  }
  database_->limitWork(size);
  database_->execute("PRAGMA cell_size_check=ON");
  if (!beingWritten_) database_->execute("BEGIN");
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
  unfinished_ = !beingWritten_ && meta_["finished"] != "1";
}

PalpateAccess::~PalpateAccess() {
  database_.reset();
  std::error_code ignored;
  if (!copyFolder_.empty()) fs::remove_all(copyFolder_, ignored);
}

}  // namespace palpate
