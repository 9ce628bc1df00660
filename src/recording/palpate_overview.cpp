#include "recording/palpate_overview.h"

#include <algorithm>
#include <bit>

#include "palpate/core/byte_reader.h"
#include "palpate/core/byte_writer.h"
#include "palpate/core/error.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"
#include "recording/recording_format.h"

namespace palpate {
namespace {

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
  constexpr std::int64_t kMostSeconds = 100'000'000;  // three years
  if (numSeconds < 1 || numSeconds > kMostSeconds ||
      database.integerOf("SELECT count(*) FROM sqlite_schema WHERE name='overview'") != 1)
    return std::nullopt;
  std::vector<SecondSummary> seconds;
  // A false number of seconds must not cost memory.
  constexpr std::int64_t kMostReserved = 200'000;
  seconds.reserve(static_cast<std::size_t>(std::min(numSeconds, kMostReserved)) * numMatrices);
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

std::vector<SecondSummary> readSeconds(const std::filesystem::path& path) {
  if (!isNativeRecording(path)) return secondsOf(readDsa(path));
  PalpateConnection access(path);
  const std::size_t numMatrices = readLayout(access.database()).numMatrices();
  auto seconds =
      readOverview(access.database(), numMatrices, access.meta().integer("seconds").value_or(0));
  if (seconds) return std::move(*seconds);
  std::size_t damaged = 0;
  return readSecondRows(access.database(), damaged);
}

}  // namespace palpate
