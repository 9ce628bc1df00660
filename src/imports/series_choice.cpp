// The columns of a table that become further series: which of them belong together, and their
// names; and the series of other files.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/cell_text.h"
#include "imports/column_unit.h"
#include "imports/column_words.h"
#include "imports/planning.h"

namespace palpate {
namespace {

constexpr const char* kOtherColumns = "table";

// One number of a row: which it is, and what the series calls it.
struct SeriesNumber {
  std::size_t column = 0;
  std::size_t within = 0;
  Column called = {};
};

// A column without its unit: "fz_N" and "fz [N]" are fz in N. At the end of a name only capitals
// are units, as single letters otherwise are parts of it.
Column calledOf(const TableColumn& column) {
  static const std::set<std::string_view> kEndings = {
      "N", "kN", "mN", "Nm", "mNm", "Ncm", "V", "A", "mA", "W", "K", "Pa", "kPa", "Hz", "dps"};
  Column called{std::string(nameWithoutUnit(column.name)),
                column.unit.empty() ? unitInName(column.name) : column.unit};
  const auto underscore = called.name.rfind('_');
  if (underscore != std::string::npos && underscore > 0 && called.name == column.name &&
      kEndings.contains(std::string_view(called.name).substr(underscore + 1))) {
    if (called.unit.empty()) called.unit = called.name.substr(underscore + 1);
    called.name.resize(underscore);
  }
  return called;
}

// What a name says of the series: "wrist_fz" is fz of wrist, "/imu/acc/x" acc_x of imu. The group
// is empty where the name is one word that says nothing.
struct SplitColumn {
  std::string group, rest;
};
SplitColumn splitColumn(std::string_view name) {
  static const std::set<std::string> kQuantities = {"acc",
                                                    "accel",
                                                    "acceleration",
                                                    "linear_acceleration",
                                                    "gyro",
                                                    "angular_velocity",
                                                    "mag",
                                                    "force",
                                                    "torque",
                                                    "position",
                                                    "orientation",
                                                    "velocity",
                                                    "linear",
                                                    "angular"};
  static const std::map<std::string, std::string> kFamilies = [] {
    std::map<std::string, std::string> families;
    for (const char axis : {'x', 'y', 'z'}) {
      for (const char quantity : {'f', 't', 'm'}) families[{quantity, axis}] = "wrench";
      for (const char quantity : {'a', 'g', 'w'}) families[{quantity, axis}] = "imu";
    }
    return families;
  }();
  constexpr std::string_view kBetween = " _-.[](){}/";
  name = trimmed(name, kBetween);
  const auto end = name.find_last_of("/.");
  if (end != std::string_view::npos && end + 1 < name.size()) {
    std::string_view group = trimmed(name.substr(0, end), kBetween);
    std::string rest(name.substr(end + 1));
    const auto before = group.find_last_of("/.");
    if (before != std::string_view::npos &&
        kQuantities.contains(smallLetters(group.substr(before + 1)))) {
      rest = std::string(group.substr(before + 1)) + "_" + rest;
      group = trimmed(group.substr(0, before), kBetween);
    }
    if (!group.empty()) return {std::string(group), rest};
  }
  const auto parts = nameParts(name);
  if (parts.empty()) return {};
  if (parts.size() == 1) {
    const auto family = kFamilies.find(parts[0]);
    return {family == kFamilies.end() ? "" : family->second, std::string(name)};
  }
  return {parts[0], std::string(trimmed(name.substr(parts[0].size()), kBetween))};
}

// A series of numbers whose names are made different ones.
PlannedSeries seriesOf(Planning& p, const std::string& name, std::vector<SeriesNumber> numbers) {
  PlannedSeries series;
  series.kind = PlannedSeries::Kind::kFurther;
  series.file = p.source.path();
  series.further = {name, {}, {}, "import " + shortened(p.source.path().filename().string())};
  std::set<std::string> taken;
  for (SeriesNumber& number : numbers) {
    std::string base = shortened(number.called.name);
    if (base.empty()) base = "column " + std::to_string(number.column + 1);
    number.called.name = base;
    for (int i = 2; !taken.insert(number.called.name).second; ++i)
      number.called.name = base + "_" + std::to_string(i);
    if (!number.called.unit.empty()) number.called.unit = shortened(number.called.unit);
  }
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const TableColumn& column = p.columns[numbers[n].column];
    if (series.columns.empty() || series.columns.back() != numbers[n].column) {
      series.columns.push_back(numbers[n].column);
      series.values.resize(series.values.size() + column.width());
    }
    PlannedValue& value = series.values[series.values.size() - column.width() + numbers[n].within];
    value = {n, column.scale, column.offset};
    if (column.scale != 1.0 || column.offset != 0.0)
      p.note(reason::kScaledByFile, {"series " + name, column.name});
    series.further.columns.push_back(std::move(numbers[n].called));
  }
  std::vector<TableColumn> used;
  for (const std::size_t c : series.columns) used.push_back(p.columns[c]);
  series.description = {namesText(used) + (used.size() == 1 ? " becomes" : " become") + " series " +
                        name};
  return series;
}

// The numbers of a column; of an array named with the index of each.
std::vector<SeriesNumber> numbersOf(const TableColumn& column,
                                    std::size_t index,
                                    const std::string& prefix) {
  Column called = calledOf(column);
  if (isScalar(column)) return {{index, 0, std::move(called)}};
  std::vector<SeriesNumber> numbers;
  for (std::size_t i = 0; i < column.width(); ++i)
    numbers.push_back({index, i, {prefix + std::to_string(i), called.unit}});
  return numbers;
}

// Which columns, all of the same number of rows, hold a number in the first rows.
std::set<std::size_t> withNumbers(TableSource& source,
                                  const std::vector<std::size_t>& columns,
                                  std::uint64_t mostRows) {
  std::set<std::size_t> found;
  if (columns.empty()) return found;
  source.start(columns, std::nullopt);
  TableRow row;
  for (std::uint64_t i = 0; i < mostRows && found.size() < columns.size() && source.next(row);
       ++i) {
    if (!row.complete) continue;
    std::size_t at = 0;
    for (const std::size_t c : columns)
      for (std::size_t end = at + source.columns()[c].width(); at < end; ++at)
        if (row.states[at] != CellState::kText && row.states[at] != CellState::kEmpty &&
            std::isfinite(row.values[at]))
          found.insert(c);
  }
  return found;
}

// Whether a column is the time of something, or about the others.
bool isAside(const Planning& p, std::size_t c) {
  const TableColumn& column = p.columns[c];
  return p.times.isPart(c) || p.times.hasSameTimes(c) || hasWord(column, {"active", "mask"}) ||
         timeScore(column, PlannedSeries::Kind::kFrames) > 0 ||
         timeScore(column, PlannedSeries::Kind::kAngles) > 0 ||
         timeScore(column, PlannedSeries::Kind::kTemperatures) > 0;
}

// Whether its name says nothing but that it counts: "frame", "sample_index".
bool isCounterOnly(const TableColumn& column) {
  const auto words = wordsOf(column.name);
  return !words.empty() &&
         std::includes(kCounterWords.begin(), kCounterWords.end(), words.begin(), words.end());
}

// Columns beside the taxels that may be further series.
std::vector<std::size_t> furtherColumns(Planning& p, std::uint64_t mostRows) {
  std::set<std::size_t> used;
  for (const PlannedSeries& series : p.plan.series) {
    used.insert(series.columns.begin(), series.columns.end());
    if (series.time && series.timeFile.empty()) used.insert(*series.time);
  }
  const TableColumn& taxels = p.columns[p.plan.series.front().columns.front()];
  const auto isLeftOut =
      [&](const TableColumn& column, PlannedSeries::Kind kind, const auto& words) {
        return sampleMapping(p, kind).columns == kNoColumns && hasWord(column, words);
      };
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < p.columns.size(); ++c) {
    const TableColumn& column = p.columns[c];
    if (used.contains(c) || !holdsNumbers(column) || !sameRows(column, taxels) ||
        column.width() == 0 || column.width() > kMaxColumns || saysOrigin(column) ||
        isAside(p, c) || p.times.counter() == c ||
        isLeftOut(column, PlannedSeries::Kind::kAngles, kAngleWords) ||
        isLeftOut(column, PlannedSeries::Kind::kTemperatures, kTemperatureWords))
      continue;
    if (isScalar(column) &&
        (isCounterOnly(column) || (hasWord(column, kCounterWords) && p.times.countsFrames(c))))
      continue;
    columns.push_back(c);
  }
  // Many that differ by numbers are taxels of something else.
  std::set<std::size_t> others;
  for (const ColumnGroup& group : groupColumns(p.columns, columns))
    if (group.elements.size() > kMaxColumns)
      others.insert(group.columns.begin(), group.columns.end());
  std::erase_if(columns, [&](std::size_t c) { return others.contains(c); });
  const std::set<std::size_t> numbers = withNumbers(p.source, columns, mostRows);
  std::erase_if(columns, [&](std::size_t c) { return !numbers.contains(c); });
  return columns;
}

}  // namespace

void chooseFurther(Planning& p, std::span<const SeriesFile> files, std::uint64_t mostRows) {
  struct Group {
    std::string name;
    std::vector<SeriesNumber> numbers, whole;  // with the rest of their names, with all of it
  };
  std::vector<Group> groups;
  for (const std::size_t c : furtherColumns(p, mostRows)) {
    const TableColumn& column = p.columns[c];
    if (!isScalar(column)) {
      const std::string name(nameWithoutUnit(column.name));
      groups.push_back({name.substr(name.find_last_of('/') + 1), numbersOf(column, c, ""), {}});
      continue;
    }
    const Column called = calledOf(column);
    const SplitColumn split = splitColumn(called.name);
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& each) {
      return !each.whole.empty() && each.name == split.group;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), Group{split.group, {}, {}});
    group->numbers.push_back({c, 0, {split.rest.empty() ? called.name : split.rest, called.unit}});
    group->whole.push_back({c, 0, called});
  }
  // A prefix of one column says nothing.
  Group others{kOtherColumns, {}, {}};
  const auto isOther = [](const Group& group) {
    return !group.whole.empty() && (group.name.empty() || group.whole.size() == 1);
  };
  for (const Group& group : groups)
    if (isOther(group))
      others.numbers.insert(others.numbers.end(), group.whole.begin(), group.whole.end());
  std::erase_if(groups, isOther);
  std::sort(others.numbers.begin(), others.numbers.end(), [](const auto& a, const auto& b) {
    return a.column < b.column;
  });
  if (!others.numbers.empty()) groups.push_back(std::move(others));

  std::set<std::string> taken;
  for (const SeriesFile& file : files) taken.insert(file.name);
  const PlannedTime time = p.plan.series.front();
  std::size_t numSeries = kHandSeries + files.size();
  for (const Group& group : groups)
    for (std::size_t begin = 0; begin < group.numbers.size() && numSeries < kMaxSeries;
         begin += kMaxColumns, ++numSeries) {
      const std::string base = seriesName(group.name).substr(0, kMaxSeriesName - 3);
      std::string name = base;
      for (int i = 2; isHandSeries(name) || !taken.insert(name).second; ++i)
        name = base + "_" + std::to_string(i);
      const auto first = group.numbers.begin() + static_cast<std::ptrdiff_t>(begin);
      const std::size_t count = std::min(kMaxColumns, group.numbers.size() - begin);
      PlannedSeries series = seriesOf(p, name, {first, first + static_cast<std::ptrdiff_t>(count)});
      static_cast<PlannedTime&>(series) = time;
      p.plan.series.push_back(std::move(series));
    }
}

std::optional<std::size_t> exportedTimeOf(const std::vector<TableColumn>& columns) {
  constexpr std::size_t kFirstValue = 2;
  if (columns.size() < kFirstValue + 2 || columns[0].name != "sample" ||
      columns[1].name != "time_ms")
    return std::nullopt;
  const std::size_t last =
      columns.size() - (columns.back().name == "device_time_us" ? std::size_t{2} : std::size_t{1});
  return last > kFirstValue && columns[last].name == "time_us" ? std::optional(last) : std::nullopt;
}

PlannedSeries planSeriesFile(const SeriesFile& wanted,
                             const HandDescription& hand,
                             const ImportMapping& mapping,
                             std::uint64_t mostRows,
                             ImportPlan& plan) {
  ImportMapping own;
  own.text.decimal = mapping.text.decimal;
  own.time.unit = mapping.time.unit;
  own.time.rateHz = wanted.rateHz;
  std::shared_ptr<TableSource> table = openTable(wanted.file, own.text);
  Planning p{*table, hand, own};
  p.times.setRateOption("--series-rate " + wanted.name + "=HZ");
  // A vector of MATLAB is an array of one row or one column.
  for (std::size_t c = 0; c < p.columns.size(); ++c)
    if (p.columns[c].isNumeric && p.columns[c].numRows == 1 && p.columns[c].shape.size() == 1)
      p.source.reverseAxes(c);
  const auto exported = wanted.rateHz ? std::nullopt : exportedTimeOf(p.columns);
  if (!exported) p.times.prepare();
  // Its matrices may have the rows last.
  const auto time = std::find_if(p.columns.begin(), p.columns.end(), [](const auto& column) {
    return column.numRows && timeScore(column, PlannedSeries::Kind::kFurther) > 0;
  });
  const std::size_t numRows =
      time == p.columns.end() ? 0 : static_cast<std::size_t>(*time->numRows);
  for (std::size_t c = 0; c < p.columns.size(); ++c)
    if (numRows > 0 && p.columns[c].isNumeric && p.columns[c].numRows != numRows &&
        p.columns[c].shape == std::vector<std::size_t>{numRows})
      p.source.reverseAxes(c);

  PlannedSeries times;
  times.kind = PlannedSeries::Kind::kFurther;
  std::vector<std::size_t> numbers;
  for (std::size_t c = 2; exported && c < *exported; ++c) numbers.push_back(c);
  for (std::size_t c = 0; !exported && c < p.columns.size(); ++c)
    if (holdsNumbers(p.columns[c]) && p.columns[c].width() > 0 && !isAside(p, c) &&
        !saysOrigin(p.columns[c]) && !(isScalar(p.columns[c]) && isCounterOnly(p.columns[c])))
      numbers.push_back(c);
  if (numbers.empty()) p.refuse(reason::kSeriesNoNumbers, {wanted.name, namesText(p.columns)});
  times.columns = {numbers.front()};
  const TableColumn& first = p.columns[numbers.front()];
  bool isFirstLeftOut = false;
  const bool isNamed = std::any_of(p.columns.begin(), p.columns.end(), [](const auto& column) {
    return timeScore(column, PlannedSeries::Kind::kFurther) > 0;
  });
  // Where nothing is called a time, a first number that ascends is.
  if (!wanted.rateHz && !isNamed && (isScalar(first) || numbers.size() == 1))
    isFirstLeftOut = p.times.leaveOutFirst(times, numbers.front(), !isScalar(first));
  if (exported) {
    times.time = exported;
    times.timeUnit = TimeUnit::kMicroseconds;
  } else {
    p.times.find(times, "");
  }
  if (!times.time && !wanted.rateHz) p.refuse(reason::kSeriesNoTimes, {wanted.name});
  const TableColumn& rows = p.columns[times.time.value_or(numbers.front())];
  std::erase_if(numbers, [&](std::size_t c) {
    return (times.time == c && !times.timeWithin) || !sameRows(p.columns[c], rows) ||
           (isFirstLeftOut && isScalar(first) && c == numbers.front());
  });
  std::size_t width = 0;
  for (const std::size_t c : numbers) width += p.columns[c].width();
  if (width > kMaxColumns)
    p.refuse(reason::kSeriesTooWide,
             {wanted.name, std::to_string(width), std::to_string(kMaxColumns)});
  const std::set<std::size_t> filled = exported
                                           ? std::set<std::size_t>(numbers.begin(), numbers.end())
                                           : withNumbers(p.source, numbers, mostRows);
  std::vector<SeriesNumber> chosen;
  for (const std::size_t c : numbers) {
    if (!filled.contains(c)) continue;
    const std::string prefix =
        numbers.size() == 1 ? "" : std::string(nameWithoutUnit(p.columns[c].name)) + "_";
    for (SeriesNumber& number : numbersOf(p.columns[c], c, prefix))
      if (number.within != times.timeWithin || isScalar(p.columns[c]))
        chosen.push_back(std::move(number));
  }
  if (chosen.empty()) p.refuse(reason::kSeriesNoNumbers, {wanted.name, namesText(p.columns)});

  PlannedSeries series = seriesOf(p, wanted.name, std::move(chosen));
  static_cast<PlannedTime&>(series) = times;
  series.table = table;
  series.rateHz = wanted.rateHz;
  const std::string file = shortened(wanted.file.filename().string());
  const std::string when =
      times.time
          ? "time: " + shortened(p.columns[*times.time].name) + (times.timeWithin ? "[0]" : "") +
                " [" + std::string(nameOf(times.timeUnit)) + "]"
          : "rows at equal intervals, " + numberText(wanted.rateHz.value_or(0.0)) + " Hz";
  series.description = {file + ": " + series.description.front() + "; " + when};
  std::vector<TableColumn> unused;
  for (std::size_t c = exported.value_or(0); c < p.columns.size(); ++c)
    if (std::find(series.columns.begin(), series.columns.end(), c) == series.columns.end() &&
        times.time != c && !p.times.isPart(c) && !p.times.hasSameTimes(c) &&
        !saysOrigin(p.columns[c]))
      unused.push_back(p.columns[c]);
  if (!unused.empty()) p.note(reason::kNotUsed, {namesText(unused)});
  for (const std::string& note : p.plan.notes)
    plan.notes.push_back("series " + wanted.name + ": " + note);
  for (const std::string& doubt : table->doubts(std::numeric_limits<double>::infinity()))
    plan.doubts.push_back("series " + wanted.name + ": " + doubt);
  return series;
}

}  // namespace palpate
