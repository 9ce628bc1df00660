#include "recording/import/hdf5_source.h"

#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include <fcntl.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/file_descriptor.h"

#include "recording/import/column_unit.h"

namespace palpate {
namespace {

constexpr std::size_t kMostHdf5Dimensions = 8;

}  // namespace

Hdf5Source::Hdf5Source(const std::filesystem::path& path) : ArraySource(path) {
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0)
    throw FileError(path, "can't be read: " + std::generic_category().message(errno));
  file_ = std::make_unique<Hdf5Process>(path, descriptor.get(), Hdf5Use::kImport);
  for (const std::string& name : file_->arrayNames()) {
    Hdf5Facts facts = file_->facts(name);
    TableColumn column{.name = name, .type = facts.typeName};
    column.isNumeric = (facts.kind == Hdf5Kind::kInteger || facts.kind == Hdf5Kind::kFloat) &&
                       !facts.shape.empty() && facts.shape.size() <= kMostHdf5Dimensions;
    if (column.isNumeric) {
      column.numRows = facts.shape[0];
      std::uint64_t width = 1;
      for (std::size_t d = 1; d < facts.shape.size(); ++d) {
        if (__builtin_mul_overflow(width, facts.shape[d], &width))
          throw FormatError(path, inQuotes(name) + " has too many numbers per row");
        column.shape.push_back(static_cast<std::size_t>(facts.shape[d]));
      }
      if (width == 0) column.isNumeric = false;
      if (column.shape == std::vector<std::size_t>{1}) column.shape.clear();
    }
    constexpr std::size_t kMostUnitBytes = 64;
    for (const char* key : {"units", "unit"})
      if (column.unit.empty())
        column.unit = file_->textAttribute(name, key, kMostUnitBytes).value_or("");
    if (column.unit.empty()) column.unit = unitInName(name);
    facts_.push_back(std::move(facts));
    columns_.push_back(std::move(column));
  }
  if (columns_.empty()) throw FormatError(path, "holds no HDF5 data set");
}

std::string Hdf5Source::form() const {
  return "HDF5, " + std::to_string(columns_.size()) + " data sets";
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
  file_->read(columns_[column].name,
              first,
              count,
              Hdf5Number::kF64,
              std::as_writable_bytes(std::span(values)));
}

void Hdf5Source::loadTimes(std::size_t column,
                           std::uint64_t first,
                           std::size_t count,
                           std::vector<TimeCell>& times) {
  times.assign(count, {});
  if (facts_[column].kind == Hdf5Kind::kInteger) {
    std::vector<std::int64_t> values(count);  // larger unsigned numbers are cut to INT64_MAX
    file_->read(columns_[column].name,
                first,
                count,
                Hdf5Number::kI64,
                std::as_writable_bytes(std::span(values)));
    for (std::size_t i = 0; i < count; ++i)
      times[i] = {.state = CellState::kNumber,
                  .whole = values[i],
                  .number = static_cast<double>(values[i])};
    return;
  }
  std::vector<double> values;
  load(column, first, count, values);
  for (std::size_t i = 0; i < count; ++i)
    times[i] = {.state = std::isfinite(values[i]) ? CellState::kNumber : CellState::kNotFinite,
                .number = values[i]};
}

}  // namespace palpate
