#include "recording/palpate_rows.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/core/error.h"

namespace palpate {
namespace {

Mask maskFrom(const std::string& text, std::size_t places, const std::filesystem::path& path) {
  Mask mask;
  for (char c : text) mask.push_back(c == '1');
  if (mask.size() != places) throw FormatError(path, "a mask has the wrong size");
  return mask;
}

}  // namespace

void createTables(SqliteDatabase& database) {
  database.execute(
      "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL, crc32 INTEGER NOT NULL)"
      " WITHOUT ROWID;"
      "CREATE TABLE matrix(idx INTEGER PRIMARY KEY, rows INTEGER NOT NULL, columns INTEGER NOT "
      "NULL,"
      " pitch_mm REAL NOT NULL, static_mask TEXT NOT NULL, dynamic_mask TEXT NOT NULL,"
      " uid TEXT NOT NULL, crc32 INTEGER NOT NULL);"
      "CREATE TABLE block(id INTEGER PRIMARY KEY, stream INTEGER NOT NULL, first INTEGER NOT NULL,"
      " n INTEGER NOT NULL, t0_us INTEGER NOT NULL, t1_us INTEGER NOT NULL,"
      " coding INTEGER NOT NULL, crc32 INTEGER NOT NULL, data BLOB NOT NULL);"
      "CREATE TABLE second(t_s INTEGER NOT NULL, matrix INTEGER NOT NULL, frames INTEGER NOT NULL,"
      " min REAL NOT NULL, max REAL NOT NULL, sum REAL NOT NULL, active_max INTEGER NOT NULL,"
      " crc32 INTEGER NOT NULL);"
      "CREATE TABLE event(id INTEGER PRIMARY KEY, t_us INTEGER NOT NULL, t1_us INTEGER NOT NULL,"
      " kind TEXT NOT NULL, matrix INTEGER, text TEXT NOT NULL, json TEXT NOT NULL,"
      " crc32 INTEGER NOT NULL);"
      "CREATE TABLE counter(name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID;");
}

void createBlockIndex(SqliteDatabase& database) {
  database.execute("CREATE INDEX IF NOT EXISTS block_at ON block(stream, first, n, t0_us, t1_us);");
}

std::uint32_t metaCrc(std::string_view key, std::string_view value) {
  return RowCrc().text(key).text(value).value();
}

std::string maskText(const Mask& mask) {
  std::string text;
  for (auto on : mask) text += on ? '1' : '0';
  return text;
}

std::uint32_t matrixCrc(int index, const MatrixLayout& matrix, std::string_view uid) {
  return RowCrc()
      .integer(index)
      .integer(matrix.rows)
      .integer(matrix.columns)
      .real(matrix.pitchMm)
      .text(maskText(matrix.staticMask))
      .text(maskText(matrix.dynamicMask))
      .text(uid)
      .value();
}

std::uint32_t secondCrc(const SecondSummary& row) {
  return RowCrc()
      .integer(row.tS)
      .integer(row.matrix)
      .integer(row.frames)
      .real(row.minimum)
      .real(row.maximum)
      .real(row.sum)
      .integer(row.activeMax)
      .value();
}

std::uint32_t eventCrc(std::int64_t id, const RecordingEvent& event) {
  RowCrc crc;
  crc.integer(id).integer(event.tUs).integer(event.t1Us).text(event.kind);
  if (event.matrix) crc.integer(*event.matrix);
  return crc.text(event.text).text(event.json).value();
}

void insertMeta(SqliteDatabase& database, std::string_view key, std::string_view value) {
  database.prepare("INSERT OR REPLACE INTO meta VALUES(?, ?, ?)")
      .bind(1, key)
      .bind(2, value)
      .bind(3, static_cast<std::int64_t>(metaCrc(key, value)))
      .run();
}

void insertMatrices(SqliteDatabase& database, const SensorLayout& layout) {
  SqliteStatement insert = database.prepare("INSERT INTO matrix VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    const std::string staticMask = maskText(matrix.staticMask);
    const std::string dynamicMask = maskText(matrix.dynamicMask);
    insert.bind(1, static_cast<std::int64_t>(m))
        .bind(2, static_cast<std::int64_t>(matrix.rows))
        .bind(3, static_cast<std::int64_t>(matrix.columns))
        .bind(4, matrix.pitchMm)
        .bind(5, std::string_view(staticMask))
        .bind(6, std::string_view(dynamicMask))
        .bind(7, std::string_view())
        .bind(8, static_cast<std::int64_t>(matrixCrc(static_cast<int>(m), matrix, {})))
        .run();
  }
}

SensorLayout readLayout(SqliteDatabase& database) {
  const std::filesystem::path& path = database.path();
  std::vector<MatrixLayout> matrices;
  SqliteStatement rows = database.prepare(
      "SELECT idx, rows, columns, pitch_mm, static_mask, dynamic_mask, uid, crc32 FROM matrix"
      " ORDER BY idx");
  while (rows.next()) {
    MatrixLayout matrix;
    matrix.rows = static_cast<int>(std::clamp<std::int64_t>(rows.integer(1), 0, 1'000'000));
    matrix.columns = static_cast<int>(std::clamp<std::int64_t>(rows.integer(2), 0, 1'000'000));
    matrix.pitchMm = rows.real(3);
    matrix.staticMask = maskFrom(rows.text(4), matrix.numPlaces(), path);
    matrix.dynamicMask = maskFrom(rows.text(5), matrix.numPlaces(), path);
    if (rows.integer(0) != static_cast<std::int64_t>(matrices.size()) ||
        rows.integer(7) != matrixCrc(static_cast<int>(matrices.size()), matrix, rows.text(6)))
      throw FormatError(path, "the layout of its matrices is damaged; try 'palpate recover'");
    matrices.push_back(std::move(matrix));
  }
  try {
    return SensorLayout(std::move(matrices));
  } catch (const std::invalid_argument& error) {
    throw FormatError(path,
                      std::string("the layout of its matrices makes no sense: ") + error.what());
  }
}

std::string readMeta(SqliteDatabase& database, std::string_view key) {
  SqliteStatement query = database.prepare("SELECT value, crc32 FROM meta WHERE key=?");
  query.bind(1, key);
  if (!query.next()) return {};
  const std::string value = query.text(0);
  return query.integer(1) == static_cast<std::int64_t>(metaCrc(key, value)) ? value : std::string();
}

RowWriter::RowWriter(SqliteDatabase& database)
    : block_(database.prepare("INSERT INTO block(stream, first, n, t0_us, t1_us, coding, crc32,"
                              " data) VALUES(?, ?, ?, ?, ?, ?, ?, ?)")),
      second_(database.prepare("INSERT INTO second VALUES(?, ?, ?, ?, ?, ?, ?, ?)")),
      event_(database.prepare("INSERT INTO event VALUES(?, ?, ?, ?, ?, ?, ?, ?)")),
      counter_(database.prepare("INSERT OR REPLACE INTO counter VALUES(?, ?)")) {}

void RowWriter::block(const Block& block) {
  block_.bind(1, static_cast<std::int64_t>(block.stream))
      .bind(2, block.first)
      .bind(3, block.n)
      .bind(4, block.t0Us)
      .bind(5, block.t1Us)
      .bind(6, static_cast<std::int64_t>(block.coding))
      .bind(7, static_cast<std::int64_t>(blockCrc(block)))
      .bind(8, std::span<const std::byte>(block.data))
      .run();
}

void RowWriter::second(const SecondSummary& row) {
  second_.bind(1, row.tS)
      .bind(2, static_cast<std::int64_t>(row.matrix))
      .bind(3, row.frames)
      .bind(4, row.minimum)
      .bind(5, row.maximum)
      .bind(6, row.sum)
      .bind(7, static_cast<std::int64_t>(row.activeMax))
      .bind(8, static_cast<std::int64_t>(secondCrc(row)))
      .run();
}

void RowWriter::event(std::int64_t id, const RecordingEvent& event) {
  event_.bind(1, id).bind(2, event.tUs).bind(3, event.t1Us).bind(4, std::string_view(event.kind));
  if (event.matrix)
    event_.bind(5, static_cast<std::int64_t>(*event.matrix));
  else
    event_.bindNull(5);
  event_.bind(6, std::string_view(event.text))
      .bind(7, std::string_view(event.json))
      .bind(8, static_cast<std::int64_t>(eventCrc(id, event)))
      .run();
}

void RowWriter::counter(const std::string& name, std::int64_t value) {
  counter_.bind(1, std::string_view(name)).bind(2, value).run();
}

}  // namespace palpate
