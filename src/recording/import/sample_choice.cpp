#include "recording/import/sample_choice.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "recording/import/cell_text.h"
#include "recording/import/column_unit.h"
#include "recording/import/column_words.h"
#include "recording/import/time_choice.h"

namespace palpate {
namespace {

// Speeds, torques and targets of joints are not where they were.
bool isOtherQuantity(const TableColumn& column, PlannedSeries::Kind kind) {
  const auto parts = nameParts(column.name);
  const std::string unit = smallLetters(column.unit);
  return unit.find("/s") != std::string::npos || unit == "nm" || unit == "n m" || unit == "a" ||
         std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
           return kOtherQuantityWords.contains(part) ||
                  (kind == PlannedSeries::Kind::kAngles && kTemperatureWords.contains(part));
         });
}

// A column for each name of the hand's axes, or of its temperature sensors: called so, or with
// these words and one that says what it is ("position/thumb base", "board temperature").
std::vector<TableElement> samplesNamedAsIn(const std::vector<TableColumn>& columns,
                                           PlannedSeries::Kind kind,
                                           const std::vector<std::string>& names,
                                           const std::string& what,
                                           std::vector<std::string>& notes) {
  NameKeys keys;
  for (std::size_t n = 0; n < names.size(); ++n) addName(keys, names[n], n);
  const auto& words = kind == PlannedSeries::Kind::kAngles ? kAngleWords : kTemperatureWords;
  const char* unit = kind == PlannedSeries::Kind::kAngles ? "deg" : "degC";
  struct Found {
    std::vector<std::size_t> same, withWord;
  };
  std::vector<Found> found(names.size());
  std::vector<std::size_t> scalars;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const TableColumn& column = columns[c];
    if (!column.isNumeric || !isScalar(column) || column.type == "bool") continue;
    scalars.push_back(c);
    const std::string_view name = nameWithoutUnit(column.name);
    const auto literal = std::find_if(names.begin(), names.end(), [&](const std::string& each) {
      return column.name == each || name == each;
    });
    const auto named = literal != names.end() ? static_cast<std::size_t>(literal - names.begin())
                                              : namedIn(name, keys).value_or(names.size());
    if (named == names.size()) continue;
    const bool isSame = literal != names.end() || nameKey(name) == nameKey(names[named]);
    if (isSame && (column.name == names[named] || !isOtherQuantity(column, kind)))
      found[named].same.push_back(c);
    else if (!isSame && !isOtherQuantity(column, kind) && timeScore(column, kind) == 0 &&
             (hasWord(column, words) || hasWord(column, kMeasuredWords) ||
              conversionBetween(column.unit, unit)))
      found[named].withWord.push_back(c);
  }
  std::vector<TableElement> elements;
  std::set<std::size_t> chosen;
  std::string one;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const auto& which = found[n].same.empty() ? found[n].withWord : found[n].same;
    if (found[n].same.empty() && which.size() != 1) continue;
    elements.push_back({which.front(), 0, {}});
    chosen.insert(which.front());
    one = inQuotes(columns[which.front()].name);
  }
  // Some of more columns that differ by numbers are something else: taxels, the joints of an arm.
  for (const ColumnGroup& group : groupColumns(columns, scalars)) {
    const auto isChosen = [&](std::size_t c) {
      return chosen.contains(c) &&
             std::find(names.begin(), names.end(), columns[c].name) == names.end();
    };
    if (std::any_of(group.columns.begin(), group.columns.end(), isChosen) &&
        !std::all_of(group.columns.begin(), group.columns.end(), [&](std::size_t c) {
          return chosen.contains(c);
        }))
      return {};
  }
  if (elements.size() == names.size() || elements.empty()) return elements;
  notes.push_back(what + ": " + one + " is there, but " +
                  std::to_string(names.size() - elements.size()) + " of the hand's " +
                  std::to_string(names.size()) + " are not; not imported");
  return {};
}

}  // namespace

// The elements of the angles or temperatures, by the names of the columns.
std::vector<TableElement> findSamples(const std::vector<TableColumn>& columns,
                                      PlannedSeries::Kind kind,
                                      const std::vector<std::string>& names,
                                      std::vector<std::string>& notes,
                                      std::set<std::size_t>& otherColumns) {
  const std::size_t count = names.size();
  const auto& words = kind == PlannedSeries::Kind::kAngles ? kAngleWords : kTemperatureWords;
  const std::string what = kind == PlannedSeries::Kind::kAngles ? "joint angles" : "temperatures";
  std::vector<std::size_t> named;
  std::vector<TableColumn> others;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].isNumeric || columns[c].type == "bool" || !hasWord(columns[c], words) ||
        timeScore(columns[c], kind) > 0 || hasWord(columns[c], kCounterWords))
      continue;
    if (!isOtherQuantity(columns[c], kind)) {
      named.push_back(c);
      continue;
    }
    others.push_back(columns[c]);
    otherColumns.insert(c);
  }
  auto elements = samplesNamedAsIn(columns, kind, names, what, notes);
  if (!elements.empty()) return elements;
  std::vector<ColumnGroup> groups = groupColumns(columns, named);
  const auto isFit = [&](const ColumnGroup& group) { return group.elements.size() == count; };
  auto chosen = std::find_if(groups.begin(), groups.end(), [&](const ColumnGroup& group) {
    return isFit(group) && hasWord(columns[group.columns.front()], kMeasuredWords);
  });
  if (chosen == groups.end()) chosen = std::find_if(groups.begin(), groups.end(), isFit);
  // As many as the hand has, each with a name of its own: "joint.position.left".
  std::map<std::string_view, std::vector<std::size_t>> lists;
  for (const std::size_t c : named) {
    const std::string_view name = columns[c].name;
    const auto dot = name.rfind('.');
    if (dot == std::string_view::npos || !isScalar(columns[c])) continue;
    const auto inList = wordsOf(name.substr(0, dot));
    if (std::any_of(
            inList.begin(), inList.end(), [&](const auto& word) { return words.contains(word); }))
      lists[name.substr(0, dot)].push_back(c);
  }
  for (const auto& [list, all] : lists) {
    if (all.size() != count || chosen != groups.end()) continue;
    std::string order;
    for (std::size_t i = 0; i < count; ++i) {
      elements.push_back({all[i], 0, {}});
      order += (i > 0 ? ", " : "") + names[i] + " = " + shortened(columns[all[i]].name);
    }
    notes.push_back(what +
                    ": their names are others than the hand's; taken in the order of the "
                    "file: " +
                    order);
    return elements;
  }
  for (auto group = groups.begin(); group != groups.end(); ++group) {
    if (group == chosen) continue;
    if (!isFit(*group) && chosen == groups.end())
      notes.push_back(what + ": " + group->stem + " is " +
                      counted(group->elements.size(), "number") + ", but the hand has " +
                      std::to_string(count) + "; not imported");
    else if (isFit(*group))
      notes.push_back(what + ": " + chosen->stem + " is taken; " + group->stem +
                      " would fit as well");
  }
  if (chosen != groups.end()) {
    // By their last number, in ascending order: PlotJuggler sorts joint10 before joint2.
    std::stable_sort(
        chosen->elements.begin(),
        chosen->elements.end(),
        [](const TableElement& a, const TableElement& b) { return a.indices < b.indices; });
    return chosen->elements;
  }
  if (groups.empty() && !others.empty())
    notes.push_back(what + ": " + namesText(others) + " seem to be something else; not imported");
  return {};
}

}  // namespace palpate
