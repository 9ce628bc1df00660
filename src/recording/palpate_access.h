// Opens a native recording for reading, whatever state it is in. Private to the room.
#pragma once

#include <filesystem>
#include <memory>

#include "recording/sqlite_database.h"

namespace palpate {

class PalpateAccess {
 public:
  // Throws FileError, FormatError.
  explicit PalpateAccess(const std::filesystem::path& path);
  ~PalpateAccess();  // removes the temporary copy, if there is one
  PalpateAccess(const PalpateAccess&) = delete;
  PalpateAccess& operator=(const PalpateAccess&) = delete;

  SqliteDatabase& database() { return *database_; }
  bool unfinished() const noexcept { return unfinished_; }  // its writer died
  bool beingWritten() const noexcept { return beingWritten_; }

 private:
  std::filesystem::path copyFolder_;
  std::unique_ptr<SqliteDatabase> database_;
  bool unfinished_ = false;
  bool beingWritten_ = false;
};

}  // namespace palpate
