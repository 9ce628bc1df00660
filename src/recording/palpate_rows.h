// Rows of a native recording's tables, with their checksums. Private to the room.
#pragma once

#include <string>
#include <string_view>

#include "palpate/model/matrix_layout.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/palpate_writer.h"

#include "recording/second_summary.h"
#include "recording/sqlite_database.h"

namespace palpate {

// Makes the empty tables.
void createTables(SqliteDatabase& database);
// The index over the blocks, made when a recording is finished.
void createBlockIndex(SqliteDatabase& database);

std::uint32_t metaCrc(std::string_view key, std::string_view value);
std::uint32_t matrixCrc(int index, const MatrixLayout& matrix, std::string_view uid);
std::uint32_t secondCrc(const SecondSummary& row);
std::uint32_t eventCrc(std::int64_t id, const RecordingEvent& event);

// Masks as text: rows x columns characters 0 and 1.
std::string maskText(const Mask& mask);

void insertMeta(SqliteDatabase& database, std::string_view key, std::string_view value);
void insertMatrices(SqliteDatabase& database, const SensorLayout& layout);

// Reading back. Throws FormatError where the layout is damaged or makes no sense.
SensorLayout readLayout(SqliteDatabase& database);
// Empty when absent or damaged.
std::string readMeta(SqliteDatabase& database, std::string_view key);

// Statements that are run again and again while recording.
class RowWriter {
 public:
  explicit RowWriter(SqliteDatabase& database);
  void block(const Block& block);
  void second(const SecondSummary& row);
  void event(std::int64_t id, const RecordingEvent& event);
  void counter(const std::string& name, std::int64_t value);

 private:
  SqliteStatement block_;
  SqliteStatement second_;
  SqliteStatement event_;
  SqliteStatement counter_;
};

}  // namespace palpate
