#include "recording/exchange/mat_file.h"

#include <bit>
#include <cerrno>
#include <limits>
#include <new>
#include <stdexcept>

#include <unistd.h>
#include <zlib.h>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/utf8.h"

namespace palpate {
namespace {

// Types of data elements (table 1-1).
constexpr std::uint32_t kMiInt8 = 1;
constexpr std::uint32_t kMiUint8 = 2;
constexpr std::uint32_t kMiUint16 = 4;
constexpr std::uint32_t kMiInt32 = 5;
constexpr std::uint32_t kMiUint32 = 6;
constexpr std::uint32_t kMiSingle = 7;
constexpr std::uint32_t kMiDouble = 9;
constexpr std::uint32_t kMiInt64 = 12;
constexpr std::uint32_t kMiMatrix = 14;
constexpr std::uint32_t kMiCompressed = 15;
constexpr std::uint32_t kMiUtf16 = 17;

constexpr std::uint64_t kMaxVariableBytes = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kFieldNameBytes = kMaxMatName + 1;  // with the NUL at its end

struct MatNumberType {
  std::uint32_t element;
  std::uint8_t arrayClass;
  std::size_t bytes;
};
MatNumberType matTypeOf(MatNumber number) {
  switch (number) {
    case MatNumber::kU8:
      return {kMiUint8, 9, 1};
    case MatNumber::kU16:
      return {kMiUint16, 11, 2};
    case MatNumber::kI32:
      return {kMiInt32, 12, 4};
    case MatNumber::kI64:
      return {kMiInt64, 14, 8};
    case MatNumber::kF32:
      return {kMiSingle, 7, 4};
    case MatNumber::kF64:
      break;
  }
  return {kMiDouble, 6, 8};
}

std::uint64_t matPadded(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

// Bytes of an element inside of an array, with its tag: up to four bytes of data stand in the tag.
std::uint64_t matElementBytes(std::uint64_t dataBytes) {
  return dataBytes > 0 && dataBytes <= 4 ? 8 : 8 + matPadded(dataBytes);
}

void matWriteTag(const MatSink& sink, std::uint32_t type, std::uint64_t bytes) {
  std::string tag;
  if (bytes > 0 && bytes <= 4) {
    appendLittleEndian(tag, type, 2);
    appendLittleEndian(tag, bytes, 2);
  } else {
    appendLittleEndian(tag, type, 4);
    appendLittleEndian(tag, bytes, 4);
  }
  sink(tag);
}

void matWritePadding(const MatSink& sink, std::uint64_t bytes) {
  const std::uint64_t inTag = bytes > 0 && bytes <= 4 ? 4 - bytes : matPadded(bytes) - bytes;
  sink(std::string(inTag, '\0'));
}

void matWriteElement(const MatSink& sink, std::uint32_t type, const std::string& data) {
  matWriteTag(sink, type, data.size());
  sink(data);
  matWritePadding(sink, data.size());
}

// UTF-8 as units of UTF-16; what is not UTF-8, or above U+FFFF, becomes U+FFFD: readers count
// letters in units (MATLAB) or in code points (SciPy), which are the same below U+10000 only.
std::u16string utf16(std::string_view text) {
  std::u16string units;
  for (const char32_t code : codePointsOf(text))
    units += code < 0x10000 ? static_cast<char16_t>(code) : u'\xFFFD';
  return units;
}

}  // namespace

// Classes of arrays (table 1-3).
enum class MatValue::Class : std::uint8_t { kCell = 1, kStruct = 2, kChar = 4, kNumeric = 0 };

MatValue MatValue::numbers(MatNumber type, std::vector<std::uint64_t> dimensions, Fill fill) {
  MatValue value;
  value.class_ = Class::kNumeric;
  value.type_ = type;
  value.dimensions_ = std::move(dimensions);
  value.fill_ = std::move(fill);
  return value;
}

MatValue MatValue::column(const std::vector<double>& values) {
  return numbers(MatNumber::kF64, {values.size(), 1}, [values](const MatSink& sink) {
    std::string bytes;
    for (const double one : values) appendLittleEndian(bytes, std::bit_cast<std::uint64_t>(one), 8);
    sink(bytes);
  });
}

MatValue MatValue::column(const std::vector<std::int64_t>& values) {
  return numbers(MatNumber::kI64, {values.size(), 1}, [values](const MatSink& sink) {
    std::string bytes;
    for (const std::int64_t one : values)
      appendLittleEndian(bytes, static_cast<std::uint64_t>(one), 8);
    sink(bytes);
  });
}

MatValue MatValue::text(const std::string& utf8) {
  const std::u16string units = utf16(utf8);
  MatValue value = numbers(
      MatNumber::kU16, {units.empty() ? 0u : 1u, units.size()}, [units](const MatSink& sink) {
        std::string bytes;
        for (const char16_t unit : units) appendLittleEndian(bytes, unit, 2);
        sink(bytes);
      });
  value.class_ = Class::kChar;
  return value;
}

MatValue MatValue::texts(const std::vector<std::string>& utf8) {
  MatValue value;
  value.class_ = Class::kCell;
  value.dimensions_ = {utf8.size(), 1};
  for (const std::string& one : utf8) value.values_.push_back(text(one));
  return value;
}

MatValue MatValue::structure(std::vector<std::pair<std::string, MatValue>> fields) {
  MatValue value;
  value.class_ = Class::kStruct;
  value.dimensions_ = {1, 1};
  for (auto& [name, field] : fields) {
    if (name.size() >= kFieldNameBytes)
      throw std::invalid_argument("MatValue: the name '" + shortened(name) + "' is too long");
    value.names_.push_back(name);
    value.values_.push_back(std::move(field));
  }
  return value;
}

// Of the numbers of an array.
std::uint64_t MatValue::dataBytes() const {
  std::uint64_t bytes = matTypeOf(type_).bytes;
  for (const std::uint64_t length : dimensions_) bytes *= length;
  return bytes;
}

std::uint64_t MatValue::numBytes(const std::string& name) const {
  std::uint64_t bytes = 8 + matElementBytes(8) + matElementBytes(4 * dimensions_.size()) +
                        matElementBytes(name.size());
  if (class_ == Class::kStruct)
    bytes += matElementBytes(4) + matElementBytes(kFieldNameBytes * names_.size());
  if (class_ == Class::kStruct || class_ == Class::kCell)
    for (const MatValue& value : values_) bytes += value.numBytes("");
  else
    bytes += matElementBytes(dataBytes());
  return bytes;
}

void MatValue::write(const std::string& name, const MatSink& sink) const {
  std::string tag;
  appendLittleEndian(tag, kMiMatrix, 4);
  appendLittleEndian(tag, numBytes(name) - 8, 4);
  sink(tag);
  std::string flags;
  appendLittleEndian(
      flags,
      class_ == Class::kNumeric ? matTypeOf(type_).arrayClass : static_cast<std::uint8_t>(class_),
      4);
  appendLittleEndian(flags, 0, 4);
  matWriteElement(sink, kMiUint32, flags);
  std::string dimensions;
  for (const std::uint64_t length : dimensions_) appendLittleEndian(dimensions, length, 4);
  matWriteElement(sink, kMiInt32, dimensions);
  matWriteElement(sink, kMiInt8, name);
  if (class_ == Class::kStruct) {
    std::string length;
    appendLittleEndian(length, kFieldNameBytes, 4);
    matWriteElement(sink, kMiInt32, length);
    std::string names;
    for (std::string field : names_) {
      field.resize(kFieldNameBytes);
      names += field;
    }
    matWriteElement(sink, kMiInt8, names);
  }
  if (class_ == Class::kStruct || class_ == Class::kCell) {
    for (const MatValue& value : values_) value.write("", sink);
    return;
  }
  const std::uint64_t bytes = dataBytes();
  matWriteTag(sink, class_ == Class::kChar ? kMiUtf16 : matTypeOf(type_).element, bytes);
  std::uint64_t written = 0;
  fill_([&](std::string_view piece) {
    written += piece.size();
    sink(piece);
  });
  if (written != bytes)
    throw std::logic_error("MatValue: " + std::to_string(written) + " bytes instead of " +
                           std::to_string(bytes));
  matWritePadding(sink, bytes);
}

MatFile::MatFile(const std::filesystem::path& path, Overwrite overwrite, std::string_view program)
    : out_(path, overwrite) {
  constexpr std::size_t kMatTextBytes = 116;
  std::string head = "MATLAB 5.0 MAT-file, Platform: GLNXA64, Created by: ";
  head += program;
  head.resize(kMatTextBytes, ' ');
  appendLittleEndian(head, 0, 8);       // no data of subsystems
  appendLittleEndian(head, 0x0100, 2);  // version
  head += "IM";                         // little-endian
  out_.write(head);
  position_ = head.size();
}

void MatFile::add(const std::string& name, const MatValue& value) {
  const std::uint64_t bytes = value.numBytes(name);
  if (bytes > kMaxVariableBytes)
    throw FileError(out_.path(),
                    "a MAT file holds at most 2 GB per variable, '" + shortened(name) +
                        "' would have " + fixedText(static_cast<double>(bytes) / 1e9, 1) +
                        " GB; write .h5, or a part with --from and --to");
  z_stream packer{};
  constexpr int kFastest = 1;
  if (deflateInit(&packer, kFastest) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&packer, &deflateEnd);
  std::string packed(1u << 17, '\0');
  std::uint64_t packedBytes = 0;
  std::string waiting;
  const auto deflateAll = [&](std::string_view in, int flush) {
    packer.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
    packer.avail_in = static_cast<uInt>(in.size());
    do {
      packer.next_out = reinterpret_cast<Bytef*>(packed.data());
      packer.avail_out = static_cast<uInt>(packed.size());
      deflate(&packer, flush);
      const std::size_t got = packed.size() - packer.avail_out;
      out_.write({packed.data(), got});
      packedBytes += got;
    } while (packer.avail_out == 0);
  };
  constexpr std::size_t kPiece = 1u << 18;
  const MatSink sink = [&](std::string_view piece) {
    waiting += piece;
    if (waiting.size() < kPiece) return;
    deflateAll(waiting, Z_NO_FLUSH);
    waiting.clear();
  };
  const std::uint64_t tagAt = position_;
  const auto tag = [](std::uint64_t size) {
    std::string text;
    appendLittleEndian(text, kMiCompressed, 4);
    appendLittleEndian(text, size, 4);
    return text;
  };
  out_.write(tag(0));
  value.write(name, sink);
  deflateAll(waiting, Z_FINISH);
  position_ += 8 + packedBytes;
  const std::string known = tag(packedBytes);
  if (::pwrite(out_.descriptor(), known.data(), known.size(), static_cast<off_t>(tagAt)) !=
      static_cast<ssize_t>(known.size()))
    throw FileError(out_.path(), "can't be written: " + writeFailureText(errno));
}

void MatFile::commit() { out_.commit(); }

}  // namespace palpate
