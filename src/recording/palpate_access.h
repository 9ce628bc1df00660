// Opens a native recording for reading, whatever state it is in. Private to the room.
#pragma once

#include <filesystem>
#include <memory>

#include "recording/palpate_rows.h"
#include "recording/sqlite_database.h"

namespace palpate {

class PalpateAccess {
 public:
  // Throws FileError, FormatError. Until unlimited(), statements that take longer than any honest file
  // of this size fail.
  explicit PalpateAccess(const std::filesystem::path& path);
  ~PalpateAccess();  // removes the temporary copy, if there is one
  PalpateAccess(const PalpateAccess&) = delete;
  PalpateAccess& operator=(const PalpateAccess&) = delete;

  SqliteDatabase& database() { return *database_; }
  const MetaRows& meta() const noexcept { return meta_; }
  bool unfinished() const noexcept { return unfinished_; }  // its writer died
  // Then every statement is a transaction of its own, so that the writer never waits long; rows are
  // only ever added. Otherwise all reading is one transaction: that saves the locking.
  bool beingWritten() const noexcept { return beingWritten_; }

 private:
  void open(const std::filesystem::path& path);

  std::filesystem::path copyFolder_;
  std::unique_ptr<SqliteDatabase> database_;
  MetaRows meta_;
  bool unfinished_ = false;
  bool beingWritten_ = false;
};

}  // namespace palpate
