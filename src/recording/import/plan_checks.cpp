#include "recording/import/plan_checks.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "recording/import/column_choice.h"
#include "recording/import/column_unit.h"
#include "recording/import/column_words.h"

namespace palpate {
namespace {

// What the cells of a column hold instead of numbers: "text such as "0x1F": hexadecimal".
std::string whyNoNumbers(const TableColumn& column) {
  if (column.example.empty())
    return column.type == "structure" ? "structure: save each field as an array of its own"
                                      : column.type;
  const std::string_view cell = column.example;
  const std::string text = column.type + " such as " + inQuotes(cell);
  if (cell.starts_with("0x") || cell.starts_with("0X")) return text + ": hexadecimal";
  if (cell.starts_with("\xE2\x88\x92")) return text + ": its minus is not an ASCII minus";
  const auto blank = cell.find_first_not_of("+-.0123456789");
  if (blank != 0 && blank != std::string_view::npos && isKnownUnit(cell.substr(blank)))
    return text + ": a unit in the cell; put it into the name";
  return text;
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
  std::set<std::int64_t> all;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    std::set<std::int64_t> ofMatrix;
    const Mask& mask = layout.matrix(m).staticMask;
    for (std::size_t k = 0; k < mask.size(); ++k)
      if (mask[k] != 0) {
        ofMatrix.insert(static_cast<std::int64_t>(k));
        all.insert(static_cast<std::int64_t>(layout.offset(m) + k));
      }
    const auto fit = [&](const std::set<std::int64_t>& places, std::int64_t base) {
      return std::equal(
          places.begin(),
          places.end(),
          numbers.begin(),
          numbers.end(),
          [&](std::int64_t place, std::int64_t number) { return place + base == number; });
    };
    for (const std::int64_t base : {0, 1})
      if (fit(ofMatrix, base) || (m + 1 == layout.numMatrices() && fit(all, base))) return true;
  }
  return false;
}

const std::set<std::string> kFrameAxes = {
    "time", "t", "times", "timestamp", "frame", "frames", "sample", "samples"};
const std::set<std::string> kOriginWords = {
    "sensor", "topic", "source", "device", "publisher", "hand", "pad", "matrix", "node"};

bool saysOrigin(const TableColumn& column) {
  if (column.numRows || !isScalar(column) || column.hasDates) return false;
  std::vector<std::string> parts = nameParts(column.name);
  const bool isId = parts.size() > 1 && parts.back() == "id";
  if (isId || (parts.size() > 1 && parts.back() == "name")) parts.pop_back();
  if (parts.empty() || (column.isNumeric && !isId)) return false;
  return kOriginWords.contains(parts.back()) ||
         (isId && !column.isNumeric && parts.back() == "frame");
}

}  // namespace

std::string unusableText(const std::vector<TableColumn>& columns) {
  constexpr std::size_t kShown = 6;
  std::string text;
  std::size_t count = 0;
  for (const TableColumn& column : columns) {
    if ((column.isNumeric && column.type != "bool") || column.hasDates) continue;
    if (++count > kShown) continue;
    text += (count > 1 ? ", " : "; no numbers: ") + shortened(column.name) + " (" +
            whyNoNumbers(column) + ")";
  }
  if (count > kShown) text += " and " + std::to_string(count - kShown) + " more";
  std::set<std::string_view> names;
  for (const TableColumn& column : columns)
    if (!names.insert(column.name).second)
      return text + "; the name " + inQuotes(column.name) + " is there twice";
  return text;
}

std::vector<std::string> numberingDoubts(const std::vector<TableColumn>& columns,
                                         const PlannedSeries& frames,
                                         const SensorLayout& layout) {
  constexpr std::size_t kMostMissing = 8;
  std::vector<std::size_t> used;
  std::vector<std::size_t> scalars;
  std::size_t value = 0;
  for (const std::size_t c : frames.columns) {
    if (isScalar(columns[c]) && frames.values[value].target) used.push_back(c);
    value += columns[c].width();
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (isScalar(columns[c])) scalars.push_back(c);
  const std::vector<ColumnGroup> groups = groupColumns(columns, used);
  std::vector<std::string> doubts;
  for (const ColumnGroup& group : groups) {
    if (group.elements.size() < 2 || numVaryingIndices(group) != 1) continue;
    std::size_t position = 0;
    while (group.elements[0].indices[position] == group.elements[1].indices[position]) ++position;
    std::set<std::int64_t> numbers;
    for (const TableElement& each : group.elements) numbers.insert(each.indices[position]);
    if (numbers.size() != group.elements.size() || arePlacesOfTaxels(numbers, layout)) continue;
    std::string missing;
    std::size_t count = 0;
    for (std::int64_t last = *numbers.begin(); const std::int64_t number : numbers) {
      for (std::int64_t i = last + 1; i < number && count <= kMostMissing; ++i)
        if (count++ < kMostMissing)
          missing += (missing.empty() ? "" : ", ") + shortened(numberedName(group, position, i));
      last = number;
    }
    if (count > kMostMissing) missing += ", ..";
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
      isWhole = std::any_of(scalars.begin(), scalars.end(), [&](std::size_t c) {
        return columns[c].name == numberedName(group, position, i);
      });
    if (groups.size() == 1 && *numbers.begin() > 1 && !isWhole)
      doubts.push_back("the numbers of the taxels begin at " + first +
                       ", which is taken for the first one: those before it may be missing "
                       "(--matrix chooses columns)");
  }
  return doubts;
}

std::optional<bool> frameAxisByName(const std::vector<TableColumn>& columns) {
  std::optional<bool> isLast;
  for (const TableColumn& column : columns) {
    const auto& axes = column.axes;
    if (axes.size() < 2) continue;
    const auto named = std::find_if(axes.begin(), axes.end(), [](const std::string& axis) {
      return kFrameAxes.contains(smallLetters(axis));
    });
    if (named == axes.end()) continue;
    const bool isThisLast = named + 1 == axes.end();
    if ((named != axes.begin() && !isThisLast) || isLast.value_or(isThisLast) != isThisLast)
      throw Error("the axis " + inQuotes(*named) + " of " + shortened(column.name) +
                  " is the frames by its name, but stands elsewhere than in other arrays, or in "
                  "the middle; save all arrays with the frames first");
    isLast = isThisLast;
  }
  return isLast;
}

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

}  // namespace palpate
