#include "palpate/imports/import_plan.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/column_words.h"
#include "imports/matrix_reading.h"
#include "imports/planning.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using Kind = PlannedSeries::Kind;

// "thumb=COLUMNS" of a mapping is of the matrix of that name.
void nameMatrices(Planning& p) {
  const NameKeys keys = matrixKeys(p.hand);
  for (MatrixMapping& wanted : p.mapping.matrices) {
    const auto equals = wanted.columns.find('=');
    if (wanted.matrix || equals == std::string::npos || numberNamed(p.columns, wanted.columns))
      continue;
    const auto named = keys.find(nameKey(wanted.columns.substr(0, equals)));
    if (named == keys.end()) continue;
    wanted.matrix = named->second;
    wanted.columns.erase(0, equals + 1);
  }
}

// A column that numbers the frames tells which ones are missing.
void findCounter(Planning& p, PlannedSeries& series) {
  std::optional<std::size_t> counter = p.times.counter();
  const TableColumn& values = p.columns[series.columns.front()];
  for (std::size_t c = 0; c < p.columns.size() && !counter; ++c) {
    const TableColumn& column = p.columns[c];
    if (holdsNumbers(column) && isScalar(column) && sameRows(column, values) && c != series.time &&
        !p.times.isPart(c) && !p.sampleColumns.contains(c) && hasWord(column, kCounterWords) &&
        column.name.find_first_of("0123456789") == std::string::npos &&
        std::find(series.columns.begin(), series.columns.end(), c) == series.columns.end() &&
        p.times.countsFrames(c))
      counter = c;
  }
  if (!counter) return;
  const bool isWithin = *counter == series.columns.front();  // the first number of the array
  series.number = isWithin ? 0 : series.values.size();
  if (isWithin) return;
  series.columns.push_back(*counter);
  series.values.emplace_back();
}

// Names the columns that nothing is made of, but for those about the others ("m0_active", "meta").
void noteUnused(Planning& p) {
  std::set<std::size_t> used;
  std::set<Kind> planned;
  for (const PlannedSeries& series : p.plan.series) {
    planned.insert(series.kind);
    used.insert(series.columns.begin(), series.columns.end());
    if (series.time && series.timeFile.empty()) used.insert(*series.time);
  }
  std::vector<TableColumn> unused;
  std::size_t numNumbers = 0;
  for (const PlannedSeries& series : p.plan.series)
    for (const std::size_t c : series.columns)
      numNumbers += series.kind == Kind::kFurther && isScalar(p.columns[c]) ? 1 : 0;
  for (std::size_t c = 0; c < p.columns.size(); ++c) {
    const TableColumn& column = p.columns[c];
    if (used.contains(c) || p.times.isPart(c) || p.times.hasSameTimes(c) ||
        hasWord(column, {"active", "mask", "meta"}))
      continue;
    unused.push_back(column);
    numNumbers += column.isNumeric && isScalar(column) ? 1 : 0;
  }
  std::string hint;
  for (const Kind kind : {Kind::kAngles, Kind::kTemperatures}) {
    const std::size_t count = namesOf(p.hand, kind).size();
    if (count > 0 && !planned.contains(kind) && sampleMapping(p, kind).columns.empty() &&
        numNumbers >= count)
      hint += (hint.empty() ? "" : "; ") +
              (kind == Kind::kAngles ? "--angles chooses joint angles"
                                     : std::string("--temperatures chooses temperatures"));
  }
  const bool isFurther = planned.contains(Kind::kFurther);
  if (!hint.empty() && isFurther) p.note(reason::kChoosesInstead, {hint});
  if (!unused.empty())
    p.note(reason::kNotUsed, {namesText(unused) + (hint.empty() || isFurther ? "" : "; " + hint)});
}

// The name that a column of a group has with another number in the place of the index `position`.
std::string numberedName(const ColumnGroup& group, std::size_t position, std::int64_t number) {
  std::string name;
  std::size_t index = 0;
  for (const char letter : group.stem) {
    if (letter != '#')
      name += letter;
    else
      name += std::to_string(index == position ? number : group.elements.front().indices.at(index)),
          ++index;
  }
  return name;
}

// Whether numbers from 0 or from 1 are those of the places with a taxel, of all matrices or of one.
bool arePlacesOfTaxels(const std::set<std::int64_t>& numbers, const SensorLayout& layout) {
  const auto fit = [&](std::size_t numTaxels, std::optional<std::size_t> matrix) {
    const auto places = placesInOrder(numTaxels, layout, matrix, false);
    const auto first = static_cast<std::int64_t>(matrix ? layout.offset(*matrix) : 0);
    for (const std::int64_t base : {0, 1})
      if (std::equal(places->begin(),
                     places->end(),
                     numbers.begin(),
                     numbers.end(),
                     [&](std::size_t place, std::int64_t number) {
                       return static_cast<std::int64_t>(place) - first + base == number;
                     }))
        return true;
    return false;
  };
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    if (fit(layout.matrix(m).numTaxels(), m)) return true;
  return fit(layout.numTaxels(), std::nullopt);
}

const std::set<std::string> kOriginWords = {
    "sensor", "topic", "source", "device", "publisher", "hand", "pad", "matrix", "node"};

// What the numbers in the names of the taxels' columns leave open: one is left out, or they begin
// late. Nothing where they are those of the places that have a taxel.
std::vector<std::string> numberingDoubts(const Planning& p) {
  const std::vector<TableColumn>& columns = p.columns;
  const PlannedSeries& frames = p.plan.series.front();
  constexpr std::size_t kMaxMissing = 8;
  std::vector<std::size_t> used;
  std::size_t value = 0;
  for (const std::size_t c : frames.columns) {
    if (isScalar(columns[c]) && frames.values[value].target) used.push_back(c);
    value += columns[c].width();
  }
  const std::vector<ColumnGroup> groups = groupColumns(columns, used);
  std::vector<std::string> doubts;
  for (const ColumnGroup& group : groups) {
    if (group.elements.size() < 2 || numVaryingIndices(group) != 1) continue;
    std::size_t position = 0;
    while (group.elements[0].indices[position] == group.elements[1].indices[position]) ++position;
    std::set<std::int64_t> numbers;
    for (const TableElement& each : group.elements) numbers.insert(each.indices[position]);
    if (numbers.size() != group.elements.size() || arePlacesOfTaxels(numbers, p.layout) ||
        arePlacesOfTaxels(numbers, *p.hand.layout))
      continue;
    std::string missing;
    std::size_t count = 0;
    for (std::int64_t last = *numbers.begin(); const std::int64_t number : numbers) {
      for (std::int64_t i = last + 1; i < number && count <= kMaxMissing; ++i)
        if (count++ < kMaxMissing)
          missing += (missing.empty() ? "" : ", ") + shortened(numberedName(group, position, i));
      last = number;
    }
    if (count > kMaxMissing) missing += ", ..";
    const std::string first = shortened(numberedName(group, position, *numbers.begin()));
    const std::string last = shortened(numberedName(group, position, *numbers.rbegin()));
    if (count > 0) {
      doubts.push_back("of " + first + " to " + last + " the file has no " + missing +
                       ": the others are taken in their order, and may belong to other taxels "
                       "(--matrix chooses columns)");
      continue;
    }
    // Lower numbers may be those of the time.
    bool isWhole = true;
    for (std::int64_t i = 1; i < *numbers.begin() && isWhole; ++i)
      isWhole = std::any_of(columns.begin(), columns.end(), [&](const TableColumn& column) {
        return isScalar(column) && column.name == numberedName(group, position, i);
      });
    if (groups.size() == 1 && *numbers.begin() > 1 && !isWhole)
      doubts.push_back("the numbers of the taxels begin at " + first +
                       ", which is taken for the first one: those before it may be missing "
                       "(--matrix chooses columns)");
  }
  return doubts;
}

// Adds the columns of a text that say what a row is from (sensor, topic, device_id) to a series.
void addOrigins(const std::vector<TableColumn>& columns, PlannedSeries& series) {
  // A text beside arrays is of the file, not of a row.
  if (std::any_of(columns.begin(), columns.end(), [](const TableColumn& column) {
        return column.numRows.has_value();
      }))
    return;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!saysOrigin(columns[c]) ||
        std::find(series.columns.begin(), series.columns.end(), c) != series.columns.end())
      continue;
    series.origins.push_back(series.values.size());
    series.columns.push_back(c);
    series.values.emplace_back();
  }
}

ImportPlan planTable(TableSource& source,
                     const HandDescription& hand,
                     const ImportMapping& mapping,
                     std::span<const SeriesFile> files,
                     std::uint64_t mostRows) {
  Planning p{source, hand, mapping};
  ImportPlan& plan = p.plan;
  std::optional<double>& rateHz = p.mapping.time.rateHz;
  nameMatrices(p);
  const bool hasTimes = std::any_of(p.columns.begin(), p.columns.end(), [](TableColumn column) {
    column.shape.clear();  // a vector of MATLAB has two axes
    return timeScore(column, Kind::kFrames) > 0;
  });
  const bool isAsked = !hasTimes && p.mapping.time == TimeMapping{};
  if (const auto rate = isAsked ? p.source.rateHz() : std::nullopt) {
    rateHz = rate;
    p.note(reason::kRateOfFile, {numberText(*rate)});
  }
  plan.rateHz = rateHz;
  if (const std::string note = p.source.rowNote(); !note.empty()) p.note(note);
  if (!p.source.hasNamedParts()) findFrameAxis(p);
  p.times.prepare();
  // First the columns of the samples are told apart, which have words for it.
  std::vector<PlannedSeries> others;
  for (const Kind kind : {Kind::kAngles, Kind::kTemperatures})
    if (auto series = chooseSamples(p, kind)) others.push_back(std::move(*series));
  plan.series.reserve(1 + others.size());
  PlannedSeries& taxels = plan.series.emplace_back(chooseFrames(p));
  p.times.find(taxels, p.mapping.time.column);
  findCounter(p, taxels);
  const TableColumn& taxelColumn = p.columns[taxels.columns.front()];
  for (PlannedSeries& series : others) {
    const std::string& own = sampleMapping(p, series.kind).time;
    if (!p.columns[series.columns.front()].numRows && own.empty())
      static_cast<PlannedTime&>(series) = taxels;  // the rows of a text have one time
    else
      p.times.find(series, own);
  }
  for (PlannedSeries& series : others)
    if (series.time || (rateHz && sameRows(p.columns[series.columns.front()], taxelColumn)))
      plan.series.push_back(std::move(series));
    else
      p.note(reason::kNoTimes, {samplesText(series.kind)});
  if (rateHz) plan.timeDescription = "rows at equal intervals, " + numberText(*rateHz) + " Hz";
  if (p.mapping.matrices.empty()) plan.doubts = numberingDoubts(p);
  const bool hasOwnTimes = taxels.time && taxels.timeFile.empty();
  for (std::string& doubt : p.source.doubts(hasOwnTimes ? std::numeric_limits<double>::infinity()
                                            : taxels.number ? kMaxMissingFrames
                                                            : 0.0))
    plan.doubts.push_back(std::move(doubt));
  chooseFurther(p, files, mostRows);
  for (PlannedSeries& series : plan.series) addOrigins(p.columns, series);
  noteUnused(p);
  return std::move(plan);
}

constexpr std::string_view kTaxelListColumns[] = {
    "frame", "time_ms", "matrix", "y", "x", "value", "time_us", "dx", "dy", "dz"};
constexpr std::size_t kOldListColumns = 6;  // without time_us
constexpr std::size_t kListColumns = 7;     // without readings

bool isTaxelList(const std::vector<TableColumn>& columns) {
  return (columns.size() == kOldListColumns || columns.size() == kListColumns ||
          columns.size() == std::size(kTaxelListColumns)) &&
         std::equal(
             columns.begin(),
             columns.end(),
             std::begin(kTaxelListColumns),
             [](const TableColumn& column, std::string_view name) { return column.name == name; });
}

// The plan of what `palpate convert` writes to .csv.
ImportPlan planTaxelList(TableSource& source,
                         const HandDescription& hand,
                         const ImportMapping& mapping,
                         const TableOptions& options) {
  if (!mapping.matrices.empty() || mapping.time.rateHz || !mapping.time.column.empty())
    throw FormatError(source.path(), sentenceOf(reason::kTaxelList, {}));
  if (hand.layout->numReadings() != hand.layout->numCells())
    throw FormatError(source.path(), sentenceOf(reason::kTaxelListOfComponents, {}));
  ImportPlan plan;
  plan.isTaxelList = true;
  PlannedSeries frames;
  frames.file = source.path();
  const std::size_t numColumns = source.columns().size();
  // dz has the sign.
  frames.columns = {0, 2, 3, 4, numColumns > kListColumns ? numColumns - 1 : 5};
  frames.values.resize(frames.columns.size());
  const bool hasUs = numColumns >= kListColumns;
  frames.time = hasUs ? 6 : 1;
  frames.timeUnit = hasUs ? TimeUnit::kMicroseconds : TimeUnit::kMilliseconds;
  plan.timeDescription = hasUs ? "time_us [us, by the file]" : "time_ms [ms, by the file]";
  frames.description = {"matrices: active taxels, one in each line"};
  plan.series.push_back(std::move(frames));
  for (const auto& [kind, ending] : {std::pair(Kind::kAngles, ".angles.csv"),
                                     std::pair(Kind::kTemperatures, ".temperatures.csv")}) {
    fs::path beside = source.path();
    beside += ending;
    std::error_code ignored;
    if (!fs::exists(beside, ignored)) continue;
    const auto table = openTable(beside, options);
    Planning p{*table, hand, mapping};
    auto series = chooseSamples(p, kind);
    if (series) p.times.find(*series, sampleMapping(p, kind).time);
    if (series && series->time) plan.series.push_back(std::move(*series));
    plan.notes.insert(plan.notes.end(), p.plan.notes.begin(), p.plan.notes.end());
  }
  return plan;
}

// The tables of samples that `palpate convert` wrote beside a list of active taxels, but for names
// that `files` have: "X.csv.wrench.csv" of "X.csv".
std::vector<SeriesFile> exportedBeside(const fs::path& list,
                                       const TableOptions& options,
                                       std::span<const SeriesFile> files) {
  std::vector<SeriesFile> beside;
  const std::string begin = list.filename().string() + ".";
  constexpr std::string_view kEnd = ".csv";
  const fs::path folder = list.has_parent_path() ? list.parent_path() : fs::path(".");
  std::error_code failure;
  for (fs::directory_iterator at(folder, failure), end; !failure && at != end;
       at.increment(failure)) {
    const std::string file = at->path().filename().string();
    if (!file.starts_with(begin) || !file.ends_with(kEnd) ||
        file.size() <= begin.size() + kEnd.size())
      continue;
    const std::string name = file.substr(begin.size(), file.size() - begin.size() - kEnd.size());
    if (seriesName(name) != name || isHandSeries(name) ||
        std::ranges::find(files, name, &SeriesFile::name) != files.end())
      continue;
    try {
      if (exportedTimeOf(openTable(at->path(), options)->columns()))
        beside.push_back({name, at->path(), std::nullopt});
    } catch (const Error&) {
      // Not a table, so not an export.
    }
  }
  std::ranges::sort(beside, {}, &SeriesFile::name);
  return beside;
}

// A name that a series can have, and that no other one has.
void requireName(const fs::path& source, const SeriesFile& file, const ImportPlan& plan) {
  const std::string valid = seriesName(file.name);
  if (valid != file.name)
    throw FormatError(source, sentenceOf(reason::kSeriesName, {file.name, valid}));
  const bool isTaken = isHandSeries(file.name) ||
                       std::any_of(plan.series.begin(), plan.series.end(), [&](const auto& other) {
                         return other.kind == Kind::kFurther && other.further.name == file.name;
                       });
  if (isTaken) throw FormatError(source, sentenceOf(reason::kSeriesTwice, {file.name}));
}

}  // namespace

bool saysOrigin(const TableColumn& column) {
  if (column.numRows || !isScalar(column) || column.hasDates) return false;
  std::vector<std::string> parts = nameParts(column.name);
  const bool isId = parts.size() > 1 && parts.back() == "id";
  if (isId || (parts.size() > 1 && parts.back() == "name")) parts.pop_back();
  if (parts.empty() || (column.isNumeric && !isId)) return false;
  return kOriginWords.contains(parts.back()) ||
         (isId && !column.isNumeric && parts.back() == "frame");
}

ImportPlan planImport(TableSource& source,
                      const HandDescription& hand,
                      const ImportMapping& mapping,
                      const TableOptions& options,
                      std::span<const SeriesFile> files,
                      std::uint64_t mostRows) {
  try {
    ImportPlan plan = isTaxelList(source.columns())
                          ? planTaxelList(source, hand, mapping, options)
                          : planTable(source, hand, mapping, files, mostRows);
    std::vector<SeriesFile> all(files.begin(), files.end());
    if (plan.isTaxelList)
      for (SeriesFile& file : exportedBeside(source.path(), options, files))
        all.push_back(std::move(file));
    for (const SeriesFile& file : all) {
      requireName(source.path(), file, plan);
      PlannedSeries series = planSeriesFile(file, hand, mapping, mostRows, plan);
      addOrigins(series.table->columns(), series);
      plan.series.push_back(std::move(series));
    }
    return plan;
  } catch (const FileError&) {
    throw;
  } catch (const FormatError&) {
    throw;
  } catch (const Error& error) {
    throw FormatError(source.path(), error.what());
  }
}

}  // namespace palpate
