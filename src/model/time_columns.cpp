#include "palpate/model/time_columns.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/time.h"

namespace palpate {
namespace {

struct TimePlace {
  std::size_t behind;   // the column of milliseconds
  std::size_t ofFrame;  // the column with the number of the frame
};

std::vector<TimePlace> timePlacesOf(const ResultTable& table) {
  constexpr std::array<std::pair<const char*, const char*>, 3> kTimes = {
      {{"time_ms", "frame"}, {"begin_ms", "begin"}, {"end_ms", "end"}}};
  const auto placeOf = [&](const char* name) -> std::optional<std::size_t> {
    const auto& columns = table.columns();
    const auto at = std::ranges::find(columns, name, &ResultColumn::name);
    if (at == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(at - columns.begin());
  };
  std::vector<TimePlace> places;
  for (const auto& [time, frame] : kTimes)
    if (const auto behind = placeOf(time), ofFrame = placeOf(frame); behind && ofFrame)
      places.push_back({*behind, *ofFrame});
  if (places.empty())
    throw std::invalid_argument("the table '" + table.name() + "' has no time_ms");
  return places;
}

ResultColumn timeColumnBehind(const ResultColumn& column, TimeColumn which) {
  const std::string stem = column.name.substr(0, column.name.size() - 2);  // without "ms"
  if (which == TimeColumn::kUtc)
    return {stem + "utc", CellKind::kText, "", column.name + " as date and time of day in UTC"};
  return {stem + "s", CellKind::kNumber, "s", column.name + " from the first frame", 6};
}

std::vector<ResultColumn> columnsWithTimes(const ResultTable& table, TimeColumn which) {
  std::vector<ResultColumn> columns = table.columns();
  const std::vector<TimePlace> places = timePlacesOf(table);
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(place->behind) + 1,
                   timeColumnBehind(table.columns()[place->behind], which));
  return columns;
}

std::string utcOf(std::int64_t us) {
  std::string text = utcText(us);  // "2014-11-27 10:31:05.123"
  text[text.find(' ')] = 'T';
  const std::string micros = std::to_string(1000 + us - floorMs(us) * kUsPerMs);
  return text + micros.substr(1) + "Z";
}

class TimedTable final : public ResultTable {
 public:
  TimedTable(std::unique_ptr<ResultTable> table, const Profile& profile, TimeColumn which)
      : ResultTable(table->name(), columnsWithTimes(*table, which)),
        table_(std::move(table)),
        places_(timePlacesOf(*table_)),
        profile_(profile),
        which_(which) {}

  bool next(std::vector<Cell>& cells) override {
    if (!table_->next(cells)) return false;
    for (auto place = places_.rbegin(); place != places_.rend(); ++place)
      cells.insert(cells.begin() + static_cast<std::ptrdiff_t>(place->behind) + 1,
                   timeOf(std::get<std::int64_t>(cells[place->ofFrame])));
    return true;
  }
  std::vector<std::string> notes() const override { return table_->notes(); }
  std::vector<std::string> problems() const override { return table_->problems(); }

 private:
  Cell timeOf(std::int64_t frame) const {
    const std::int64_t us = profile_.frameTimeUs(static_cast<std::size_t>(frame));
    if (which_ == TimeColumn::kUtc) return utcOf(us);
    return static_cast<double>(us - profile_.frameTimeUs(0)) / kUsPerS;
  }

  const std::unique_ptr<ResultTable> table_;
  const std::vector<TimePlace> places_;
  const Profile profile_;
  const TimeColumn which_;
};

}  // namespace

std::unique_ptr<ResultTable> withTimeColumns(std::unique_ptr<ResultTable> table,
                                             const Profile& profile,
                                             TimeColumn which) {
  return std::make_unique<TimedTable>(std::move(table), profile, which);
}

}  // namespace palpate
