#include "imports/stored_array_source.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "imports/column_unit.h"

namespace palpate {
namespace {

// IEEE 754 binary16.
double halfValue(std::uint16_t bits) {
  const int exponent = bits >> 10 & 0x1F;
  const int mantissa = bits & 0x3FF;
  const double sign = (bits & 0x8000) != 0 ? -1.0 : 1.0;
  if (exponent == 0x1F)
    return mantissa == 0 ? sign * std::numeric_limits<double>::infinity()
                         : std::numeric_limits<double>::quiet_NaN();
  if (exponent == 0) return sign * std::ldexp(mantissa, -24);
  return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

std::int64_t signExtended(std::uint64_t value, std::size_t bytes) {
  const int shift = static_cast<int>(64 - 8 * bytes);
  return static_cast<std::int64_t>(value << shift) >> shift;
}

std::uint64_t bitsOf(const NpyHeader& header, std::span<const std::byte> number) {
  return header.bigEndian ? bigEndian(number) : littleEndian(number);
}

double numberOf(const NpyHeader& header, std::span<const std::byte> number) {
  const std::uint64_t bits = bitsOf(header, number);
  switch (header.kind) {
    case NumberKind::kBool:
    case NumberKind::kUnsigned:
      return static_cast<double>(bits);
    case NumberKind::kSigned:
    case NumberKind::kDate:
      return static_cast<double>(signExtended(bits, header.itemBytes));
    case NumberKind::kFloat:
      if (header.itemBytes == 2) return halfValue(static_cast<std::uint16_t>(bits));
      if (header.itemBytes == 4)
        return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
      return std::bit_cast<double>(bits);
    case NumberKind::kOther:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TimeCell timeOf(const NpyHeader& header, std::span<const std::byte> number) {
  TimeCell cell;
  const std::uint64_t bits = bitsOf(header, number);
  cell.state = CellState::kNumber;
  cell.number = numberOf(header, number);
  if (header.kind == NumberKind::kDate) {
    const std::int64_t value = signExtended(bits, header.itemBytes);
    const double us = cell.number * static_cast<double>(header.dateUnitNs) / 1000.0;
    constexpr double kLatestUs = 1e18;
    if (value == INT64_MIN || std::abs(us) > kLatestUs)
      cell.state = CellState::kNotFinite;  // "not a time"
    else if (header.dateUnitNs >= 1000)
      cell.whole = value * (header.dateUnitNs / 1000);
    else
      cell.whole = value / 1000 + (value % 1000 >= 500 ? 1 : 0) - (value % 1000 <= -500 ? 1 : 0);
  } else if (header.kind == NumberKind::kSigned) {
    cell.whole = signExtended(bits, header.itemBytes);
  } else if (header.kind == NumberKind::kUnsigned && bits <= INT64_MAX) {
    cell.whole = static_cast<std::int64_t>(bits);
  } else if (!std::isfinite(cell.number)) {
    cell.state = CellState::kNotFinite;
  }
  return cell;
}

bool isFortran(const NpyHeader& header) { return header.fortranOrder && header.shape.size() > 1; }

}  // namespace

void StoredArraySource::addArray(const std::string& name, NpyHeader header, std::string type) {
  TableColumn column;
  column.name = name;
  column.unit = unitInName(name);
  column.type = std::move(type);
  column.isNumeric = header.kind != NumberKind::kOther && header.kind != NumberKind::kDate &&
                     !header.shape.empty();
  column.hasDates = header.kind == NumberKind::kDate;
  // A dimension of 0 leaves the others unchecked by the number of bytes.
  if (header.kind != NumberKind::kOther) {
    if (!column.setArrayShape(header.shape))
      throw FormatError(path_, inQuotes(name) + " has too many numbers per row");
    if (column.width() == 0) column.isNumeric = false;
  }
  columns_.push_back(std::move(column));
  arrays_.emplace_back().header = std::move(header);
}

// The bytes stay where they are: reversed axes are the other order of the array.
void StoredArraySource::reverseAxes(std::size_t column) {
  NpyHeader& header = arrays_[column].header;
  if (header.shape.size() < 2) return;
  std::reverse(header.shape.begin(), header.shape.end());
  header.fortranOrder = !header.fortranOrder;
  columns_[column].setArrayShape(header.shape);
}

void StoredArraySource::open(std::size_t column) {
  Array& array = arrays_[column];
  array.spooled = FileDescriptor();
  array.reader = unpacked(column);
  if (array.reader && isFortran(array.header)) spool(array);
}

// Fortran order needs any place of the array: it is unpacked into a file that has no name.
void StoredArraySource::spool(Array& array) {
  const auto fail = [&](const char* what) {
    return FileError(path_, std::string(what) + ": " + std::generic_category().message(errno));
  };
  const char* folder = std::getenv("TMPDIR");
  std::string pattern = std::string(folder && *folder ? folder : "/tmp") + "/palpate.XXXXXX";
  array.spooled = FileDescriptor(::mkostemp(pattern.data(), O_CLOEXEC));
  if (array.spooled.get() < 0) throw fail("can't be unpacked");
  ::unlink(pattern.c_str());
  std::uint64_t left = array.header.numBytes().value_or(0);
  std::vector<std::byte> piece(1u << 18);
  while (left > 0) {
    const auto now = std::span(piece).first(
        static_cast<std::size_t>(std::min<std::uint64_t>(left, piece.size())));
    array.reader->read(now);
    for (std::size_t written = 0; written < now.size();) {
      const ssize_t count =
          ::write(array.spooled.get(), now.data() + written, now.size() - written);
      if (count < 0 && errno != EINTR) throw fail("can't be unpacked");
      written += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    left -= now.size();
  }
}

void StoredArraySource::readNumbers(Array& array, std::uint64_t first, std::span<std::byte> bytes) {
  const std::uint64_t offset = first * array.header.itemBytes;
  if (!array.reader) return file_.read(array.header.dataOffset + offset, bytes);
  if (array.spooled.get() < 0) return array.reader->read(bytes);  // in order
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::pread(array.spooled.get(),
                                  bytes.data() + done,
                                  bytes.size() - done,
                                  static_cast<off_t>(offset + done));
    if (count == 0 || (count < 0 && errno != EINTR))
      throw FileError(path_, "can't be read after it was unpacked");
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

void StoredArraySource::readRows(std::size_t column, std::uint64_t first, std::size_t count) {
  Array& array = arrays_[column];
  const NpyHeader& header = array.header;
  std::size_t width = 1;
  for (std::size_t d = 1; d < header.shape.size(); ++d)
    width *= static_cast<std::size_t>(header.shape[d]);
  const std::size_t item = header.itemBytes;
  bytes_.resize(count * width * item);
  if (!isFortran(header)) return readNumbers(array, first * width, bytes_);
  // In Fortran order the first index, the row, changes fastest, then the second, ..
  strip_.resize(count * item);
  for (std::size_t k = 0; k < width; ++k) {
    // k counts the places of a row in the order of the file; `at` is its place in C order.
    std::size_t rest = k;
    std::size_t at = 0;
    std::size_t stride = width;
    for (std::size_t d = 1; d < header.shape.size(); ++d) {
      const auto size = static_cast<std::size_t>(header.shape[d]);
      stride /= size;
      at += rest % size * stride;
      rest /= size;
    }
    readNumbers(array, k * header.shape[0] + first, strip_);
    for (std::size_t r = 0; r < count; ++r)
      std::memcpy(bytes_.data() + (r * width + at) * item, strip_.data() + r * item, item);
  }
}

void StoredArraySource::load(std::size_t column,
                             std::uint64_t first,
                             std::size_t count,
                             std::vector<double>& values) {
  readRows(column, first, count);
  const NpyHeader& header = arrays_[column].header;
  values.resize(bytes_.size() / header.itemBytes);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = numberOf(header, std::span(bytes_).subspan(i * header.itemBytes, header.itemBytes));
}

void StoredArraySource::loadTimes(std::size_t column,
                                  std::uint64_t first,
                                  std::size_t count,
                                  std::vector<TimeCell>& times) {
  readRows(column, first, count);
  const NpyHeader& header = arrays_[column].header;
  times.resize(bytes_.size() / header.itemBytes);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = timeOf(header, std::span(bytes_).subspan(i * header.itemBytes, header.itemBytes));
}

}  // namespace palpate
