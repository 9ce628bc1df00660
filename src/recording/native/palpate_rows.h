// The tables of a native recording and their rows with their checksums: made, written, checked and
// read back. Private to this module.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/model/event.h"
#include "palpate/model/matrix_layout.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/recording_data.h"
#include "palpate/recording/second_summary.h"

#include "recording/native/sqlite_database.h"

namespace palpate {

// Throws FormatError unless the tables are those that createTables() makes (blanks and letter case
// aside) and nothing else could run code: what is no plain table is never queried.
void checkTables(SqliteDatabase& database);

// Makes the empty tables of a recording.
void createTables(SqliteDatabase& database, const SensorLayout& layout);
// Make the index over the blocks and the table for charts, when a recording is finished. Older
// ones, which an attempt that failed has left, are dropped.
void createBlockIndex(SqliteDatabase& database);
void createOverview(SqliteDatabase& database);

std::uint32_t metaCrc(std::string_view key, std::string_view value);
std::uint32_t matrixCrc(int index, const MatrixLayout& matrix, std::string_view uid);
std::uint32_t secondCrc(const SecondSummary& row);
std::uint32_t eventCrc(std::int64_t id, const Event& event);

// A mask as text: a character 0 or 1 per place, row by row.
std::string maskText(const Mask& mask);

void insertMeta(SqliteDatabase& database, std::string_view key, std::string_view value);
void insertMatrices(SqliteDatabase& database, const SensorLayout& layout);

struct MetaRows;
// Reads the layout back, with the rules of touch of a recording of readings; where these are
// damaged, with those of its hand if `rulesOfHand`. Throws FormatError where it is damaged or makes
// no sense.
SensorLayout readLayout(SqliteDatabase& database, const MetaRows& meta, bool rulesOfHand = false);

// The description of a series beside those of the hand. The first one makes the table.
void insertSeries(SqliteDatabase& database, std::size_t index, const SeriesDescription& series);
std::uint32_t seriesCrc(std::int64_t stream, const SeriesDescription& series);
// The description in a row; none where it isn't valid.
std::optional<SeriesDescription> seriesFrom(std::string name,
                                            std::string role,
                                            std::string source,
                                            const std::string& columnsJson);
struct SeriesRows {
  using WidthOf = std::function<std::size_t(std::size_t series)>;
  std::map<std::size_t, SeriesDescription> sound;  // by the index of the series
  std::size_t damaged = 0;
  // False: there is one with its index or its name, or no series of such a file has them.
  bool add(std::size_t index, SeriesDescription series);
  // Behind the last series that is described.
  std::size_t end() const;
  // Those from kHandSeries up to `end`. One that isn't described is "series_2", .. by its index,
  // with as many columns "1", "2", .. as `widthOf` says, at least one.
  std::vector<SeriesDescription> all(std::size_t end, const WidthOf& widthOf) const;
};
// Those of the file, none if it has no such table.
SeriesRows readSeries(SqliteDatabase& database);

// The block of a row in which stream, first, n, t0_us, t1_us and coding stand from `column` on and
// the data in `dataColumn`. Nothing is checked.
Block blockFrom(const SqliteStatement& row, int column, int dataColumn);

// The key of the table `meta` under which a finished recording says how many items a stream has.
std::string samplesKey(Stream stream);

// The key-value pairs of the table `meta`; rows with a wrong checksum are left out and counted.
struct MetaRows {
  RecordingMeta values;
  std::size_t damaged = 0;
  // The value of a key; empty when there is none.
  std::string operator[](const std::string& key) const;
  std::optional<std::int64_t> integer(const std::string& key) const;
};
MetaRows readMeta(SqliteDatabase& database);
// Calls back with number and content of every row of `event` in order of its number; rows with a
// wrong checksum are counted.
std::size_t forEachEventRow(SqliteDatabase& database,
                            const std::function<void(std::int64_t id, Event&& event)>& take);
EventsReport readEventRows(SqliteDatabase& database);
// In order of time, then matrix; `damaged` counts rows with a wrong checksum, which are left out.
std::vector<SecondSummary> readSecondRows(SqliteDatabase& database, std::size_t& damaged);

// The table `overview`: many seconds of the per-second summary packed in one row, for charts. The
// rows of a day's `second` table take half a second to read, these 20 ms. It is derived data, made
// when a recording is finished; without it `second` is read.
//
// writeOverview() makes the table from the rows of `second` and returns the number of seconds in
// it.
std::int64_t writeOverview(SqliteDatabase& database, std::size_t numMatrices);

// readOverview() gives nothing where there is no such table, where it hasn't `numSeconds` seconds,
// or where it is damaged anywhere.
std::optional<std::vector<SecondSummary>> readOverview(SqliteDatabase& database,
                                                       std::size_t numMatrices,
                                                       std::int64_t numSeconds);

// Statements that are run again and again while recording.
class RowWriter {
 public:
  explicit RowWriter(SqliteDatabase& database);
  void block(std::int64_t id, const Block& block);
  void second(std::int64_t id, const SecondSummary& row);
  void event(std::int64_t id, const Event& event);
  void counter(const std::string& name, std::int64_t value);

 private:
  SqliteStatement block_;
  SqliteStatement second_;
  SqliteStatement event_;
  SqliteStatement counter_;
};

}  // namespace palpate
