// Fuzzes the lines of a series: before a zero byte the columns as --series-columns has them, behind
// it what a sender sends. Beyond not crashing: splitting makes no difference, memory is bounded,
// every row has one value per column, none of them infinite, and the columns stay.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "palpate/device/series_source.h"
#include "palpate/model/series.h"

#include "device/series_lines.h"

namespace {

using namespace palpate;

constexpr std::size_t kMaxPending = 16'384;  // bytes of a line

void require(bool condition) {
  if (!condition) std::abort();
}

void requirePrintable(std::string_view text) {
  require(std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  }));
}

struct Read {
  std::vector<double> numbers;
  std::vector<Column> columns;
  std::uint64_t refused = 0;
  bool operator==(const Read&) const = default;
};

Read readSeries(std::span<const std::byte> bytes,
                std::size_t chunk,
                const std::vector<Column>& given,
                bool startsInside) {
  SeriesLines lines(given);
  lines.beginConnection(startsInside);
  Read read;
  const auto sink = [&](const SeriesRow& row) {
    if (read.columns.empty()) {
      read.columns = lines.columns();
      validate(SeriesDescription{"series", "", read.columns, ""});
    }
    require(lines.columns() == read.columns && row.values.size() == read.columns.size());
    for (const double value : row.values) {
      require(!std::isinf(value));
      read.numbers.push_back(std::isnan(value) ? std::numeric_limits<double>::max() : value);
    }
    read.numbers.push_back(row.deviceUs ? static_cast<double>(*row.deviceUs) : -0.5);
  };
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    lines.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), sink);
    require(lines.pendingBytes() <= kMaxPending);
  }
  lines.cutOff(sink);
  require(lines.pendingBytes() == 0 && lines.skippedBytes() <= bytes.size());
  read.refused = lines.refused();
  require((read.refused == 0) == lines.lastFault().empty());
  requirePrintable(lines.lastFault());
  return read;
}

std::vector<Column> givenColumns(std::string_view text) {
  if (text.empty()) return {};
  try {
    return columnsOf(text);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = all.find('\0');
  const auto given = givenColumns(end == std::string_view::npos ? "" : all.substr(0, end));
  const auto bytes =
      std::as_bytes(std::span(data, size)).subspan(end == std::string_view::npos ? 0 : end + 1);
  for (const bool startsInside : {false, true})
    require(readSeries(bytes, 4096, given, startsInside) ==
            readSeries(bytes, 1, given, startsInside));
  require(!seriesName(all).empty());
  validate(SeriesDescription{seriesName(all), "", {{"1", ""}}, ""});
  return 0;
}
