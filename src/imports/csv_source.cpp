#include "imports/csv_source.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/cell_text.h"

namespace palpate {
namespace {

// The lines that tell the shape of a table.
constexpr std::size_t kCsvSampleLines = 200;
constexpr std::size_t kCsvSampleBytes = 1u << 20;
constexpr std::size_t kCsvSampleFewestLines = 8;  // also when they are very long

constexpr std::string_view kMovieStart = "DATA_TYPE MOVIE";  // of Tekscan's ASCII export
constexpr std::string_view kBlocked = "B";  // in a movie: a cell that was taken out

// The number before a frame: one that stands alone, or behind the word "Frame"; empty: it is none.
std::string_view numberBefore(std::string_view line, char decimal, bool& isFrame) {
  constexpr std::string_view kWord = "frame";
  isFrame = smallLetters(line.substr(0, kWord.size())) == kWord;
  if (isFrame) line = trimmed(line.substr(kWord.size()), " \t:#=");
  return (isFrame ? parseInteger(line).has_value() : cellNumber(line, decimal).has_value())
             ? line
             : std::string_view();
}

std::vector<std::string> firstLines(LineReader& reader) {
  std::vector<std::string> lines;
  std::size_t bytes = 0;
  std::string_view line;
  while (lines.size() < kCsvSampleLines &&
         (bytes < kCsvSampleBytes || lines.size() < kCsvSampleFewestLines) && reader.next(line)) {
    lines.emplace_back(line);
    bytes += line.size();
  }
  // A blocked cell is no name of a column.
  if (std::find(lines.begin(), lines.end(), kMovieStart) != lines.end())
    for (std::string& each : lines)
      if (each.find_first_not_of("0123456789.,;B \t") == std::string::npos)
        std::replace(each.begin(), each.end(), kBlocked[0], '0');
  reader.restart();
  return lines;
}

}  // namespace

CsvSource::CsvSource(const std::filesystem::path& path, const TableOptions& options)
    : path_(path), reader_(path), shape_(detectCsvShape(path, firstLines(reader_), options)) {
  // The head of a movie of Tekscan.
  constexpr std::string_view kPeriod = "SECONDS_PER_FRAME";
  std::string_view line;
  for (std::size_t i = 0; i < kCsvSampleLines && !rateHz_ && reader_.next(line); ++i) {
    isMovie_ = isMovie_ || line == kMovieStart;
    if (isMovie_ && line.starts_with("ROWS ")) movieRows_ = trimmed(line.substr(5));
    if (isMovie_ && line.starts_with("COLS ")) movieColumns_ = trimmed(line.substr(5));
    if (line.starts_with(kPeriod))
      if (const auto period = parseDouble(trimmed(line.substr(kPeriod.size())));
          period && *period > 0.0)
        rateHz_ = 1.0 / *period;
  }
  reader_.restart();
  while (reader_.number() < shape_.nameLine && reader_.next(line)) {
  }
  if (shape_.nameLine != 0 && !shape_.labelled && !shape_.nested && !shape_.stamped) {
    splitCells(line, shape_.delimiter, cells_);
    for (const std::string_view cell : cells_) laterNames_.first.emplace_back(trimmedCell(cell));
  }
  reader_.restart();
  for (std::size_t c = 0; (shape_.labelled || shape_.nested) && c < shape_.columns.size(); ++c)
    labelled_.try_emplace(shape_.columns[c].name, c);
}

std::string CsvSource::advice() const {
  if (shape_.nested && shape_.cellNames.empty())
    return "; JSON is read as an object or a list in each line, one for each frame";
  if (movieRows_.empty() || movieColumns_.empty()) return {};
  return "; its head says " + movieRows_ + " rows x " + movieColumns_ + " columns";
}

std::string CsvSource::form() const {
  if (shape_.nested)
    return shape_.cellNames.empty() ? "text, a list or an object in each line"
                                    : "text, lists in its cells, separated by " +
                                          std::string(delimiterName(shape_.delimiter)) + "s";
  if (!shape_.pads.empty()) return "text, " + rowNote();
  if (shape_.labelled)
    return std::string("text, name:value in each line") +
           (shape_.stamped ? ", times before the lines" : "");
  std::string text = "text, separated by " + std::string(delimiterName(shape_.delimiter)) + "s";
  if (shape_.columns.size() == 1) text = "text, one number in each line";
  if (shape_.decimal == ',') text += ", with decimal commas";
  if (shape_.stamped) text += ", times before the lines";
  text += shape_.nameLine == 0 ? ", without names"
                               : ", names in line " + std::to_string(shape_.nameLine);
  if (shape_.unitLine != 0) text += ", units in line " + std::to_string(shape_.unitLine);
  return text;
}

std::string CsvSource::rowNote() const {
  if (shape_.pads.empty()) return {};
  std::string names;
  for (const PadColumns& pad : shape_.pads)
    names += (names.empty() ? "" : ", ") + inQuotes(pad.name);
  return "a frame is a line for each of " + names + ", and begins with the first of them";
}

void CsvSource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  selected_.assign(columns.begin(), columns.end());
  time_ = time;
  frames_.before.clear();
  frames_.isBegun = false;
  frames_.brokenAt = 0;
  heldNumber_ = 0;
  laterNames_.columns.clear();
  laterNames_.otherLine = 0;
  reader_.restart();
}

// Puts the cells of a line into cells_, by column; false when their number is wrong.
bool CsvSource::readCells(std::string_view line, TableRow& row) {
  const std::size_t numColumns = shape_.columns.size() - joined_.size();
  const std::string_view stamp = shape_.stamped ? takeStamp(line) : std::string_view();
  if (!shape_.labelled && !shape_.nested) {
    splitCells(line, shape_.delimiter, cells_);
    if (!stamp.empty()) cells_.insert(cells_.begin(), stamp);
    const bool emptyEnd = cells_.size() == numColumns + 1 && trimmedCell(cells_.back()).empty();
    row.numCells = cells_.size();
    if (emptyEnd) cells_.pop_back();
    if (cells_.size() == numColumns) return placeByNames(row);
    row.fault =
        " has " + counted(row.numCells, "cell") + " instead of " + std::to_string(numColumns);
    return false;
  }
  cells_.assign(numColumns, {});
  if (!splitNamed(line, row)) return false;
  if (shape_.stamped) {
    names_.insert(names_.begin(), shape_.columns.front().name);
    values_.insert(values_.begin(), stamp);
  }
  row.numCells = names_.size();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    // The names come in the same order in most lines.
    if (i < numColumns && shape_.columns[i].name == names_[i]) {
      cells_[i] = values_[i];
      continue;
    }
    const auto at = labelled_.find(names_[i]);
    if (at != labelled_.end()) {
      cells_[at->second] = values_[i];
    } else if (shape_.nested && (!shape_.cellNames.empty() || names_[i].ends_with(']'))) {
      row.fault = " has a value that the first lines lack: " + shortened(names_[i]);
      return false;
    }
  }
  return true;
}

// Puts the cells of a row into the columns of the names above it; false when those are others. A
// line of texts, none twice, is one of names where it has one of the first line: other words are a
// row that can't be used.
bool CsvSource::placeByNames(TableRow& row) {
  LaterNames& later = laterNames_;
  std::map<std::string_view, std::size_t> places;
  double value = 0.0;
  if (!later.first.empty() && std::all_of(cells_.begin(), cells_.end(), [&](std::string_view cell) {
        return cellStateOf(cell, shape_.decimal, value) == CellState::kText;
      }))
    for (const std::string_view cell : cells_) places.emplace(trimmedCell(cell), places.size());
  const bool areNames = places.size() == cells_.size() &&
                        std::any_of(later.first.begin(), later.first.end(), [&](const auto& name) {
                          return places.contains(name);
                        });
  if (areNames) {
    later.columns.assign(cells_.size(), 0);
    later.otherLine = 0;
    for (std::size_t c = 0; c < later.first.size() && c < cells_.size(); ++c) {
      const auto at = places.find(later.first[c]);
      if (at == places.end())
        later.otherLine = reader_.number();
      else
        later.columns[at->second] = c;
    }
    const bool moved = !std::is_sorted(later.columns.begin(), later.columns.end());
    if (later.otherLine != 0 || !moved) later.columns.clear();
    if (later.otherLine == 0 && moved) {
      row.fault = " has the names in another order: the rows below it are read by them";
      return false;
    }
  } else if (later.otherLine != 0) {
    row.fault = " stands below other names, those of line " + std::to_string(later.otherLine);
    return false;
  }
  if (later.columns.empty()) return true;
  std::vector<std::string_view> placed(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) placed[later.columns[i]] = cells_[i];
  cells_ = std::move(placed);
  return true;
}

// Splits a line in which values have names; false when it is of another form.
bool CsvSource::splitNamed(std::string_view line, TableRow& row) {
  row.numCells = 0;
  if (!shape_.nested) {
    row.fault = " has a cell that is not name:value";
    return splitLabelled(line, names_, values_);
  }
  row.fault = " has no list or object as the first lines have";
  if (!splitNested(line, shape_, nested_)) {
    if (!nested_.fault.empty()) row.fault = nested_.fault;
    return false;
  }
  names_.assign(nested_.names.begin(), nested_.names.end());
  values_.assign(nested_.values.begin(), nested_.values.end());
  return true;
}

std::optional<std::size_t> CsvSource::joinTimes(std::size_t first,
                                                std::size_t second,
                                                std::int64_t factor) {
  TableColumn joined = shape_.columns[first];
  joined.name += " + " + shape_.columns[second].name;
  joined.example += " " + shape_.columns[second].example;
  joined.isDayOnly = false;
  if (factor != 0) joined.unit = factor == 1000 ? "ms" : factor == 1'000'000 ? "us" : "ns";
  shape_.columns.push_back(std::move(joined));
  joined_.push_back({first, second, factor, {}});
  return shape_.columns.size() - 1;
}

// Puts the joined times behind the cells of the line.
void CsvSource::readJoinedTimes() {
  for (JoinedTime& joined : joined_) {
    const std::string_view first = trimmedCell(cells_[joined.first]);
    const std::string_view second = trimmedCell(cells_[joined.second]);
    const auto whole = parseInteger(first);
    const auto part = parseInteger(second);
    std::int64_t sum = 0;
    const bool isSum = joined.factor != 0 && whole && part && *part >= 0 && *part < joined.factor &&
                       !__builtin_mul_overflow(*whole, joined.factor, &sum) &&
                       !__builtin_add_overflow(sum, *part, &sum);
    joined.text.assign(isSum ? std::to_string(sum) : first);
    if (!isSum && !second.empty()) joined.text.append(" ").append(second);
    cells_.push_back(joined.text);
  }
}

// Whether a line has the numbers of one line of a frame; its cells are then in cells_.
bool CsvSource::isFrameLine(std::string_view line, std::size_t numbers) {
  splitCells(line, shape_.delimiter, cells_);
  if (cells_.size() == numbers + 1 && trimmedCell(cells_.back()).empty()) cells_.pop_back();
  if (isMovie_)
    for (std::string_view& cell : cells_)
      if (trimmedCell(cell) == kBlocked) {
        cell = "0";
        hasBlocked_ = true;
      }
  const auto isText = [&](std::string_view cell) {
    double value = 0.0;
    return cellStateOf(cell, shape_.decimal, value) == CellState::kText;
  };
  return cells_.size() == numbers && !isCommentLine(line) &&
         2 * static_cast<std::size_t>(std::count_if(cells_.begin(), cells_.end(), isText)) <
             numbers;
}

std::string CsvSource::joinLines(std::size_t count) {
  if (shape_.nameLine != 0 || shape_.labelled || shape_.nested || shape_.stamped ||
      !shape_.pads.empty())
    return {};
  FrameLines found{.lines = count, .numbers = shape_.columns.size()};
  constexpr std::size_t kFrames = 20;
  std::map<std::size_t, std::size_t> lengths;  // how many blocks have so many lines
  std::size_t length = 0;
  std::size_t numBlocks = 0;
  std::size_t numNumbered = 0;
  bool areFrames = false;
  std::string before;
  std::string_view line;
  reader_.restart();
  for (std::size_t i = 0; i < kCsvSampleLines + kFrames * count && reader_.next(line); ++i) {
    if (isFrameLine(line, found.numbers)) {
      if (length++ > 0) continue;
      ++numBlocks;
      numNumbered +=
          found.numbers > 1 && !numberBefore(before, shape_.decimal, areFrames).empty() ? 1 : 0;
      continue;
    }
    if (length > 0) ++lengths[std::exchange(length, 0)];
    if (!trimmed(line).empty()) before = trimmed(line);
  }
  reader_.restart();
  const std::size_t numEnded = numBlocks - (length > 0 ? 1 : 0);
  found.areMarked = numEnded > 0;
  if (found.areMarked ? 2 * lengths[count] <= numEnded : length < count) return {};
  found.hasNumber = found.areMarked && numNumbered > 0 && numNumbered + 1 >= numBlocks;
  shape_.columns.clear();
  if (found.hasNumber)
    shape_.columns.push_back({.name = areFrames ? "frame" : "line before", .type = "number"});
  for (std::size_t i = 0; i < found.lines * found.numbers; ++i)
    shape_.columns.push_back({.name = "number " + std::to_string(i + 1), .type = "number"});
  frames_ = std::move(found);
  return "a frame is " + std::to_string(count) + " lines of " + counted(frames_.numbers, "number") +
         (frames_.areMarked ? ", with other lines between the frames"
                            : ", counted from the first one: nothing marks where a frame begins") +
         (hasBlocked_ ? "; blocked cells (B) are read as 0" : "");
}

// Reads the lines of the next frame into cells_; false at the end.
bool CsvSource::readFrame(TableRow& row) {
  std::string_view line;
  std::size_t count = 0;
  bool isCutOff = false;
  std::string before = frames_.before;
  frames_.text.clear();
  while (frames_.areMarked || count < frames_.lines) {
    if (!reader_.next(line)) {
      if (count == 0) return false;
      break;
    }
    isCutOff = isCutOff || (reader_.isCutOff() && !trimmed(line).empty());
    if (isFrameLine(line, frames_.numbers)) {
      lastRowLine_ = reader_.number();
      if (count++ == 0) {
        row.line = lastRowLine_;
        bool isFrame = false;
        if (frames_.hasNumber)
          frames_.text.append(numberBefore(before, shape_.decimal, isFrame)) += shape_.delimiter;
      }
      for (const std::string_view cell : cells_)
        if (count <= frames_.lines) frames_.text.append(cell) += shape_.delimiter;
      continue;
    }
    if (!trimmed(line).empty()) before = trimmed(line);
    if (frames_.areMarked && count > 0) break;
    if (!frames_.areMarked && !isCommentLine(line) && (count > 0 || frames_.isBegun) &&
        frames_.brokenAt == 0)
      frames_.brokenAt = reader_.number();
  }
  frames_.before = before;
  frames_.isBegun = true;
  row.numCells = count * frames_.numbers;
  row.complete = count == frames_.lines && frames_.brokenAt == 0 && !isCutOff;
  if (isCutOff)
    row.fault = " begins a frame that is cut off by bytes 0";
  else if (frames_.brokenAt != 0)
    row.fault = " begins a frame at or after line " + std::to_string(frames_.brokenAt) +
                ", which belongs to no frame: nothing marks where the next one begins";
  else if (!row.complete)
    row.fault = " begins a frame of " + counted(count, "line") + " instead of " +
                std::to_string(frames_.lines);
  frames_.text.pop_back();
  splitCells(frames_.text, shape_.delimiter, cells_);
  return true;
}

// Reads a line of each matrix into cells_; false at the end. A line that is missing costs one
// frame: the next one begins with the next line of the first matrix.
bool CsvSource::readPads(TableRow& row) {
  std::vector<bool> seen(shape_.pads.size(), false);
  std::size_t numSeen = 0;
  std::optional<std::int64_t> frame;
  std::string_view line;
  row.complete = true;
  row.fault.clear();
  row.numCells = 0;
  row.line = 0;
  padTexts_.assign(shape_.pads.size() + 1, {});
  const auto fail = [&](const std::string& why) {
    if (row.complete) row.fault = why;
    row.complete = false;
  };
  while (numSeen < seen.size()) {
    std::string held;
    std::uint64_t number = std::exchange(heldNumber_, 0);
    if (number != 0) {
      held = std::exchange(heldLine_, {});
      line = held;
    } else {
      if (!reader_.next(line)) break;
      number = reader_.number();
      if (reader_.isCutOff()) fail(" is cut off by bytes 0");
    }
    if (isCommentLine(line)) continue;
    std::string_view rest = line;
    const std::string_view stamp = shape_.stamped ? takeStamp(rest) : std::string_view();
    const auto pad = splitPadLine(rest);
    const auto at = std::find_if(shape_.pads.begin(), shape_.pads.end(), [&](const auto& each) {
      return pad && each.name == pad->name;
    });
    const auto index = static_cast<std::size_t>(at - shape_.pads.begin());
    if (index == 0 && row.line != 0) {  // the frame lacks a line
      heldLine_ = line;
      heldNumber_ = number;
      break;
    }
    lastRowLine_ = number;
    const bool begins = row.line == 0;
    if (begins) row.line = number;
    if (at == shape_.pads.end()) {
      fail(" begins a frame with a line that belongs to no matrix, line " + std::to_string(number));
      continue;
    }
    if (begins && index != 0) fail(" begins a frame without " + inQuotes(shape_.pads[0].name));
    if (seen[index]) fail(" begins a frame with two lines of " + inQuotes(at->name));
    if (begins)
      frame = pad->frame;
    else if (frame != pad->frame)
      fail(" begins a frame whose lines have different numbers");
    splitCells(pad->values, shape_.delimiter, cells_);
    if (cells_.size() == at->count + 1 && trimmedCell(cells_.back()).empty()) cells_.pop_back();
    if (cells_.size() != at->count)
      fail(" begins a frame in which " + inQuotes(at->name) + " has " +
           counted(cells_.size(), "number") + " instead of " + std::to_string(at->count));
    numSeen += seen[index] ? 0 : 1;
    seen[index] = true;
    padTexts_[index] = pad->values;
    if (begins) padTexts_.back() = stamp;
  }
  if (row.line == 0) return false;
  const auto missing = std::find(seen.begin(), seen.end(), false);
  if (missing != seen.end())
    fail(" begins a frame without " +
         inQuotes(shape_.pads[static_cast<std::size_t>(missing - seen.begin())].name));
  if (!row.complete) return true;
  std::vector<std::string_view> all(shape_.columns.size() - joined_.size());
  if (shape_.stamped) all.front() = padTexts_.back();
  for (std::size_t p = 0; p < shape_.pads.size(); ++p) {
    splitCells(padTexts_[p], shape_.delimiter, cells_);
    std::copy_n(cells_.begin(),
                shape_.pads[p].count,
                all.begin() + static_cast<std::ptrdiff_t>(shape_.pads[p].first));
  }
  cells_ = std::move(all);
  return true;
}

// Reads the next row that is one line into cells_; false at the end.
bool CsvSource::readLine(TableRow& row) {
  std::string_view line;
  do {
    if (!reader_.next(line)) return false;
  } while (reader_.number() <= shape_.linesBefore || isCommentLine(line) ||
           (shape_.nested && reader_.number() == shape_.nameLine));
  row.line = lastRowLine_ = reader_.number();
  row.complete = readCells(line, row) && !reader_.isCutOff();
  if (reader_.isCutOff()) row.fault = " is cut off by bytes 0";
  return true;
}

bool CsvSource::next(TableRow& row) {
  const bool isThere = frames_.lines > 0     ? readFrame(row)
                       : shape_.pads.empty() ? readLine(row)
                                             : readPads(row);
  if (!isThere) return false;
  if (!row.complete) return true;
  readJoinedTimes();
  row.values.resize(selected_.size());
  row.states.resize(selected_.size());
  for (std::size_t i = 0; i < selected_.size(); ++i)
    row.states[i] = cellStateOf(cells_[selected_[i]], shape_.decimal, row.values[i]);
  row.time = {};
  if (time_) {
    row.time.text = trimmedCell(cells_[*time_]);
    row.time.state = row.time.text.empty() ? CellState::kEmpty : CellState::kText;
  }
  return true;
}

std::string CsvSource::textOf(std::size_t index) const {
  const std::size_t column = selected_.at(index);
  return column < cells_.size() ? std::string(trimmedCell(cells_[column])) : std::string();
}

std::string CsvSource::endNote() const {
  if (!reader_.endsWithinLine() || lastRowLine_ != reader_.number()) return {};
  return "line " + std::to_string(lastRowLine_) +
         ", the last one, has no line end: its last number may be cut off";
}

std::string CsvSource::placeOf(std::size_t index) const {
  const std::size_t column = selected_.at(index);
  std::string place = "column " + std::to_string(column + 1);
  if (column >= cells_.size()) return place;
  const std::string_view cell = trimmedCell(cells_[column]);
  if (cell.empty()) return place + " is empty";
  place += ": " + inQuotes(cell);
  if (shape_.decimal == '.') place += commaHint(cell);
  return place;
}

}  // namespace palpate
