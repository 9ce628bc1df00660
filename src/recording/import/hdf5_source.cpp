#include "recording/import/hdf5_source.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include <hdf5.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "recording/hdf5_library.h"
#include "recording/import/column_unit.h"

namespace palpate {
namespace {

constexpr std::size_t kMostDataSets = 10'000;
constexpr std::size_t kMostHdf5Dimensions = 8;
constexpr hsize_t kLargestHdf5Row = 1u << 24;  // numbers

struct DataSet {
  std::string name;
  Hdf5Id id;
  std::vector<hsize_t> shape;
  bool isInteger = false;
  bool isSigned = false;
};

// The text of an attribute, such as `units`; empty where there is none.
std::string attributeText(hid_t object, const char* name) {
  constexpr std::size_t kMostBytes = 64;
  return readHdf5Text(object, name, kMostBytes).value_or("");
}

herr_t collectName(hid_t, const char* name, const H5O_info_t* info, void* data) {
  auto& names = *static_cast<std::vector<std::string>*>(data);
  if (info->type == H5O_TYPE_DATASET) names.emplace_back(name);
  return names.size() >= kMostDataSets ? 1 : 0;
}

std::string hdf5TypeName(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") + bits;
    case H5T_FLOAT:
      return "float" + bits;
    case H5T_STRING:
      return "text";
    case H5T_ENUM:
      return "enum";
    case H5T_COMPOUND:
      return "structure";
    default:
      return "other";
  }
}

}  // namespace

struct Hdf5Source::Impl {
  explicit Impl(hid_t id) : file(id, H5Fclose) {}
  Hdf5Id file;
  std::vector<DataSet> sets;

  // Reads rows as numbers of a type of the memory.
  bool read(std::size_t column, std::uint64_t first, std::size_t count, hid_t type, void* out) {
    const DataSet& set = sets[column];
    const Hdf5Id space(H5Dget_space(set.id.get()), H5Sclose);
    std::vector<hsize_t> start(set.shape.size(), 0);
    std::vector<hsize_t> size = set.shape;
    start[0] = first;
    size[0] = count;
    const auto rank = static_cast<int>(size.size());
    const Hdf5Id memory(H5Screate_simple(rank, size.data(), nullptr), H5Sclose);
    return space.ok() && memory.ok() &&
           H5Sselect_hyperslab(
               space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) >= 0 &&
           H5Dread(set.id.get(), type, memory.get(), space.get(), H5P_DEFAULT, out) >= 0;
  }
};

Hdf5Source::Hdf5Source(const std::filesystem::path& path) : ArraySource(path) {
  const auto lock = hdf5Lock();
  auto impl = std::make_unique<Impl>(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!impl->file.ok())
    throw FormatError(path, "can't be opened as HDF5: it is cut off, damaged or being written");
  std::vector<std::string> names;
  if (H5Ovisit2(
          impl->file.get(), H5_INDEX_NAME, H5_ITER_INC, &collectName, &names, H5O_INFO_BASIC) < 0)
    throw FormatError(path, "is damaged: the HDF5 data sets can't be listed");
  for (const std::string& name : names) {
    Hdf5Id id(H5Dopen2(impl->file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!id.ok()) throw FormatError(path, inQuotes(name) + " can't be opened: damaged");
    const Hdf5Id type(H5Dget_type(id.get()), H5Tclose);
    const Hdf5Id space(H5Dget_space(id.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    DataSet set{name, std::move(id), {}};
    TableColumn column{.name = name, .type = hdf5TypeName(type.get())};
    const H5T_class_t kind = H5Tget_class(type.get());
    set.isInteger = kind == H5T_INTEGER;
    set.isSigned = set.isInteger && H5Tget_sign(type.get()) != H5T_SGN_NONE;
    column.isNumeric = (kind == H5T_INTEGER || kind == H5T_FLOAT) && rank >= 1 &&
                       static_cast<std::size_t>(rank) <= kMostHdf5Dimensions;
    if (column.isNumeric) {
      set.shape.resize(static_cast<std::size_t>(rank));
      H5Sget_simple_extent_dims(space.get(), set.shape.data(), nullptr);
      column.numRows = set.shape[0];
      hsize_t width = 1;
      for (std::size_t d = 1; d < set.shape.size(); ++d) {
        if (__builtin_mul_overflow(width, set.shape[d], &width) || width > kLargestHdf5Row)
          throw FormatError(path, inQuotes(name) + " has too many numbers per row");
        column.shape.push_back(static_cast<std::size_t>(set.shape[d]));
      }
      if (width == 0) column.isNumeric = false;
      if (column.shape == std::vector<std::size_t>{1}) column.shape.clear();
    }
    column.unit = attributeText(set.id.get(), "units");
    if (column.unit.empty()) column.unit = attributeText(set.id.get(), "unit");
    if (column.unit.empty()) column.unit = unitInName(name);
    impl->sets.push_back(std::move(set));
    columns_.push_back(std::move(column));
  }
  if (columns_.empty()) throw FormatError(path, "holds no HDF5 data set");
  impl_ = std::move(impl);
}

Hdf5Source::~Hdf5Source() {
  const auto lock = hdf5Lock();
  impl_.reset();
}

std::string Hdf5Source::form() const {
  return "HDF5, " + std::to_string(columns_.size()) + " data sets";
}

void Hdf5Source::open(std::size_t) {}

void Hdf5Source::load(std::size_t column,
                      std::uint64_t first,
                      std::size_t count,
                      std::vector<double>& values) {
  const auto lock = hdf5Lock();
  values.resize(count * columns_[column].width());
  if (!impl_->read(column, first, count, H5T_NATIVE_DOUBLE, values.data()))
    throw FormatError(path_, inQuotes(columns_[column].name) + " can't be read: damaged");
}

void Hdf5Source::loadTimes(std::size_t column,
                           std::uint64_t first,
                           std::size_t count,
                           std::vector<TimeCell>& times) {
  const DataSet& set = impl_->sets[column];
  const auto requireRead = [&](bool ok) {
    if (!ok) throw FormatError(path_, inQuotes(columns_[column].name) + " can't be read: damaged");
  };
  times.assign(count, {});
  const auto lock = hdf5Lock();
  if (set.isInteger) {
    std::vector<std::int64_t> values(count);  // larger unsigned numbers are cut to INT64_MAX
    requireRead(impl_->read(column, first, count, H5T_NATIVE_INT64, values.data()));
    for (std::size_t i = 0; i < count; ++i)
      times[i] = {.state = CellState::kNumber,
                  .whole = values[i],
                  .number = static_cast<double>(values[i])};
    return;
  }
  std::vector<double> values(count);
  requireRead(impl_->read(column, first, count, H5T_NATIVE_DOUBLE, values.data()));
  for (std::size_t i = 0; i < count; ++i)
    times[i] = {.state = std::isfinite(values[i]) ? CellState::kNumber : CellState::kNotFinite,
                .number = values[i]};
}

}  // namespace palpate
