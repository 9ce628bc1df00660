#include "imports/xsensor_source.h"

#include <array>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/text_file.h"

#include "imports/cell_text.h"
#include "imports/csv_shape.h"

namespace palpate {
namespace {

constexpr std::size_t kNumberColumn = 0;
constexpr std::size_t kTimeColumn = 1;
constexpr std::size_t kFirstSensor = 2;

// "2022 Aug 16" as "2022-08-16"; other texts as they are.
std::string isoDay(std::string_view day) {
  constexpr std::array<std::string_view, 12> kMonths = {
      "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"};
  constexpr std::size_t kYear = 4;
  constexpr std::size_t kDayAt = 9;
  const std::string small = smallLetters(day);
  for (std::size_t month = 0; month < kMonths.size(); ++month) {
    const bool isShort = small.size() == kDayAt + 1;
    if ((!isShort && small.size() != kDayAt + 2) ||
        small.substr(kYear, kDayAt - kYear) != " " + std::string(kMonths[month]) + " ")
      continue;
    const std::string number = std::to_string(month + 1);
    return small.substr(0, kYear) + (number.size() == 1 ? "-0" : "-") + number +
           (isShort ? "-0" : "-") + small.substr(kDayAt);
  }
  return std::string(day);
}

std::size_t sizeIn(std::string_view text) {
  const auto size = parseInteger(text);
  return size && *size > 0 && *size <= static_cast<std::int64_t>(kMaxNumbersPerRow)
             ? static_cast<std::size_t>(*size)
             : 0;
}

}  // namespace

bool XsensorSource::isExport(const std::filesystem::path& path) {
  constexpr std::size_t kLookedAt = 16384;
  std::string first = "\n" + beginningOfFile(path, kLookedAt);
  std::size_t at = 0;
  for (const std::string_view word :
       {"\nFRAME,", "\nSENSOR,", "\nRows,", "\nColumns,", "\nSENSELS"}) {
    at = first.find(word, at);
    if (at == std::string::npos) return false;
  }
  return true;
}

XsensorSource::XsensorSource(const std::filesystem::path& path, const TableOptions& options)
    : path_(path), options_(options), reader_(path) {
  if (options_.delimiter == 0) options_.delimiter = ',';
  while (nextLine() && cells_.front() != "FRAME")
    if (cells_.front() == "Units:" && cells_.size() > 1) unit_ = cells_[1];
  isHeld_ = true;
  Frame first;
  if (!readFrame(first) || !first.fault.empty() || first.sensors.empty())
    throw FormatError(
        path_,
        "is an export of XSENSOR whose first frame can't be read" +
            (first.fault.empty() ? "" : ": line " + std::to_string(first.line) + first.fault));
  columns_.push_back({.name = "frame", .type = "number"});
  const bool isDated = first.time.find('-') != std::string::npos;
  columns_.push_back({.name = "time",
                      .type = "text",
                      .example = first.time,
                      .isNumeric = false,
                      .hasDates = !first.time.empty(),
                      .dateForm = isDated ? DateForm::kIso : DateForm::kClock});
  for (const Sensor& sensor : first.sensors)
    columns_.push_back({.name = sensor.label(),
                        .unit = unit_,
                        .shape = {sensor.rows, sensor.columns},
                        .type = "number"});
  frame_.sensors = std::move(first.sensors);
}

std::string XsensorSource::Sensor::label() const {
  if (name.find("-LF") != std::string::npos) return "left " + name;
  if (name.find("-RF") != std::string::npos) return "right " + name;
  return name;
}

std::string XsensorSource::form() const { return "text, an export of XSENSOR"; }

std::string XsensorSource::rowNote() const {
  return "an export of XSENSOR: a frame is a block that begins with FRAME; groups of sensels are "
         "left out";
}

// Reads the next line that is not empty; false at the end.
bool XsensorSource::nextLine() {
  if (std::exchange(isHeld_, false)) return !cells_.empty();
  std::string_view line;
  cells_.clear();
  while (cells_.empty()) {
    if (!reader_.next(line)) return false;
    splitCells(line, options_.delimiter, cells_);
    for (std::string_view& cell : cells_) cell = trimmedCell(cell);
    while (!cells_.empty() && cells_.back().empty()) cells_.pop_back();
  }
  return true;
}

// Reads the rows of a sensor; a line of another form ends them.
void XsensorSource::readSensels(Frame& frame, Sensor& sensor) {
  const std::size_t count = sensor.rows * sensor.columns;
  if (sensor.rows == 0 || sensor.columns == 0 || count > kMaxNumbersPerRow) {
    frame.fault = " begins a frame without the rows and columns of " + inQuotes(sensor.name);
    return;
  }
  while (sensor.cells.size() < count && nextLine()) {
    double value = 0.0;
    if (cellStateOf(cells_.front(), options_.decimal, value) == CellState::kText) {
      isHeld_ = true;
      break;
    }
    if (cells_.size() > sensor.columns) {
      frame.fault = " begins a frame in which line " + std::to_string(reader_.number()) + " has " +
                    counted(cells_.size(), "number") + " instead of " +
                    std::to_string(sensor.columns);
      return;
    }
    lastRowLine_ = reader_.number();
    cells_.resize(sensor.columns);  // a last number may be missing, and is then an empty cell
    sensor.cells.insert(sensor.cells.end(), cells_.begin(), cells_.end());
  }
  if (sensor.cells.size() != count)
    frame.fault = " begins a frame in which " + inQuotes(sensor.name) + " has " +
                  counted(sensor.cells.size() / sensor.columns, "row") + " instead of " +
                  std::to_string(sensor.rows);
}

// Reads from a line FRAME to the one before the next; false at the end.
bool XsensorSource::readFrame(Frame& frame) {
  frame = {};
  Sensor* sensor = nullptr;
  std::string day;
  while (nextLine()) {
    const std::string_view word = cells_.front();
    const std::string_view value = cells_.size() > 1 ? cells_[1] : std::string_view();
    if (word == "FRAME") {
      if (frame.line != 0) {
        isHeld_ = true;
        return true;
      }
      frame.line = reader_.number();
      frame.number = value;
    } else if (frame.line == 0) {
      continue;
    } else if (word == "Date") {
      day = isoDay(value) + " ";
    } else if (word == "Time") {
      frame.time = day + std::string(value);
    } else if (word == "SENSOR") {
      sensor = &frame.sensors.emplace_back();
      sensor->name = value;
    } else if (word == "GROUP") {
      sensor = nullptr;
    } else if (word == "Rows" && sensor) {
      sensor->rows = sizeIn(value);
    } else if (word == "Columns" && sensor) {
      sensor->columns = sizeIn(value);
    } else if (word == "SENSELS" && sensor && frame.fault.empty()) {  // the first fault is told
      readSensels(frame, *sensor);
      sensor = nullptr;
    }
  }
  return frame.line != 0;
}

void XsensorSource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  selected_.assign(columns.begin(), columns.end());
  time_ = time;
  reader_.restart();
  isHeld_ = false;
}

bool XsensorSource::next(TableRow& row) {
  Frame read;
  if (!readFrame(read)) return false;
  frame_ = std::move(read);
  row = {};
  row.line = frame_.line;
  row.fault = frame_.fault;
  for (std::size_t c = kFirstSensor; c < columns_.size() && row.fault.empty(); ++c) {
    const std::size_t s = c - kFirstSensor;
    const bool isThere = s < frame_.sensors.size() &&
                         frame_.sensors[s].label() == columns_[c].name &&
                         frame_.sensors[s].cells.size() == columns_[c].width() &&
                         frame_.sensors[s].columns == columns_[c].shape[1];
    if (!isThere) row.fault = " begins a frame without " + inQuotes(columns_[c].name);
  }
  row.complete = row.fault.empty();
  if (!row.complete) return true;
  for (const std::size_t column : selected_)
    for (std::size_t i = 0; i < columns_[column].width(); ++i) {
      const std::string& cell = column == kNumberColumn ? frame_.number
                                : column == kTimeColumn
                                    ? frame_.time
                                    : frame_.sensors[column - kFirstSensor].cells[i];
      row.states.push_back(cellStateOf(cell, options_.decimal, row.values.emplace_back()));
    }
  if (time_) {
    row.time.text = *time_ == kTimeColumn ? frame_.time : frame_.number;
    row.time.state = row.time.text.empty() ? CellState::kEmpty : CellState::kText;
  }
  return true;
}

// The cell of a value of the last row.
const std::string* XsensorSource::cellAt(std::size_t index) const {
  for (const std::size_t column : selected_) {
    const std::size_t width = columns_[column].width();
    if (index >= width) {
      index -= width;
      continue;
    }
    if (column == kNumberColumn) return &frame_.number;
    if (column == kTimeColumn) return &frame_.time;
    const Sensor& sensor = frame_.sensors[column - kFirstSensor];
    return index < sensor.cells.size() ? &sensor.cells[index] : nullptr;
  }
  return nullptr;
}

std::string XsensorSource::endNote() const {
  if (!reader_.endsWithinLine() || lastRowLine_ != reader_.number()) return {};
  return "line " + std::to_string(lastRowLine_) +
         ", the last one, has no line end: its last number may be cut off";
}

std::string XsensorSource::textOf(std::size_t index) const {
  const std::string* cell = cellAt(index);
  return cell ? *cell : std::string();
}

std::string XsensorSource::placeOf(std::size_t index) const {
  const std::string* cell = cellAt(index);
  for (const std::size_t column : selected_) {
    const std::size_t width = columns_[column].width();
    if (index < width) {
      std::string place = inQuotes(columns_[column].name);
      if (width > 1)
        place += ", row " + std::to_string(index / columns_[column].shape[1]) + ", column " +
                 std::to_string(index % columns_[column].shape[1]);
      return place + (cell && !cell->empty() ? ": " + inQuotes(*cell) : " is empty");
    }
    index -= width;
  }
  return "a value";
}

}  // namespace palpate
