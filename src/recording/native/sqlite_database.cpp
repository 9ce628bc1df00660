#include "recording/native/sqlite_database.h"

#include <algorithm>
#include <array>
#include <utility>

#include <sqlite3.h>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

// Longest text or blob of a file, and most memory of the page cache.
constexpr int kMaxValueBytes = 2 << 20;
constexpr sqlite3_int64 kCopiedAtOnce = 1 << 20;
constexpr int kOpsPerLook = 100'000;
constexpr std::int64_t kFreeOps = 10'000'000;
constexpr std::int64_t kOpsPerByte = 50;

// SQLite's own switch for reading without locks, which only a URI can carry.
std::string unlockedUri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char letter : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '/' ||
        (byte > ' ' && byte < 0x7F && letter != '%' && letter != '?' && letter != '#'))
      uri += letter;
    else
      uri += "%" + hexDigits(byte, 2);
  }
  return uri + "?immutable=1";
}

// The methods of an open file, which in addition claims that open files can't be deleted: the one
// property that makes SQLite keep a journal open (its pager.c, pager_unlock).
struct UndeletableFileMethods {
  sqlite3_io_methods methods;  // first: SQLite's pointer to it leads back to this object
  int (*characteristics)(sqlite3_file*);
};

int undeletableCharacteristics(sqlite3_file* file) {
  const auto* own = reinterpret_cast<const UndeletableFileMethods*>(file->pMethods);
  return own->characteristics(file) | SQLITE_IOCAP_UNDELETABLE_WHEN_OPEN;
}

// An open file that is no longer found under its name can't be written: SQLite refuses it as
// read-only, or can't open its journal. The reason says more than that.
void throwIfGone(int code, const std::filesystem::path& path) {
  if (code != SQLITE_READONLY && code != SQLITE_IOERR && code != SQLITE_CANTOPEN) return;
  std::error_code failure;
  const std::filesystem::path folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::exists(folder, failure) && !failure)
    throw FileError(path, "is gone: its folder was moved, renamed or deleted");
  if (code != SQLITE_CANTOPEN && !std::filesystem::exists(path, failure) && !failure)
    throw FileError(path, "is gone: the file was moved, renamed or deleted");
}

}  // namespace

void throwSqliteError(sqlite3* connection, int code, const std::filesystem::path& path) {
  throwIfGone(code & 0xFF, path);
  switch (code & 0xFF) {
    case SQLITE_FULL:
      throw FileError(path, "can't be written: the disk is full");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      throw FileError(path, "can't be written: no permission, or a read-only folder");
    case SQLITE_CANTOPEN:
      throw FileError(path, "can't be opened");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw FileError(path, "is in use by another program");
    case SQLITE_IOERR:
      throw FileError(path, "can't be read or written: input/output error");
    case SQLITE_INTERRUPT:
      throw FormatError(path, "is damaged: its tables are longer than the file");
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_FORMAT:
      throw FormatError(path,
                        std::string("is damaged (") +
                            (connection ? sqlite3_errmsg(connection) : "no connection") +
                            "); 'palpate recover' may save what is left");
    default:
      throw FormatError(path,
                        std::string("SQLite: ") +
                            (connection ? sqlite3_errmsg(connection) : sqlite3_errstr(code)));
  }
}

SqliteStatement::SqliteStatement(sqlite3* connection,
                                 std::filesystem::path path,
                                 std::string_view sql)
    : connection_(connection), path_(std::move(path)) {
  const int code = sqlite3_prepare_v3(connection_,
                                      sql.data(),
                                      static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT,
                                      &statement_,
                                      nullptr);
  if (code != SQLITE_OK) throwSqliteError(connection_, code, path_);
}

SqliteStatement::SqliteStatement(SqliteStatement&& other) noexcept
    : connection_(other.connection_),
      path_(std::move(other.path_)),
      statement_(std::exchange(other.statement_, nullptr)) {}

SqliteStatement::~SqliteStatement() { sqlite3_finalize(statement_); }

SqliteStatement& SqliteStatement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_, parameter, value);
  return *this;
}
SqliteStatement& SqliteStatement::bind(int parameter, double value) {
  sqlite3_bind_double(statement_, parameter, value);
  return *this;
}
SqliteStatement& SqliteStatement::bind(int parameter, std::string_view value) {
  // A null pointer would be NULL, not an empty text.
  const char* bytes = value.data() ? value.data() : "";
  sqlite3_bind_text64(statement_, parameter, bytes, value.size(), SQLITE_STATIC, SQLITE_UTF8);
  return *this;
}
SqliteStatement& SqliteStatement::bind(int parameter, std::span<const std::byte> value) {
  sqlite3_bind_blob64(statement_, parameter, value.data(), value.size(), SQLITE_STATIC);
  return *this;
}
SqliteStatement& SqliteStatement::bindNull(int parameter) {
  sqlite3_bind_null(statement_, parameter);
  return *this;
}

bool SqliteStatement::next() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(statement_);
  if (code != SQLITE_DONE) throwSqliteError(connection_, code, path_);
  return false;
}

void SqliteStatement::run() {
  while (next()) {
  }
}

void SqliteStatement::reset() { sqlite3_reset(statement_); }

bool SqliteStatement::isNull(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}
std::int64_t SqliteStatement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}
double SqliteStatement::real(int column) const { return sqlite3_column_double(statement_, column); }
std::string SqliteStatement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return bytes ? std::string(bytes, static_cast<std::size_t>(size)) : std::string();
}
std::span<const std::byte> SqliteStatement::blob(int column) const {
  const auto* bytes = static_cast<const std::byte*>(sqlite3_column_blob(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return {bytes, bytes ? static_cast<std::size_t>(size) : 0};
}

SqliteDatabase::SqliteDatabase(std::filesystem::path path, Mode mode, const std::string& vfs)
    : path_(std::move(path)) {
  int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
  const bool reads = mode == Mode::kReadOnly || mode == Mode::kUnlocked;
  flags |= reads ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE;
  if (mode == Mode::kCreate) flags |= SQLITE_OPEN_CREATE;
  if (mode == Mode::kUnlocked) flags |= SQLITE_OPEN_URI;
  const std::string name = mode == Mode::kUnlocked ? unlockedUri(path_) : path_.string();
  const int code =
      sqlite3_open_v2(name.c_str(), &connection_, flags, vfs.empty() ? nullptr : vfs.c_str());
  if (code != SQLITE_OK) {
    sqlite3_close(std::exchange(connection_, nullptr));
    throwSqliteError(nullptr, code, path_);
  }
  // Between the opening and the look another file may have been given the name.
  file_ = fileIdOf(path_);
  int moved = 0;
  if (mode == Mode::kReadWrite &&
      sqlite3_file_control(connection_, "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK &&
      moved != 0) {
    sqlite3_close(std::exchange(connection_, nullptr));
    throw FileError(path_, "is gone: it was moved, deleted or replaced while it was being opened");
  }
  sqlite3_busy_timeout(connection_, 5000);
  // Files come from anywhere: nothing a file says may run code or be followed blindly.
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(connection_, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  sqlite3_limit(connection_, SQLITE_LIMIT_ATTACHED, 0);
}

SqliteDatabase::~SqliteDatabase() { sqlite3_close_v2(connection_); }

void SqliteDatabase::execute(const std::string& sql) {
  const int code = sqlite3_exec(connection_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throwSqliteError(connection_, code, path_);
}

SqliteStatement SqliteDatabase::prepare(std::string_view sql) { return {connection_, path_, sql}; }

std::int64_t SqliteDatabase::integerOf(std::string_view query) {
  SqliteStatement statement = prepare(query);
  return statement.next() ? statement.integer(0) : 0;
}

void SqliteDatabase::rollBack() noexcept {
  if (inTransaction()) sqlite3_exec(connection_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void SqliteDatabase::limitWork(std::uint64_t fileBytes) {
  workLeft_ = kFreeOps + kOpsPerByte * static_cast<std::int64_t>(fileBytes);
  const auto look = [](void* left) {
    auto& ops = *static_cast<std::int64_t*>(left);
    ops -= kOpsPerLook;
    return ops < 0 ? 1 : 0;
  };
  sqlite3_progress_handler(connection_, kOpsPerLook, look, &workLeft_);
}

void SqliteDatabase::unlimitWork() { sqlite3_progress_handler(connection_, 0, nullptr, nullptr); }

sqlite3_file* SqliteDatabase::openFile() const {
  sqlite3_file* file = nullptr;
  const int code = sqlite3_file_control(connection_, "main", SQLITE_FCNTL_FILE_POINTER, &file);
  if (code != SQLITE_OK || !file || !file->pMethods) throwSqliteError(connection_, code, path_);
  return file;
}

void SqliteDatabase::keepJournalOpen() {
  sqlite3_file* const file = openFile();
  const auto own = std::make_shared<UndeletableFileMethods>();
  own->methods = *file->pMethods;
  own->characteristics = own->methods.xDeviceCharacteristics;
  own->methods.xDeviceCharacteristics = undeletableCharacteristics;
  file->pMethods = &own->methods;
  fileMethods_ = own;
}

void SqliteDatabase::copyTo(OutputFile& out) {
  constexpr const char* kUnreadable = "can't be read any more: input/output error";
  try {
    // Undoes a commit that failed half way.
    integerOf("SELECT count(*) FROM sqlite_schema");
  } catch (const FileError&) {
    throw FormatError(path_, kUnreadable);
  }
  sqlite3_file* const file = openFile();
  sqlite3_int64 size = 0;
  int code = file->pMethods->xFileSize(file, &size);
  std::string piece;
  for (sqlite3_int64 at = 0; code == SQLITE_OK && at < size;
       at += static_cast<sqlite3_int64>(piece.size())) {
    piece.resize(static_cast<std::size_t>(std::min<sqlite3_int64>(kCopiedAtOnce, size - at)));
    code = file->pMethods->xRead(file, piece.data(), static_cast<int>(piece.size()), at);
    if (code == SQLITE_OK) out.write(piece);
  }
  if (code != SQLITE_OK) throw FormatError(path_, kUnreadable);
}

// Database file format of SQLite, section 1.3: the file change counter and the size in pages are
// two numbers of four bytes, most significant first.
std::optional<SqliteDatabase::Version> SqliteDatabase::version() const {
  constexpr sqlite3_int64 kAt = 24;
  std::array<unsigned char, 8> bytes{};
  sqlite3_file* const file = openFile();
  if (file->pMethods->xRead(file, bytes.data(), static_cast<int>(bytes.size()), kAt) != SQLITE_OK)
    return std::nullopt;
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | bytes.at(i);
    return value;
  };
  return Version{number(0), number(4)};
}

std::int64_t SqliteDatabase::sizeBytes() const {
  sqlite3_int64 size = 0;
  sqlite3_file* const file = openFile();
  return file->pMethods->xFileSize(file, &size) == SQLITE_OK ? size : 0;
}

bool SqliteDatabase::inTransaction() const { return sqlite3_get_autocommit(connection_) == 0; }

std::string SqliteDatabase::bytes() const {
  sqlite3_int64 size = 0;
  unsigned char* const copy = sqlite3_serialize(connection_, "main", &size, 0);
  if (!copy) throw FileError(path_, "can't be created: out of memory");
  std::string bytes(reinterpret_cast<const char*>(copy), static_cast<std::size_t>(size));
  sqlite3_free(copy);
  return bytes;
}

}  // namespace palpate
