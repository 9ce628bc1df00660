// Opens a native recording for reading, whatever state it is in. Private to this module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

#include "recording/native/palpate_rows.h"
#include "recording/native/sqlite_database.h"

namespace palpate {

// Device and inode of a file, 0 and 0: there is none. Another file under the same name has another.
std::pair<std::uint64_t, std::uint64_t> identityOf(const std::filesystem::path& path);

class PalpateConnection {
 public:
  // Throws FileError, FormatError. Until unlimited(), statements that take longer than any honest
  // file of this size fail.
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
  std::pair<std::uint64_t, std::uint64_t> file_;  // its identity
  std::unique_ptr<SqliteDatabase> database_;
  MetaRows meta_;
  bool unfinished_ = false;
  bool beingWritten_ = false;
};

}  // namespace palpate
