// A thin layer over SQLite's C interface that closes what it opens and throws what fails: a
// connection and its statements. Private to this module.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "palpate/core/file_id.h"
#include "palpate/core/output_file.h"

struct sqlite3;
struct sqlite3_file;
struct sqlite3_stmt;

namespace palpate {

// A prepared statement of a connection, which must outlive it.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* connection, std::filesystem::path path, std::string_view sql);
  SqliteStatement(SqliteStatement&& other) noexcept;
  ~SqliteStatement();

  // Parameters count from 1. Texts and blobs must live until the next run() or reset().
  SqliteStatement& bind(int parameter, std::int64_t value);
  SqliteStatement& bind(int parameter, double value);
  SqliteStatement& bind(int parameter, std::string_view value);
  SqliteStatement& bind(int parameter, std::span<const std::byte> value);
  SqliteStatement& bindNull(int parameter);

  // Next row of a query; false at the end (then it is reset and can run again).
  bool next();
  // Runs a statement without rows to its end.
  void run();
  void reset();

  // Columns count from 0; valid until the next next().
  bool isNull(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;

 private:
  sqlite3* connection_;
  std::filesystem::path path_;
  sqlite3_stmt* statement_ = nullptr;
};

// A connection to one file, for one thread. A file is not trusted: it can run no code and is
// bounded in what it costs.
class SqliteDatabase {
 public:
  // kUnlocked reads without locks and without looking for changes: only for pages that nobody
  // changes.
  enum class Mode { kReadOnly, kReadWrite, kCreate, kUnlocked };
  // Throws FileError. `vfs`: a registered SQLite file system, empty for the default.
  SqliteDatabase(std::filesystem::path path, Mode mode, const std::string& vfs = {});
  ~SqliteDatabase();
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;

  // Runs statements that give no rows. Throws FileError, FormatError, as all statements do.
  void execute(const std::string& sql);
  SqliteStatement prepare(std::string_view sql);
  // The first column of a query's first row; 0 where it gives no row.
  std::int64_t integerOf(std::string_view query);
  bool inTransaction() const;
  // Between two transactions the rollback journal stays open (with journal_mode PERSIST or
  // TRUNCATE). Otherwise SQLite opens it anew for each, and syncs its folder each time.
  void keepJournalOpen();
  // Ends a transaction without result; never throws (after a failed commit there may be none left).
  void rollBack() noexcept;
  // Ends statements that run for longer than any honest file of this size needs (pages that point
  // to each other make b-trees of any length); they throw FormatError. Counts from here on.
  void limitWork(std::uint64_t fileBytes);
  void unlimitWork();
  // The whole database as the bytes of its file, what was committed. Throws FileError (no memory).
  std::string bytes() const;
  // Appends the bytes of its file, what was committed, to another file: in little memory, and also
  // when the file has lost its name. Nobody may write meanwhile. Throws FileError (the other file
  // can't be written), FormatError (this one can't be read).
  void copyTo(OutputFile& out);
  // The part of the header that every commit changes, as it stands in the file: empty where the
  // file is shorter. Within a transaction nobody else who keeps to SQLite's locks changes it.
  struct Version {
    std::uint32_t numCommits = 0;
    std::uint32_t numPages = 0;
    auto operator<=>(const Version&) const = default;
  };
  std::optional<Version> version() const;
  std::int64_t sizeBytes() const;  // of its file; 0 where that can't be told
  const std::filesystem::path& path() const noexcept { return path_; }
  // The file that was opened; empty for one in memory.
  const std::optional<FileId>& file() const noexcept { return file_; }

 private:
  sqlite3_file* openFile() const;

  std::filesystem::path path_;
  std::shared_ptr<const void> fileMethods_;  // of keepJournalOpen(); outlives the connection
  sqlite3* connection_ = nullptr;
  std::int64_t workLeft_ = 0;
  std::optional<FileId> file_;
};

// Throws FileError (the world) or FormatError (damaged content) for a failed call.
[[noreturn]] void throwSqliteError(sqlite3* connection,
                                   int code,
                                   const std::filesystem::path& path);

}  // namespace palpate
