#include <algorithm>
#include <map>
#include <string_view>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/cell_text.h"
#include "imports/column_unit.h"
#include "imports/column_words.h"
#include "imports/planning.h"

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
std::vector<TableElement> samplesNamedAsIn(Planning& p,
                                           PlannedSeries::Kind kind,
                                           const std::vector<std::string>& names) {
  const std::vector<TableColumn>& columns = p.columns;
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
    if (!holdsNumbers(column) || !isScalar(column)) continue;
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
  p.plan.notes.push_back(samplesText(kind) + ": " + one + " is there, but " +
                         std::to_string(names.size() - elements.size()) + " of the hand's " +
                         std::to_string(names.size()) + " are not; not imported as such");
  return {};
}

// The elements of the angles or temperatures, by the names of the columns; none where they are not
// there. Columns of other quantities of joints are no taxels, either.
std::vector<TableElement> findSamples(Planning& p,
                                      PlannedSeries::Kind kind,
                                      const std::vector<std::string>& names) {
  const std::vector<TableColumn>& columns = p.columns;
  std::vector<std::string>& notes = p.plan.notes;
  const std::size_t count = names.size();
  const auto& words = kind == PlannedSeries::Kind::kAngles ? kAngleWords : kTemperatureWords;
  const std::string what = samplesText(kind);
  std::vector<std::size_t> named;
  std::vector<TableColumn> others;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!holdsNumbers(columns[c]) || !hasWord(columns[c], words) ||
        timeScore(columns[c], kind) > 0 || hasWord(columns[c], kCounterWords))
      continue;
    if (!isOtherQuantity(columns[c], kind)) {
      named.push_back(c);
      continue;
    }
    others.push_back(columns[c]);
    p.sampleColumns.insert(c);
  }
  auto elements = samplesNamedAsIn(p, kind, names);
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
    notes.push_back(
        what + ": their names differ from the hand's; taken in the order of the file: " + order);
    return elements;
  }
  for (auto group = groups.begin(); group != groups.end(); ++group) {
    if (group == chosen) continue;
    if (!isFit(*group) && chosen == groups.end())
      notes.push_back(what + ": " + group->stem + " is " +
                      counted(group->elements.size(), "number") + ", but the hand has " +
                      std::to_string(count) + "; not imported as such");
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
    notes.push_back(what + ": " + namesText(others) +
                    " seem to be something else; not imported as such");
  return {};
}

// The unit of a column and of the hand, as a factor and an offset.
AddedValues valuesOf(Planning& p,
                     const ValueMapping& values,
                     const TableColumn& column,
                     const std::string& handUnit,
                     const std::string& what) {
  const bool scaled = values.scale != 1.0 || values.offset != 0.0;
  const bool given = !values.unit.empty();
  AddedValues added{{std::nullopt, values.scale, values.offset},
                    given    ? values.unit
                    : scaled ? handUnit
                             : column.unit};
  auto& [value, unit] = added;
  if (!scaled && (column.scale != 1.0 || column.offset != 0.0)) {
    value.scale = column.scale;
    value.offset = column.offset;
    p.note(reason::kScaledByFile, {what, column.name});
  }
  for (const double missing : column.missing)
    p.note(reason::kMissingValue, {what, numberText(missing), column.name});
  const bool isOurs = std::any_of(p.columns.begin(), p.columns.end(), [](const auto& each) {
    return each.name == "meta" && !each.isNumeric;  // palpate convert's values are the hand's
  });
  if (unit.empty() && !handUnit.empty() && handUnit != "counts" && !isOurs)
    p.note(reason::kNoUnit, {what, handUnit});
  if (unit.empty() || handUnit.empty()) return added;
  if (const auto known = conversionBetween(unit, handUnit)) {
    value.scale *= known->scale;
    value.offset = value.offset * known->scale + known->offset;
    return added;
  }
  if (given) p.refuse(reason::kNoConversion, {what, values.unit, handUnit});
  p.note(reason::kOtherUnit, {what, unit, handUnit});
  return added;
}

}  // namespace

AddedValues addValues(Planning& p,
                      PlannedSeries& series,
                      const std::string& what,
                      const std::vector<TableElement>& elements,
                      const std::vector<std::size_t>& targets,
                      const ValueMapping& values,
                      const std::string& handUnit) {
  AddedValues added = valuesOf(p, values, p.columns[elements.front().column], handUnit, what);
  std::map<std::size_t, std::size_t> begins;  // of the values of columns, which are read once each
  std::size_t at = 0;
  for (const std::size_t column : series.columns) {
    begins[column] = at;
    at += p.columns[column].width();
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto [begin, isNew] = begins.try_emplace(elements[e].column, series.values.size());
    if (isNew) {
      series.columns.push_back(elements[e].column);
      series.values.resize(series.values.size() + p.columns[elements[e].column].width());
    }
    PlannedValue& planned = series.values[begin->second + elements[e].within];
    if (planned.target) p.refuse(reason::kUsedTwice, {p.columns[elements[e].column].name});
    planned = added.value;
    planned.target = targets[e];
  }
  return added;
}

std::vector<std::string> namesOf(const HandDescription& hand, PlannedSeries::Kind kind) {
  std::vector<std::string> names;
  for (const AxisDescription& axis : hand.axes)
    if (kind == PlannedSeries::Kind::kAngles) names.push_back(axis.name);
  for (const TemperatureSensorDescription& sensor : hand.temperatureSensors)
    if (kind == PlannedSeries::Kind::kTemperatures) names.push_back(sensor.name);
  return names;
}

const SampleMapping& sampleMapping(const Planning& p, PlannedSeries::Kind kind) {
  return kind == PlannedSeries::Kind::kAngles ? p.mapping.angles : p.mapping.temperatures;
}

std::optional<PlannedSeries> chooseSamples(Planning& p, PlannedSeries::Kind kind) {
  const SampleMapping& wanted = sampleMapping(p, kind);
  const std::vector<std::string> names = namesOf(p.hand, kind);
  const std::string what = samplesText(kind);
  if (wanted.columns == kNoColumns) return std::nullopt;
  if (names.empty()) {
    if (!wanted.columns.empty()) p.refuse(reason::kHandHasNone, {what});
    return std::nullopt;
  }
  std::vector<TableElement> elements;
  if (wanted.columns.empty()) {
    elements = findSamples(p, kind, names);
    if (elements.empty()) return std::nullopt;
  } else {
    elements = chooseElements(p.columns, wanted.columns).elements;
    if (elements.size() != names.size())
      p.refuse(
          reason::kOtherSamples,
          {what, wanted.columns, counted(elements.size(), "number"), std::to_string(names.size())});
  }
  PlannedSeries series;
  series.kind = kind;
  series.file = p.source.path();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string unit = kind == PlannedSeries::Kind::kAngles ? p.hand.axes[i].unit() : "degC";
    const auto [value, used] = addValues(p, series, what, {elements[i]}, {i}, wanted.values, unit);
    if (i == 0) series.description.push_back(valuesText(p.columns, what, elements, value, used));
  }
  if (!sameRows(p.columns[elements.front().column], p.columns[elements.back().column]))
    p.refuse(reason::kSampleRows, {what});
  for (const TableElement& each : elements) p.sampleColumns.insert(each.column);
  return series;
}

}  // namespace palpate
