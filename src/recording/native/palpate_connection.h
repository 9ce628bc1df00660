// Access to the file of a native recording: the rollback journal that may lie beside it, and the
// opening for reading, whatever state the file is in. Private to this module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "palpate/core/file_id.h"

#include "recording/native/palpate_rows.h"
#include "recording/native/sqlite_database.h"

namespace palpate {

// Whether a rollback journal has to be played back: its header's magic is there. The journal of a
// finished commit has zeros instead, or is empty. Throws FileError when something else than a file
// has its name: whoever opens that may wait for ever.
bool hasHotJournal(const std::filesystem::path& recording);
// Throws FileError when such a journal lies beside PATH, which isn't there itself (or is about
// to be replaced): SQLite would play it back into whatever gets that name.
void refuseForeignJournal(const std::filesystem::path& recording);

// A native recording opened for reading. One whose writer died within a commit is opened as a
// temporary copy, into which SQLite plays the journal back: the file itself is never changed.
class PalpateConnection {
 public:
  // Throws FileError, FormatError. Statements that take longer than any honest file of this size
  // needs fail, until the caller ends that by database().unlimitWork().
  explicit PalpateConnection(const std::filesystem::path& path);
  ~PalpateConnection();  // removes the temporary copy, if there is one
  PalpateConnection(const PalpateConnection&) = delete;
  PalpateConnection& operator=(const PalpateConnection&) = delete;

  SqliteDatabase& database() { return *database_; }
  const MetaRows& meta() const noexcept { return meta_; }
  bool unfinished() const noexcept { return unfinished_; }  // its writer died
  // Then every statement is a transaction of its own, so that the writer never waits long; rows are
  // only ever added. Otherwise all reading is one transaction: that saves the locking.
  bool beingWritten() const noexcept { return beingWritten_; }
  // From here on only blocks are read: those of a finished recording never change, so that no lock
  // is held that would keep others from saving its events. Statements must be prepared anew. Throws
  // FileError: the file was replaced meanwhile.
  void readBlocksOnly();

 private:
  void open(const std::filesystem::path& path);
  bool copyHot();

  std::filesystem::path path_;  // no link
  std::filesystem::path copyFolder_;
  std::optional<FileId> file_;
  std::unique_ptr<SqliteDatabase> database_;
  MetaRows meta_;
  bool unfinished_ = false;
  bool beingWritten_ = false;
};

}  // namespace palpate
