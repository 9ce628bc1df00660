#include "device/series_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/device/series_source.h"

#include "device/line_tokens.h"

namespace palpate {
namespace {

constexpr std::size_t kLongestSeriesLine = 16'384;  // bytes
constexpr double kMaxTimeUs = 9e15;
constexpr double kMissingValue = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kSeriesByteOrderMark = "\xEF\xBB\xBF";

bool isMissingValue(std::string_view text) {
  constexpr std::size_t kLongest = 4;
  if (text.empty()) return true;
  if (text.size() > kLongest) return false;
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small == "nan" || small == "-nan" || small == "null" || small == "na";
}

std::optional<double> numberOf(std::string_view text) {
  if (isMissingValue(text)) return kMissingValue;
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  return parseDouble(text);
}

std::string_view withoutQuotes(std::string_view text) {
  return text.size() > 1 && text.front() == '"' && text.back() == '"'
             ? text.substr(1, text.size() - 2)
             : text;
}

bool isColumnName(std::string_view text) {
  text = withoutQuotes(text);
  return !text.empty() && !isMissingValue(text) &&
         (line_tokens::isLetter(text.front()) || static_cast<unsigned char>(text.front()) >= 0x80);
}

// The numbers that JSON has no word for are written by Python nevertheless.
std::string withNulls(std::string_view line) {
  std::string text;
  bool isText = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (isText && line[i] == '\\' && i + 1 < line.size()) text += line[i++];
    if (line[i] == '"') isText = !isText;
    if (!isText && line.substr(i).starts_with("NaN")) {
      text += "null";
      i += 2;
    } else {
      text += line[i];
    }
  }
  return text;
}

bool isNumberOrNull(const Json& value) { return value.isNumber() || value.isNull(); }
double jsonValueOf(const Json& value) { return value.isNull() ? kMissingValue : value.asDouble(); }

std::vector<Column> unnamed(std::size_t count) {
  std::vector<Column> columns;
  for (std::size_t i = 1; i <= count; ++i) columns.push_back({std::to_string(i), ""});
  return columns;
}

std::string namesText(const std::vector<Column>& columns) {
  std::string text;
  for (const Column& column : columns)
    text += (text.empty() ? "" : ", ") + column.name +
            (column.unit.empty() ? "" : "[" + column.unit + "]");
  return shortened(text);
}

}  // namespace

Column columnOf(std::string_view text) {
  text = trimmed(withoutQuotes(trimmed(text)));
  for (const auto& [opening, closing] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t at = text.rfind(opening);
    if (at == std::string_view::npos || at == 0 || text.back() != closing) continue;
    return {std::string(trimmed(text.substr(0, at))),
            std::string(trimmed(text.substr(at + 1, text.size() - at - 2)))};
  }
  return {std::string(text), ""};
}

std::vector<Column> columnsOfCells(std::span<const std::string_view> cells) {
  std::vector<Column> columns;
  for (const std::string_view cell : cells) {
    // "fx (N)" where blanks separate the names.
    const bool isUnit = cell.size() > 2 && (cell.front() == '(' || cell.front() == '[');
    if (isUnit && !columns.empty() && columns.back().unit.empty())
      columns.back().unit = cell.substr(1, cell.size() - 2);
    else
      columns.push_back(columnOf(cell));
  }
  return columns;
}

std::optional<double> usPerTimeOf(const Column& column) {
  const std::string& name = column.name;
  const bool hasUnit = name == "t" || name == "time";
  const std::string unit = hasUnit                     ? (column.unit.empty() ? "s" : column.unit)
                           : name.starts_with("time_") ? name.substr(5)
                                                       : std::string();
  if (unit == "s") return kUsPerS;
  if (unit == "ms") return static_cast<double>(kUsPerMs);
  if (unit == "us") return 1.0;
  return std::nullopt;
}

void requireColumns(const std::vector<Column>& all) {
  SeriesDescription checked{"series", "", all, ""};
  const auto time = std::ranges::find_if(all, [](const Column& c) { return usPerTimeOf(c) > 0.0; });
  validate(checked);
  if (time != all.end()) checked.columns.erase(checked.columns.begin() + (time - all.begin()));
  validate(checked);
}

std::vector<Column> columnsOf(std::string_view text) {
  std::vector<Column> columns;
  for (;;) {
    const std::size_t comma = text.find(',');
    columns.push_back(columnOf(text.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  requireColumns(columns);
  return columns;
}

SeriesLines::SeriesLines(std::vector<Column> given)
    : splitter_(kLongestSeriesLine), isGiven_(!given.empty()) {
  if (isGiven_) learn(std::move(given), /*isNamed=*/true, /*isSure=*/true);
}

void SeriesLines::beginConnection(bool startsInside) {
  splitter_.restart();
  isInside_ = startsInside;
}

void SeriesLines::push(std::span<const std::byte> bytes, const Sink& sink) {
  splitter_.push(bytes, [&](const SplitLine& line) { takeSplit(line, sink); });
}

void SeriesLines::endLine(const Sink& sink) {
  splitter_.endLine([&](const SplitLine& line) { takeSplit(line, sink); });
}

void SeriesLines::cutOff(const Sink& sink) {
  splitter_.cutOff([&](const SplitLine& line) { takeSplit(line, sink); });
}

void SeriesLines::takeSplit(const SplitLine& line, const Sink& sink) {
  line_ = line.number;
  switch (line.kind) {
    case SplitLine::Kind::kWhole:
      takeLine(line.text, sink);
      break;
    case SplitLine::Kind::kTooLong:
      refuse("longer than " + std::to_string(splitter_.longest()) + " bytes");
      break;
    case SplitLine::Kind::kCutOff:
      refuse("the last line has no end: its last number may be cut off");
      break;
  }
  if (line.kind != SplitLine::Kind::kWhole || !line.text.empty()) isInside_ = false;
}

void SeriesLines::refuse(const std::string& why) {
  ++refused_;
  lastFault_ = "line " + std::to_string(line_) + ": " + why;
}

void SeriesLines::takeLine(std::string_view line, const Sink& sink) {
  if (line.starts_with(kSeriesByteOrderMark)) line.remove_prefix(kSeriesByteOrderMark.size());
  line = trimmed(line, " ");
  if (line.empty() || line.front() == '#') return;
  if (line.find('\0') != std::string_view::npos)
    return refuse("it has bytes of 0: send ASCII or UTF-8");
  if (line.front() != '{' && line.front() != '[') return takeCells(line, sink);
  try {
    const Json json = Json::parse(line.find("NaN") == std::string_view::npos ? std::string(line)
                                                                             : withNulls(line));
    if (json.isObject())
      takeObject(json, sink);
    else
      takeArray(json, sink);
  } catch (const Error& error) {
    refuse(error.what());
  }
}

// Splits a line into cells_; returns whether something else than blanks separates them.
bool SeriesLines::split(std::string_view line) {
  cells_.clear();
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) == std::string_view::npos) continue;
    for (;;) {
      const std::size_t end = line.find(separator);
      cells_.push_back(trimmed(line.substr(0, end)));
      if (end == std::string_view::npos) return true;
      line.remove_prefix(end + 1);
    }
  }
  while (!line.empty()) {
    const std::size_t end = line.find(' ');
    cells_.push_back(line.substr(0, end));
    line = end == std::string_view::npos ? std::string_view() : trimmed(line.substr(end), " ");
  }
  return false;
}

void SeriesLines::takeCells(std::string_view line, const Sink& sink) {
  const bool isSeparated = split(line);
  // A separator behind the last number, as many senders write it.
  const bool hasOneMore = all_.empty() ? cells_.size() > 1 : cells_.size() == all_.size() + 1;
  if (hasOneMore && cells_.back().empty()) cells_.pop_back();
  const bool isHeader = std::ranges::all_of(cells_, [](std::string_view cell) {
    return isColumnName(cell) || cell.starts_with('(') || cell.starts_with('[');
  });
  if (isHeader && isColumnName(cells_.front())) {
    std::vector<Column> header = columnsOfCells(cells_);
    const bool isSure = isSeparated || std::ranges::any_of(header, [this](const Column& column) {
                          return !column.unit.empty() ||
                                 std::ranges::find(all_, column.name, &Column::name) != all_.end();
                        });
    return takeHeader(std::move(header), isSure);
  }
  if (isInside_) {
    insideBytes_ += line.size();
    return;
  }
  numbers_.clear();
  for (const std::string_view cell : cells_) {
    const auto number = numberOf(cell);
    if (!number)
      return refuse("value " + std::to_string(numbers_.size() + 1) + " is " + inQuotes(cell) +
                    ", not a number");
    numbers_.push_back(*number);
  }
  takeNumbers(sink);
}

void SeriesLines::takeArray(const Json& array, const Sink& sink) {
  numbers_.clear();
  std::vector<Column> header;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const Json value = array.at(i);
    if (value.isString())
      header.push_back(columnOf(value.asString()));
    else if (isNumberOrNull(value))
      numbers_.push_back(jsonValueOf(value));
    else
      return refuse("value " + std::to_string(i + 1) + " is not a number");
  }
  if (header.empty() && !numbers_.empty()) return takeNumbers(sink);
  if (!numbers_.empty() || header.empty()) return refuse("neither numbers nor names");
  takeHeader(std::move(header), /*isSure=*/true);
}

// Members are found by their names, in any order; one that is not there is missing.
void SeriesLines::takeObject(const Json& object, const Sink& sink) {
  const std::vector<std::string> keys = object.keys();
  if (!isGiven_ && !hasRows_) {
    std::vector<Column> all;
    for (const std::string& key : keys)
      if (isNumberOrNull(object.at(key))) all.push_back(columnOf(key));
    if (!learn(std::move(all), /*isNamed=*/true, /*isSure=*/true)) return;
  }
  numbers_.assign(all_.size(), kMissingValue);
  bool isRow = false;
  for (const std::string& key : keys) {
    const Json value = object.at(key);
    const auto at = std::ranges::find(all_, columnOf(key).name, &Column::name);
    if (at == all_.end()) {
      if (isGiven_ || !isNumberOrNull(value)) continue;
      return refuse(inQuotes(key) + " is not one of its columns (" + namesText(all_) + ")");
    }
    if (!isNumberOrNull(value)) return refuse(inQuotes(key) + " is not a number");
    if (!at->unit.empty() && columnOf(key).unit != at->unit && !isGiven_)
      return refuse(inQuotes(key) + " has a different unit than before, " + inQuotes(at->unit));
    numbers_[static_cast<std::size_t>(at - all_.begin())] = jsonValueOf(value);
    isRow = true;
  }
  if (!isRow) return refuse("it has none of the columns " + namesText(all_));
  deliver(sink);
}

// `isSure`: it can't be a greeting or a message of the sender.
void SeriesLines::takeHeader(std::vector<Column> header, bool isSure) {
  // Without names, and with those that are given, a header of the same length says nothing new.
  if (isGiven_ || (hasRows_ && !isNamed_)) {
    if (header.size() != all_.size())
      refuse("the header has " + counted(header.size(), "name") + " instead of " +
             std::to_string(all_.size()));
    return;
  }
  if (!hasRows_) {
    if (all_.empty() || isSure || !isSure_) learn(std::move(header), /*isNamed=*/true, isSure);
    return;
  }
  if (header == all_) {
    isOther_ = false;
    return;
  }
  if (!isSure) return refuse(inQuotes(namesText(header)) + " is neither a row nor its header");
  isOther_ = true;
  refuse("the columns have changed: " + namesText(header) + " instead of " + namesText(all_) +
         ": rows are refused until they are as before");
}

void SeriesLines::takeNumbers(const Sink& sink) {
  if (isOther_) return refuse("the columns have changed");
  // A greeting was taken for a header.
  if (!hasRows_ && !isSure_ && !all_.empty() && numbers_.size() != all_.size()) {
    refuse(inQuotes(namesText(all_)) + " is not a header for what follows");
    all_.clear();
  }
  if (all_.empty() && !learn(unnamed(numbers_.size()), /*isNamed=*/false, /*isSure=*/false)) return;
  if (numbers_.size() != all_.size())
    return refuse(counted(numbers_.size(), "number") + " instead of " +
                  std::to_string(all_.size()));
  deliver(sink);
}

void SeriesLines::deliver(const Sink& sink) {
  SeriesRow row;
  values_ = numbers_;
  if (timeAt_) {
    const double us = numbers_[*timeAt_] * usPerTime_;
    if (std::abs(us) > kMaxTimeUs) return refuse("its time is out of range");
    if (!std::isnan(us)) row.deviceUs = std::llround(us);
    values_.erase(values_.begin() + static_cast<std::ptrdiff_t>(*timeAt_));
  }
  hasRows_ = true;
  row.values = values_;
  sink(row);
}

bool SeriesLines::learn(std::vector<Column> all, bool isNamed, bool isSure) {
  try {
    requireColumns(all);
  } catch (const std::invalid_argument& wrong) {
    refuse(escapedLine(wrong.what()));
    return false;
  }
  all_ = columns_ = std::move(all);
  timeAt_.reset();
  for (std::size_t i = 0; i < all_.size() && !timeAt_; ++i)
    if (const auto us = usPerTimeOf(all_[i])) {
      timeAt_ = i;
      usPerTime_ = *us;
      columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  isNamed_ = isNamed;
  isSure_ = isSure;
  return true;
}

}  // namespace palpate
