#include "recording/native/palpate_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "palpate/core/byte_order.h"
#include "palpate/core/byte_reader.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/dsa_sensor.h"

namespace palpate {
namespace {

// The tables as they are made; a file whose tables are others is not read.
constexpr std::array<std::pair<const char*, const char*>, 6> kTables{{
    {"meta",
     "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL, crc32 INTEGER NOT NULL)"
     " WITHOUT ROWID"},
    {"matrix",
     "CREATE TABLE matrix(idx INTEGER PRIMARY KEY, rows INTEGER NOT NULL, columns INTEGER NOT NULL,"
     " pitch_mm REAL NOT NULL, static_mask TEXT NOT NULL, dynamic_mask TEXT NOT NULL,"
     " uid TEXT NOT NULL, crc32 INTEGER NOT NULL)"},
    {"block",
     "CREATE TABLE block(id INTEGER PRIMARY KEY, stream INTEGER NOT NULL, first INTEGER NOT NULL,"
     " n INTEGER NOT NULL, t0_us INTEGER NOT NULL, t1_us INTEGER NOT NULL,"
     " coding INTEGER NOT NULL, crc32 INTEGER NOT NULL, data BLOB NOT NULL)"},
    {"second",
     "CREATE TABLE second(t_s INTEGER NOT NULL, matrix INTEGER NOT NULL, frames INTEGER NOT NULL,"
     " min REAL NOT NULL, max REAL NOT NULL, sum REAL NOT NULL, active_max INTEGER NOT NULL,"
     " crc32 INTEGER NOT NULL)"},
    {"event",
     "CREATE TABLE event(id INTEGER PRIMARY KEY, t_us INTEGER NOT NULL, t1_us INTEGER NOT NULL,"
     " kind TEXT NOT NULL, matrix INTEGER, text TEXT NOT NULL, json TEXT NOT NULL,"
     " crc32 INTEGER NOT NULL)"},
    {"counter",
     "CREATE TABLE counter(name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID"},
}};
// In files whose taxels lie farther apart along one side; `pitch_mm` is then the one along a row.
constexpr const char* kMatrixTableOfTwoPitches =
    "CREATE TABLE matrix(idx INTEGER PRIMARY KEY, rows INTEGER NOT NULL, columns INTEGER NOT NULL,"
    " pitch_mm REAL NOT NULL, static_mask TEXT NOT NULL, dynamic_mask TEXT NOT NULL,"
    " uid TEXT NOT NULL, crc32 INTEGER NOT NULL, pitch_y_mm REAL NOT NULL)";
// Made when a recording is finished; may be missing.
constexpr const char* kOverviewTable =
    "CREATE TABLE overview(id INTEGER PRIMARY KEY, n INTEGER NOT NULL, crc32 INTEGER NOT NULL,"
    " data BLOB NOT NULL)";
// Only in files with series beside those of the hand. `idx` is the number of the stream.
constexpr const char* kSeriesTable =
    "CREATE TABLE series(idx INTEGER PRIMARY KEY, name TEXT NOT NULL, role TEXT NOT NULL,"
    " source TEXT NOT NULL, columns TEXT NOT NULL, crc32 INTEGER NOT NULL)";
constexpr const char* kBlockIndex =
    "CREATE INDEX block_at ON block(stream, first, n, t0_us, t1_us)";

// SQL without what doesn't matter: blanks, and small letters.
std::string normalized(std::string_view sql) {
  std::string text;
  for (char letter : sql)
    if (letter != ' ' && letter != '\n' && letter != '\t' && letter != '\r')
      text += letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  return text;
}

Mask maskFrom(const std::string& text, std::size_t places, const std::filesystem::path& path) {
  if (text.size() != places) throw FormatError(path, "a mask has the wrong size");
  Mask mask;
  mask.reserve(places);
  for (char c : text) mask.push_back(c == '1');
  return mask;
}

// Per second: i64 t_s, then per matrix u32 frames, f32 min, f32 max, f64 sum, u32 active_max.
constexpr std::size_t kMatrixBytes = 4 + 4 + 4 + 8 + 4;

std::uint32_t overviewCrc(std::int64_t id, std::int64_t n, std::span<const std::byte> data) {
  return RowCrc()
      .integer(id)
      .integer(n)
      .text({reinterpret_cast<const char*>(data.data()), data.size()})
      .value();
}

}  // namespace

void createTables(SqliteDatabase& database, const SensorLayout& layout) {
  for (const auto& [name, sql] : kTables)
    database.execute(std::string_view(name) == "matrix" && !layout.hasSquareTaxels()
                         ? kMatrixTableOfTwoPitches
                         : sql);
}

void createBlockIndex(SqliteDatabase& database) {
  database.execute("DROP INDEX IF EXISTS block_at");
  database.execute(kBlockIndex);
}

void createOverview(SqliteDatabase& database) {
  database.execute("DROP TABLE IF EXISTS overview");
  database.execute(kOverviewTable);
}

void checkTables(SqliteDatabase& database) {
  std::size_t found = 0;
  SqliteStatement rows = database.prepare("SELECT type, name, rootpage, sql FROM sqlite_schema");
  while (rows.next()) {
    const std::string type = rows.text(0);
    const std::string name = rows.text(1);
    const auto known = std::find_if(
        kTables.begin(), kTables.end(), [&](const auto& table) { return name == table.first; });
    const bool isTable = type == "table" && rows.integer(2) > 0;
    const bool isIndex = type == "index";
    if (const char* sql = name == "overview" ? kOverviewTable
                          : name == "series" ? kSeriesTable
                                             : nullptr) {
      if (!isTable || normalized(rows.text(3)) != normalized(sql))
        throw FormatError(database.path(), "its table '" + name + "' is not as the format has it");
    } else if (known != kTables.end()) {
      const std::string has = normalized(rows.text(3));
      const bool twoPitches = name == "matrix" && has == normalized(kMatrixTableOfTwoPitches);
      if (!isTable || (has != normalized(known->second) && !twoPitches))
        throw FormatError(database.path(),
                          "its table '" + shortened(name) + "' is not as the format has it");
      ++found;
    } else if (isIndex && !rows.isNull(3) && normalized(rows.text(3)) != normalized(kBlockIndex)) {
      throw FormatError(database.path(), "has an index that the format doesn't have");
    } else if (!isTable && !isIndex) {
      throw FormatError(database.path(), "has a " + type + ", which the format doesn't have");
    }
  }
  if (found != kTables.size()) throw FormatError(database.path(), "tables are missing");
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
  RowCrc crc;
  crc.integer(index)
      .integer(matrix.rows)
      .integer(matrix.columns)
      .real(matrix.pitchMm.x)
      .text(maskText(matrix.staticMask))
      .text(maskText(matrix.dynamicMask))
      .text(uid);
  if (!matrix.pitchMm.isSquare()) crc.real(matrix.pitchMm.y);
  return crc.value();
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

std::uint32_t eventCrc(std::int64_t id, const Event& event) {
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
  const bool square = layout.hasSquareTaxels();
  SqliteStatement insert = database.prepare("INSERT INTO matrix VALUES(?, ?, ?, ?, ?, ?, ?, ?" +
                                            std::string(square ? ")" : ", ?)"));
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    const std::string staticMask = maskText(matrix.staticMask);
    const std::string dynamicMask = maskText(matrix.dynamicMask);
    insert.bind(1, static_cast<std::int64_t>(m))
        .bind(2, static_cast<std::int64_t>(matrix.rows))
        .bind(3, static_cast<std::int64_t>(matrix.columns))
        .bind(4, matrix.pitchMm.x)
        .bind(5, std::string_view(staticMask))
        .bind(6, std::string_view(dynamicMask))
        .bind(7, std::string_view(matrix.uniqueId))
        .bind(8,
              static_cast<std::int64_t>(matrixCrc(static_cast<int>(m), matrix, matrix.uniqueId)));
    if (!square) insert.bind(9, matrix.pitchMm.y);
    insert.run();
  }
}

namespace {

// The layout of the hand where rows of the meta data are damaged, perhaps the rules of touch, and
// the hand decides touch; else null.
std::shared_ptr<const SensorLayout> handLostRules(SqliteDatabase& database, const MetaRows& meta) {
  // Where the key is damaged, any damaged row may be the one.
  if (meta.damaged == 0 || !meta[kTouchRulesKey].empty() ||
      database.integerOf("PRAGMA user_version") != kPalpateVersionWithSeries)
    return nullptr;
  try {
    const HandDescription hand = parseHand(meta["hand_json"], meta["hand_urdf"], "hand.json");
    return hand.layout->decidesTouch() ? hand.layout : nullptr;
  } catch (const Error&) {
    if (database.integerOf("SELECT count(*) FROM meta WHERE key='touch_rules'") != 0)
      throw FormatError(database.path(),
                        "how its frames tell what is touched (touch_rules) is damaged, and so is "
                        "the description of its hand");
    return nullptr;
  }
}

}  // namespace

SensorLayout readLayout(SqliteDatabase& database, const MetaRows& meta, bool rulesOfHand) {
  const std::filesystem::path& path = database.path();
  std::vector<MatrixLayout> matrices;
  const bool twoPitches = database.integerOf(
                              "SELECT count(*) FROM pragma_table_info('matrix')"
                              " WHERE name = 'pitch_y_mm'") != 0;
  SqliteStatement rows = database.prepare(
      "SELECT idx, rows, columns, pitch_mm, static_mask, dynamic_mask, uid, crc32, " +
      std::string(twoPitches ? "pitch_y_mm" : "pitch_mm") + " FROM matrix ORDER BY idx");
  std::size_t places = 0;
  while (rows.next()) {
    MatrixLayout matrix;
    if (matrices.size() == kMaxMatrices)
      throw FormatError(path, "has more than " + std::to_string(kMaxMatrices) + " matrices");
    matrix.rows = static_cast<int>(std::clamp<std::int64_t>(rows.integer(1), 0, 1'000'000));
    matrix.columns = static_cast<int>(std::clamp<std::int64_t>(rows.integer(2), 0, 1'000'000));
    matrix.pitchMm = {rows.real(3), rows.real(8)};
    places += matrix.numCells();
    if (places > kMaxPlaces)
      throw FormatError(
          path,
          "a matrix is too large: more than " + std::to_string(kMaxPlaces) + " places in all");
    matrix.staticMask = maskFrom(rows.text(4), matrix.numCells(), path);
    matrix.dynamicMask = maskFrom(rows.text(5), matrix.numCells(), path);
    if (rows.integer(0) != static_cast<std::int64_t>(matrices.size()) ||
        rows.integer(7) != matrixCrc(static_cast<int>(matrices.size()), matrix, rows.text(6)))
      throw FormatError(path, "the layout of its matrices is damaged; try 'palpate recover'");
    if (isSensorId(rows.text(6))) matrix.uniqueId = rows.text(6);
    matrices.push_back(std::move(matrix));
  }
  std::string rules = meta[kTouchRulesKey];
  if (const auto hand = handLostRules(database, meta)) {
    if (!rulesOfHand)
      throw FormatError(path,
                        "how its frames tell what is touched (touch_rules) is damaged; try "
                        "'palpate recover'");
    rules = touchRulesText(*hand);
  }
  try {
    const SensorLayout layout(std::move(matrices));
    return rules.empty() ? layout : withTouchRules(layout, rules);
  } catch (const std::exception& error) {
    throw FormatError(path, std::string("the layout of its matrices is invalid: ") + error.what());
  }
}

namespace {

std::string columnsText(const std::vector<Column>& columns) {
  return jsonList(columns,
                  [](const Column& column) {
                    return Json::object().set("name", column.name).set("unit", column.unit);
                  })
      .text(-1);
}

}  // namespace

void insertSeries(SqliteDatabase& database, std::size_t index, const SeriesDescription& series) {
  const auto stream = static_cast<std::int64_t>(streamOfSeries(index));
  const std::string columns = columnsText(series.columns);
  if (index == kHandSeries) database.execute(kSeriesTable);
  database.prepare("INSERT INTO series VALUES(?, ?, ?, ?, ?, ?)")
      .bind(1, stream)
      .bind(2, std::string_view(series.name))
      .bind(3, std::string_view(series.role))
      .bind(4, std::string_view(series.source))
      .bind(5, std::string_view(columns))
      .bind(6, static_cast<std::int64_t>(seriesCrc(stream, series)))
      .run();
}

std::uint32_t seriesCrc(std::int64_t stream, const SeriesDescription& series) {
  return RowCrc()
      .integer(stream)
      .text(series.name)
      .text(series.role)
      .text(series.source)
      .text(columnsText(series.columns))
      .value();
}

std::optional<SeriesDescription> seriesFrom(std::string name,
                                            std::string role,
                                            std::string source,
                                            const std::string& columnsJson) {
  SeriesDescription series{std::move(name), std::move(role), {}, std::move(source)};
  try {
    const Json columns = Json::parse(columnsJson);
    for (std::size_t i = 0; i < columns.size(); ++i)
      series.columns.push_back(
          {columns.at(i).at("name").asString(), columns.at(i).at("unit").asString()});
    validate(series);
  } catch (const std::exception&) {  // no JSON, another shape, or not valid
    return std::nullopt;
  }
  return series;
}

bool SeriesRows::add(std::size_t index, SeriesDescription series) {
  constexpr std::array<std::string_view, kHandSeries> kOwn{"angles", "temperatures"};
  const auto hasName = [&](const auto& other) { return other.second.name == series.name; };
  if (index < kHandSeries || index >= kMaxSeries ||
      std::find(kOwn.begin(), kOwn.end(), series.name) != kOwn.end() ||
      std::any_of(sound.begin(), sound.end(), hasName))
    return false;
  return sound.try_emplace(index, std::move(series)).second;
}

std::size_t SeriesRows::end() const {
  return sound.empty() ? kHandSeries : sound.rbegin()->first + 1;
}

std::vector<SeriesDescription> SeriesRows::all(std::size_t end, const WidthOf& widthOf) const {
  std::vector<SeriesDescription> all;
  for (std::size_t index = kHandSeries; index < end; ++index) {
    const auto found = sound.find(index);
    if (found != sound.end()) {
      all.push_back(found->second);
      continue;
    }
    SeriesDescription series;
    series.name = "series_" + std::to_string(index);
    while (std::any_of(sound.begin(), sound.end(), [&](const auto& other) {
      return other.second.name == series.name;
    }))
      series.name += '_';
    for (std::size_t i = 1; i <= std::max<std::size_t>(1, widthOf(index)); ++i)
      series.columns.push_back({std::to_string(i), ""});
    all.push_back(std::move(series));
  }
  return all;
}

SeriesRows readSeries(SqliteDatabase& database) {
  SeriesRows read;
  if (database.integerOf("SELECT count(*) FROM sqlite_schema WHERE name='series'") == 0)
    return read;
  SqliteStatement rows =
      database.prepare("SELECT idx, name, role, source, columns, crc32 FROM series ORDER BY idx");
  while (rows.next()) {
    const std::int64_t stream = rows.integer(0);
    auto series = seriesFrom(rows.text(1), rows.text(2), rows.text(3), rows.text(4));
    const bool isSound = series && stream > 0 && stream < std::int64_t{kMaxStreams} &&
                         rows.integer(5) == static_cast<std::int64_t>(seriesCrc(stream, *series));
    if (!isSound || !read.add(seriesOfStream(static_cast<Stream>(stream)), std::move(*series)))
      ++read.damaged;
    if (read.damaged > kMaxSeries) throw FormatError(database.path(), "has too many series");
  }
  return read;
}

Block blockFrom(const SqliteStatement& row, int column, int dataColumn) {
  const auto small = [&](int at) { return std::clamp<std::int64_t>(row.integer(at), 0, 255); };
  const auto data = row.blob(dataColumn);
  return {static_cast<Stream>(small(column)),
          row.integer(column + 1),
          row.integer(column + 2),
          row.integer(column + 3),
          row.integer(column + 4),
          static_cast<BlockCoding>(small(column + 5)),
          {data.begin(), data.end()}};
}

std::string samplesKey(Stream stream) {
  constexpr std::array<const char*, 3> kKeys{"frames", "angle_samples", "temperature_samples"};
  const auto number = static_cast<std::size_t>(stream);
  return number < kKeys.size() ? kKeys[number] : "samples_" + std::to_string(number);
}

std::string MetaRows::operator[](const std::string& key) const {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : found->second;
}

std::optional<std::int64_t> MetaRows::integer(const std::string& key) const {
  return parseInteger((*this)[key]);
}

MetaRows readMeta(SqliteDatabase& database) {
  constexpr std::size_t kMaxRows = 1000;
  MetaRows meta;
  SqliteStatement rows = database.prepare("SELECT key, value, crc32 FROM meta");
  while (rows.next()) {
    std::string key = rows.text(0);
    std::string value = rows.text(1);
    if (rows.integer(2) != static_cast<std::int64_t>(metaCrc(key, value)))
      ++meta.damaged;
    else
      meta.values.insert_or_assign(std::move(key), std::move(value));
    if (meta.damaged + meta.values.size() > kMaxRows)
      throw FormatError(database.path(), "has too many rows of meta data");
  }
  return meta;
}

std::size_t forEachEventRow(SqliteDatabase& database,
                            const std::function<void(std::int64_t, Event&&)>& take) {
  std::size_t damaged = 0;
  SqliteStatement rows =
      database.prepare("SELECT id, t_us, t1_us, kind, matrix, text, json, crc32 FROM event");
  while (rows.next()) {
    Event event{rows.integer(1), rows.integer(2), rows.text(3), {}, rows.text(5), rows.text(6)};
    const std::int64_t matrix = rows.integer(4);
    const bool fits = matrix >= INT32_MIN && matrix <= INT32_MAX;
    if (!rows.isNull(4)) event.matrix = static_cast<int>(fits ? matrix : -1);
    if (fits && rows.integer(7) == static_cast<std::int64_t>(eventCrc(rows.integer(0), event)))
      take(rows.integer(0), std::move(event));
    else
      ++damaged;
  }
  return damaged;
}

EventsReport readEventRows(SqliteDatabase& database) {
  EventsReport report;
  report.damaged = forEachEventRow(
      database, [&](std::int64_t, Event&& event) { report.events.push_back(std::move(event)); });
  // Sorted here: SQLite would sort in memory without a bound.
  std::stable_sort(report.events.begin(), report.events.end(), [](const auto& a, const auto& b) {
    return a.tUs < b.tUs;
  });
  return report;
}

std::vector<SecondSummary> readSecondRows(SqliteDatabase& database, std::size_t& damaged) {
  std::vector<SecondSummary> seconds;
  SqliteStatement rows =
      database.prepare("SELECT t_s, matrix, frames, min, max, sum, active_max, crc32 FROM second");
  while (rows.next()) {
    const std::int64_t matrix = rows.integer(1);
    const std::int64_t activeMax = rows.integer(6);
    SecondSummary row{rows.integer(0),
                      static_cast<int>(std::clamp<std::int64_t>(matrix, -1, kMaxMatrices)),
                      rows.integer(2),
                      rows.real(3),
                      rows.real(4),
                      rows.real(5),
                      static_cast<int>(std::clamp<std::int64_t>(activeMax, -1, kMaxPlaces + 1))};
    if (rows.integer(7) == static_cast<std::int64_t>(secondCrc(row)))
      seconds.push_back(row);
    else
      ++damaged;
  }
  std::stable_sort(
      seconds.begin(), seconds.end(), [](const SecondSummary& a, const SecondSummary& b) {
        return std::pair(a.tS, a.matrix) < std::pair(b.tS, b.matrix);
      });
  return seconds;
}

// Every row has its number, and writing it twice is harmless: a commit that reports a failure may
// have reached the disk all the same, and is tried again.
RowWriter::RowWriter(SqliteDatabase& database)
    : block_(database.prepare("INSERT OR REPLACE INTO block VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)")),
      second_(database.prepare(
          "INSERT OR REPLACE INTO second(rowid, t_s, matrix, frames, min, max, sum, active_max,"
          " crc32) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)")),
      event_(database.prepare("INSERT OR REPLACE INTO event VALUES(?, ?, ?, ?, ?, ?, ?, ?)")),
      counter_(database.prepare("INSERT OR REPLACE INTO counter VALUES(?, ?)")) {}

void RowWriter::block(std::int64_t id, const Block& block) {
  block_.bind(1, id)
      .bind(2, static_cast<std::int64_t>(block.stream))
      .bind(3, block.first)
      .bind(4, block.n)
      .bind(5, block.t0Us)
      .bind(6, block.t1Us)
      .bind(7, static_cast<std::int64_t>(block.coding))
      .bind(8, static_cast<std::int64_t>(blockCrc(block)))
      .bind(9, std::span<const std::byte>(block.data))
      .run();
}

void RowWriter::second(std::int64_t id, const SecondSummary& row) {
  second_.bind(1, id)
      .bind(2, row.tS)
      .bind(3, static_cast<std::int64_t>(row.matrix))
      .bind(4, row.frames)
      .bind(5, row.minimum)
      .bind(6, row.maximum)
      .bind(7, row.sum)
      .bind(8, static_cast<std::int64_t>(row.activeMax))
      .bind(9, static_cast<std::int64_t>(secondCrc(row)))
      .run();
}

void RowWriter::event(std::int64_t id, const Event& event) {
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

std::int64_t writeOverview(SqliteDatabase& database, std::size_t numMatrices) {
  createOverview(database);
  SqliteStatement insert = database.prepare("INSERT INTO overview VALUES(?, ?, ?, ?)");
  std::vector<std::byte> data;
  std::int64_t id = 0;
  std::int64_t inRow = 0;
  std::int64_t seconds = 0;
  const auto flush = [&] {
    if (inRow == 0) return;
    ++id;
    insert.bind(1, id)
        .bind(2, inRow)
        .bind(3, static_cast<std::int64_t>(overviewCrc(id, inRow, data)))
        .bind(4, std::span<const std::byte>(data))
        .run();
    data.clear();
    inRow = 0;
  };
  SqliteStatement rows = database.prepare(
      "SELECT t_s, matrix, frames, min, max, sum, active_max FROM second ORDER BY rowid");
  while (rows.next()) {
    if (rows.integer(1) == 0) {
      if (data.size() + 8 + numMatrices * kMatrixBytes > kMaxBlockBytes) flush();
      appendLittleEndian(data, static_cast<std::uint64_t>(rows.integer(0)), 8);
      ++inRow;
      ++seconds;
    }
    appendLittleEndian(data, static_cast<std::uint64_t>(rows.integer(2)), 4);
    appendLittleEndian(data, std::bit_cast<std::uint32_t>(static_cast<float>(rows.real(3))), 4);
    appendLittleEndian(data, std::bit_cast<std::uint32_t>(static_cast<float>(rows.real(4))), 4);
    appendLittleEndian(data, std::bit_cast<std::uint64_t>(rows.real(5)), 8);
    appendLittleEndian(data, static_cast<std::uint64_t>(rows.integer(6)), 4);
  }
  flush();
  return seconds;
}

std::optional<std::vector<SecondSummary>> readOverview(SqliteDatabase& database,
                                                       std::size_t numMatrices,
                                                       std::int64_t numSeconds) {
  constexpr std::int64_t kMaxSeconds = 100'000'000;  // three years
  if (numSeconds < 1 || numSeconds > kMaxSeconds ||
      database.integerOf("SELECT count(*) FROM sqlite_schema WHERE name='overview'") != 1)
    return std::nullopt;
  std::vector<SecondSummary> seconds;
  // A false number of seconds must not cost memory.
  constexpr std::int64_t kMaxReserved = 200'000;
  seconds.reserve(static_cast<std::size_t>(std::min(numSeconds, kMaxReserved)) * numMatrices);
  std::int64_t read = 0;
  std::int64_t lastId = 0;
  SqliteStatement rows = database.prepare("SELECT id, n, crc32, data FROM overview ORDER BY id");
  while (rows.next()) {
    const std::int64_t n = rows.integer(1);
    const auto data = rows.blob(3);
    if (rows.integer(0) != ++lastId ||
        rows.integer(2) != static_cast<std::int64_t>(overviewCrc(lastId, n, data)) || n < 1 ||
        n > numSeconds - read ||
        static_cast<std::size_t>(n) * (8 + numMatrices * kMatrixBytes) != data.size())
      return std::nullopt;
    read += n;
    ByteReader in(data);
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t tS = in.i64();
      for (std::size_t m = 0; m < numMatrices; ++m) {
        SecondSummary& row = seconds.emplace_back();
        row.tS = tS;
        row.matrix = static_cast<int>(m);
        row.frames = in.u32();
        row.minimum = static_cast<double>(in.f32());
        row.maximum = static_cast<double>(in.f32());
        row.sum = in.f64();
        row.activeMax = static_cast<int>(in.u32() & 0x7FFFFFFF);
      }
    }
  }
  if (read != numSeconds) return std::nullopt;
  return seconds;
}

}  // namespace palpate
