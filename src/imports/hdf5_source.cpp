#include "imports/hdf5_source.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include <fcntl.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/text_file.h"
#include "palpate/imports/import_time.h"
#include "palpate/recording/hdf5_recording.h"

#include "imports/column_unit.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxHdf5Dimensions = 8;
constexpr std::size_t kMaxTimeTextBytes = 256;
constexpr std::size_t kMaxDescribedTexts = 16;  // columns
constexpr std::size_t kMaxUnitBytes = 64;       // and those of MATLAB's class

}  // namespace

Hdf5Source::Hdf5Source(const std::filesystem::path& path) : ArraySource(path) {
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0)
    throw FileError(path, "can't be read: " + std::generic_category().message(errno));
  const bool hasUserBlock =
      beginningOfFile(path, kHdf5Signature.size()) != kHdf5Signature;  // MATLAB's have
  file_ = std::make_unique<Hdf5Process>(path, descriptor.get(), Hdf5Use::kImport);
  for (const std::string& name : file_->arrayNames()) {
    Hdf5Facts facts = file_->facts(name);
    TableColumn column{.name = name, .type = facts.typeName};
    column.isNumeric = (facts.kind == Hdf5Kind::kInteger || facts.kind == Hdf5Kind::kFloat) &&
                       !facts.shape.empty() && facts.shape.size() <= kMaxHdf5Dimensions;
    if (column.isNumeric) {
      if (!column.setArrayShape(facts.shape))
        throw FormatError(path, inQuotes(name) + " has too many numbers per row");
      if (column.width() == 0) column.isNumeric = false;
    }
    const std::string matlabClass =
        hasUserBlock ? file_->textAttribute(name, "MATLAB_class", kMaxUnitBytes).value_or("") : "";
    isMatlab_ = isMatlab_ || !matlabClass.empty();
    if (matlabClass == "logical") column.type = "bool";
    if (matlabClass == "char") {
      column.type = "text";
      column.isNumeric = false;
    }
    for (const char* key : {"units", "unit"})
      if (column.unit.empty())
        column.unit = file_->textAttribute(name, key, kMaxUnitBytes).value_or("");
    if (column.unit.empty()) column.unit = unitInName(name);
    if (column.isNumeric) describe(column);
    facts_.push_back(std::move(facts));
    columns_.push_back(std::move(column));
  }
  if (columns_.empty()) throw FormatError(path, "holds no HDF5 data set");
  std::size_t described = 0;
  for (std::size_t c = 0; c < columns_.size() && described < kMaxDescribedTexts; ++c)
    if (facts_[c].kind == Hdf5Kind::kText && facts_[c].shape.size() == 1 && facts_[c].fault.empty())
      ++described, describeTexts(c);
}

// What netCDF's attributes say of an array of numbers.
void Hdf5Source::describe(TableColumn& column) {
  const auto numberOf = [&](const char* key) -> std::optional<double> {
    if (const auto number = file_->numberAttribute(column.name, key)) return number;
    const auto whole = file_->integerAttribute(column.name, key);
    return whole ? std::optional(static_cast<double>(*whole)) : std::nullopt;
  };
  column.scale = numberOf("scale_factor").value_or(1.0);
  column.offset = numberOf("add_offset").value_or(0.0);
  if (!std::isfinite(column.scale) || column.scale == 0.0 || !std::isfinite(column.offset))
    throw FormatError(path_, inQuotes(column.name) + " has an invalid scale_factor or add_offset");
  for (const char* key : {"_FillValue", "missing_value"})
    if (const auto number = numberOf(key); number && std::isfinite(*number))
      column.missing.push_back(*number);
  if (column.numRows) column.axes = file_->axisNames(column.name);
  if (column.axes.size() != 1 + column.shape.size()) column.axes.clear();
}

std::vector<std::string> Hdf5Source::texts(std::size_t column,
                                           std::uint64_t first,
                                           std::size_t count) {
  std::vector<std::string> all;
  while (all.size() < count)
    for (std::string& text : file_->texts(
             columns_[column].name, first + all.size(), count - all.size(), kMaxTimeTextBytes))
      all.push_back(std::move(text));
  return all;
}

void Hdf5Source::describeTexts(std::size_t column) {
  constexpr std::uint64_t kDescribedRows = 50;
  TableColumn& described = columns_[column];
  std::vector<std::string> read;
  try {
    read = texts(
        column, 0, static_cast<std::size_t>(std::min(kDescribedRows, facts_[column].shape[0])));
  } catch (const FormatError&) {  // other texts
    return;
  }
  std::vector<std::string_view> dates(read.begin(), read.end());
  if (dates.empty()) return;
  described.example = read[0];
  described.hasDates = std::all_of(dates.begin(), dates.end(), isDateText);
  if (!described.hasDates) return;
  described.setArrayShape(facts_[column].shape);
  described.type = "date";
  described.dateForm = dateFormOf(dates);
}

// That of the file, its groups and arrays, where all that have one agree.
std::optional<double> Hdf5Source::rateHz() const {
  constexpr std::size_t kMaxObjects = 100;
  std::set<std::string> objects = {""};
  for (const TableColumn& column : columns_)
    for (std::size_t end = 0; end != std::string::npos && objects.size() < kMaxObjects;) {
      end = column.name.find('/', end + 1);
      objects.insert(column.name.substr(0, end));
    }
  std::set<double> rates;
  for (const std::string& object : objects)
    for (const char* name :
         {"sampling_rate", "sample_rate", "sampling_frequency", "rate_hz", "fs"}) {
      std::optional<double> rate = file_->numberAttribute(object, name);
      if (const auto whole = rate ? std::nullopt : file_->integerAttribute(object, name))
        rate = static_cast<double>(*whole);
      if (rate && std::isfinite(*rate) && *rate > 0.0) rates.insert(*rate);
    }
  return rates.size() == 1 ? std::optional(*rates.begin()) : std::nullopt;
}

std::string Hdf5Source::form() const {
  return "HDF5, " + std::to_string(columns_.size()) + " data sets";
}

void Hdf5Source::reverseAxes(std::size_t column) {
  std::vector<std::uint64_t>& shape = facts_[column].shape;
  if (shape.size() < 2) return;
  std::reverse(shape.begin(), shape.end());
  columns_[column].setArrayShape(shape);
  std::reverse(columns_[column].axes.begin(), columns_[column].axes.end());
  if (!reversed_.insert(column).second) reversed_.erase(column);
}

// Reads rows as they are now. Along its last axis an array is read in the order of the file.
template <typename Value>
void Hdf5Source::readRows(std::size_t column,
                          std::uint64_t first,
                          Hdf5Number type,
                          std::span<Value> values) {
  const bool isReversed = reversed_.contains(column);
  const std::size_t width = columns_[column].width();
  const std::size_t count = values.size() / width;
  std::vector<Value> read(isReversed ? values.size() : 0);
  const std::span<Value> target = isReversed ? std::span(read) : values;
  file_->read(columns_[column].name,
              first,
              count,
              type,
              std::as_writable_bytes(target),
              isReversed ? Hdf5Axis::kLast : Hdf5Axis::kFirst);
  if (!isReversed) return;
  std::vector<std::uint64_t> sizes = facts_[column].shape;  // the rows first
  sizes[0] = count;
  for (std::size_t i = 0; i < read.size(); ++i) {
    // The first axis of the reversed array changes fastest in the file.
    std::size_t rest = i;
    std::size_t at = 0;
    for (const std::uint64_t size : sizes) {
      at = at * size + rest % size;
      rest /= size;
    }
    values[at] = read[i];
  }
}

void Hdf5Source::open(std::size_t column) {
  const std::string& fault = facts_[column].fault;
  if (!fault.empty()) throw FormatError(path_, inQuotes(columns_[column].name) + " " + fault);
}

void Hdf5Source::load(std::size_t column,
                      std::uint64_t first,
                      std::size_t count,
                      std::vector<double>& values) {
  values.resize(count * columns_[column].width());
  readRows(column, first, Hdf5Number::kF64, std::span(values));
  for (const double missing : columns_[column].missing)
    std::replace(values.begin(), values.end(), missing, std::numeric_limits<double>::quiet_NaN());
}

void Hdf5Source::loadTimes(std::size_t column,
                           std::uint64_t first,
                           std::size_t count,
                           std::vector<TimeCell>& times) {
  times.assign(count, {});
  if (facts_[column].kind == Hdf5Kind::kText) {
    timeTexts_ = texts(column, first, count);
    for (std::size_t i = 0; i < count; ++i)
      times[i] = {.state = timeTexts_[i].empty() ? CellState::kEmpty : CellState::kText,
                  .text = timeTexts_[i]};
    return;
  }
  if (facts_[column].kind == Hdf5Kind::kInteger) {
    std::vector<std::int64_t> values(count);  // larger unsigned numbers are cut to INT64_MAX
    readRows(column, first, Hdf5Number::kI64, std::span(values));
    const std::vector<double>& missing = columns_[column].missing;
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = static_cast<double>(values[i]);
      const bool isThere = std::find(missing.begin(), missing.end(), number) == missing.end();
      times[i] = {.state = isThere ? CellState::kNumber : CellState::kNotFinite,
                  .whole = values[i],
                  .number = number};
    }
    return;
  }
  std::vector<double> values;
  load(column, first, count, values);
  for (std::size_t i = 0; i < count; ++i)
    times[i] = {.state = std::isfinite(values[i]) ? CellState::kNumber : CellState::kNotFinite,
                .number = values[i]};
}

}  // namespace palpate
