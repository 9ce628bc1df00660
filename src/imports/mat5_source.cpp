#include "imports/mat5_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::uint64_t kMatHeaderBytes = 128;
constexpr std::uint64_t kTagBytes = 8;
constexpr std::size_t kMaxMatArrays = 10'000;
constexpr std::size_t kMaxMatNamesBytes = 4u << 20;
constexpr std::size_t kMaxMatNameBytes = 4096;
constexpr std::size_t kMaxMatDimensions = 8;
constexpr int kMaxNesting = 16;

// Types of elements.
constexpr std::uint32_t kInt32Element = 5;
constexpr std::uint32_t kUint32Element = 6;
constexpr std::uint32_t kMatrixElement = 14;
constexpr std::uint32_t kCompressedElement = 15;

// Classes of arrays.
enum MatClass : std::uint8_t {
  kCellClass = 1,
  kStructClass = 2,
  kObjectClass = 3,
  kCharClass = 4,
  kSparseClass = 5,
  kFirstNumberClass = 6,
  kLastNumberClass = 15,
  kFunctionClass = 16,
  kOpaqueClass = 17,
};
constexpr std::uint32_t kComplexFlag = 0x800;
constexpr std::uint32_t kLogicalFlag = 0x200;

const char* classText(std::uint8_t matClass) {
  constexpr const char* kTexts[] = {"other",
                                    "cells",
                                    "structure",
                                    "object",
                                    "text",
                                    "sparse",
                                    "float64",
                                    "float32",
                                    "int8",
                                    "uint8",
                                    "int16",
                                    "uint16",
                                    "int32",
                                    "uint32",
                                    "int64",
                                    "uint64",
                                    "function",
                                    "object"};
  return matClass < std::size(kTexts) ? kTexts[matClass] : kTexts[0];
}

// How the numbers of an element are stored; the class of their array may be another one.
struct StoredNumber {
  NumberKind kind = NumberKind::kOther;
  std::size_t bytes = 0;
};
StoredNumber storedNumber(std::uint32_t elementType) {
  constexpr StoredNumber kTypes[] = {{},
                                     {NumberKind::kSigned, 1},
                                     {NumberKind::kUnsigned, 1},
                                     {NumberKind::kSigned, 2},
                                     {NumberKind::kUnsigned, 2},
                                     {NumberKind::kSigned, 4},
                                     {NumberKind::kUnsigned, 4},
                                     {NumberKind::kFloat, 4},
                                     {},
                                     {NumberKind::kFloat, 8},
                                     {},
                                     {},
                                     {NumberKind::kSigned, 8},
                                     {NumberKind::kUnsigned, 8}};
  return elementType < std::size(kTypes) ? kTypes[elementType] : StoredNumber{};
}

// The bytes of an element that is not compressed.
class PlainBytes final : public SequentialReader {
 public:
  PlainBytes(const RandomReader& file, std::uint64_t offset) : file_(file), offset_(offset) {}
  void read(std::span<std::byte> bytes) override {
    file_.read(offset_, bytes);
    offset_ += bytes.size();
  }
  void skip(std::uint64_t count) override { offset_ += count; }

 private:
  const RandomReader& file_;
  std::uint64_t offset_;
};

// The numbers of a compressed array. After the last one the rest of the element is unpacked, so
// that its checksum is compared.
class PackedNumbers final : public SequentialReader {
 public:
  PackedNumbers(std::unique_ptr<InflatedBytes> in, std::uint64_t bytes, std::uint64_t bytesBehind)
      : in_(std::move(in)), left_(bytes), behind_(bytesBehind) {}
  void read(std::span<std::byte> bytes) override {
    in_->read(bytes);
    left_ -= bytes.size();
    if (left_ > 0 || bytes.empty()) return;
    in_->skip(behind_);
    in_->finish();
  }

 private:
  std::unique_ptr<InflatedBytes> in_;
  std::uint64_t left_;
  std::uint64_t behind_;
};

}  // namespace

// Finds the arrays of one element.
class Mat5Source::Scan {
 public:
  Scan(Mat5Source& source, SequentialReader& in, Element element)
      : source_(source), in_(in), element_(element) {}

  // Of a compressed element the tag of the array comes first.
  void run() {
    std::uint64_t end = element_.bytes;
    if (element_.isCompressed) {
      const Tag tag = readTag(kTagBytes);
      if (tag.type != kMatrixElement || tag.isSmall) damaged();
      end = kTagBytes + tag.bytes;
    }
    const std::size_t first = source_.columns_.size();
    readArray({}, end, 0);
    source_.endOffset_.resize(source_.columns_.size(), end);
    source_.elements_.resize(source_.columns_.size(), element_);
    // Numbers that lie in the file as they are.
    if (!element_.isCompressed)
      for (std::size_t c = first; c < source_.arrays_.size(); ++c)
        source_.arrays_[c].header.dataOffset += element_.offset;
  }

 private:
  struct Tag {
    std::uint32_t type = 0;
    std::uint64_t bytes = 0;
    bool isSmall = false;  // up to four bytes of data stand in the tag
    std::array<std::byte, 4> data{};
  };

  [[noreturn]] void damaged() const {
    throw FormatError(
        source_.path_,
        "is damaged: " + (name_.empty() ? "an array" : inQuotes(name_)) + " can't be read");
  }

  std::uint64_t number(std::span<const std::byte> bytes) const {
    return source_.isBigEndian_ ? bigEndian(bytes) : littleEndian(bytes);
  }

  void need(std::uint64_t bytes, std::uint64_t end) const {
    if (position_ > end || bytes > end - position_) damaged();
  }

  void skipTo(std::uint64_t position) {
    in_.skip(position - position_);
    position_ = position;
  }

  // Padding may be missing at the end.
  void skipPadding(std::uint64_t end) { skipTo(std::min((position_ + 7) / 8 * 8, end)); }

  // `end`: of what holds the element. Its bytes lie before it, unless the tag is the first one.
  Tag readTag(std::uint64_t end, bool isInside = false) {
    need(kTagBytes, end);
    std::array<std::byte, kTagBytes> read{};
    in_.read(read);
    position_ += kTagBytes;
    const std::span<const std::byte> bytes = read;
    Tag tag;
    const std::uint64_t first = number(bytes.first(4));
    tag.isSmall = first >> 16 != 0;
    if (tag.isSmall) {
      tag.type = static_cast<std::uint32_t>(first & 0xFFFF);
      tag.bytes = first >> 16;
      std::copy_n(bytes.begin() + 4, 4, tag.data.begin());
      if (tag.bytes > tag.data.size()) damaged();
    } else {
      tag.type = static_cast<std::uint32_t>(first);
      tag.bytes = number(bytes.subspan(4));
      if (isInside) need(tag.bytes, end);
    }
    return tag;
  }

  // The bytes of the next element, which has this type (0: any).
  std::vector<std::byte> content(std::uint32_t type, std::size_t mostBytes, std::uint64_t end) {
    const Tag tag = readTag(end, true);
    if ((type != 0 && tag.type != type) || tag.bytes > mostBytes) damaged();
    std::vector<std::byte> bytes(static_cast<std::size_t>(tag.bytes));
    if (tag.isSmall) {
      std::copy_n(tag.data.begin(), bytes.size(), bytes.begin());
      return bytes;
    }
    in_.read(bytes);
    position_ += bytes.size();
    skipPadding(end);
    return bytes;
  }

  std::string text(std::size_t mostBytes, std::uint64_t end) {
    const std::vector<std::byte> bytes = content(0, mostBytes, end);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  // Room for so many columns more.
  bool hasRoom(std::uint64_t count) const {
    return count <= kMaxMatArrays - source_.columns_.size();
  }

  void add(NpyHeader header, const std::string& type) {
    source_.nameBytes_ += name_.size();
    if (!hasRoom(1) || source_.nameBytes_ > kMaxMatNamesBytes)
      throw FormatError(source_.path_,
                        "has too many arrays (more than " + std::to_string(kMaxMatArrays) +
                            "), or too long names");
    source_.addArray(name_, std::move(header), type);
  }

  // `givenName`: of a part of another array; the outermost has its name in the file. The array is
  // not left at its end: who reads on goes there.
  void readArray(const std::string& givenName, std::uint64_t end, int nesting) {
    name_ = givenName;
    const std::vector<std::byte> flagBytes = content(kUint32Element, kTagBytes, end);
    if (flagBytes.size() != kTagBytes) damaged();
    const auto flags = static_cast<std::uint32_t>(number(std::span(flagBytes).first(4)));
    const auto matClass = static_cast<std::uint8_t>(flags & 0xFF);
    std::vector<std::uint64_t> sizes;
    if (matClass != kOpaqueClass) sizes = readSizes(end);
    const std::string ownName = text(kMaxMatNameBytes, end);
    if (givenName.empty()) name_ = ownName;
    // Without a name: data of MATLAB's own for objects.
    if (name_.empty()) return;
    if (matClass >= kFirstNumberClass && matClass <= kLastNumberClass)
      return addNumbers(matClass, flags, std::move(sizes), end);
    const std::uint64_t count = partsOf(sizes);
    const bool isRead = nesting < kMaxNesting && hasRoom(count);
    if (matClass == kStructClass && isRead) return readFields(count, end, nesting);
    if (matClass == kCellClass && isRead) {
      const std::string name = name_;
      for (std::uint64_t i = 1; i <= count; ++i)
        readPart(name + "{" + std::to_string(i) + "}", end, nesting);
      return;
    }
    add({}, classText(matClass));
  }

  // Of cells or structures; more than are read: one more than that.
  static std::uint64_t partsOf(const std::vector<std::uint64_t>& sizes) {
    std::uint64_t count = 1;
    if (std::find(sizes.begin(), sizes.end(), 0u) != sizes.end()) return 0;
    for (const std::uint64_t size : sizes)
      count = std::min<std::uint64_t>(count * size, kMaxMatArrays + 1);  // sizes have 31 bits
    return count;
  }

  std::vector<std::uint64_t> readSizes(std::uint64_t end) {
    constexpr std::size_t kMaxSizes = 4096;
    const std::vector<std::byte> bytes = content(kInt32Element, 4 * kMaxSizes, end);
    if (bytes.size() % 4 != 0 || bytes.size() < 8) damaged();
    std::vector<std::uint64_t> sizes;
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      sizes.push_back(number(std::span(bytes).subspan(i, 4)));
      if (sizes.back() > INT32_MAX) damaged();
    }
    return sizes;
  }

  void addNumbers(std::uint8_t matClass,
                  std::uint32_t flags,
                  std::vector<std::uint64_t> sizes,
                  std::uint64_t end) {
    const Tag tag = readTag(end, true);
    const StoredNumber stored = storedNumber(tag.type);
    NpyHeader header;
    header.kind = stored.kind;
    header.itemBytes = stored.bytes;
    header.bigEndian = source_.isBigEndian_;
    header.dataOffset = position_ - (tag.isSmall ? tag.data.size() : 0);
    // MATLAB's first axis changes fastest.
    std::reverse(sizes.begin(), sizes.end());
    header.shape = std::move(sizes);
    const bool isEmpty =
        std::find(header.shape.begin(), header.shape.end(), 0u) != header.shape.end();
    if (isEmpty ? tag.bytes != 0
                : stored.kind == NumberKind::kOther || header.numBytes() != tag.bytes)
      throw FormatError(
          source_.path_,
          inQuotes(name_) +
              " declares a different number of numbers than it holds: it is cut off, or damaged");
    const bool isComplex = (flags & kComplexFlag) != 0;
    const bool isLogical = (flags & kLogicalFlag) != 0;
    if (isLogical && header.kind == NumberKind::kUnsigned) header.kind = NumberKind::kBool;
    if (isComplex || header.shape.size() > kMaxMatDimensions) header.kind = NumberKind::kOther;
    if (header.kind == NumberKind::kOther) header.shape.clear();
    add(std::move(header), isComplex ? "complex" : isLogical ? "bool" : classText(matClass));
  }

  void readPart(const std::string& name, std::uint64_t end, int nesting) {
    name_ = name;
    const Tag tag = readTag(end, true);
    if (tag.type != kMatrixElement || tag.isSmall) damaged();
    const std::uint64_t partEnd = position_ + tag.bytes;
    if (tag.bytes > 0) readArray(name, partEnd, nesting + 1);
    skipTo(partEnd);
  }

  void readFields(std::uint64_t count, std::uint64_t end, int nesting) {
    const std::string name = name_;
    const std::vector<std::byte> lengthBytes = content(kInt32Element, 4, end);
    const std::uint64_t length = number(lengthBytes);
    const std::string all = text(kMaxMatNamesBytes, end);
    if (lengthBytes.size() != 4 || length == 0 || all.size() % length != 0) damaged();
    std::vector<std::string> fields;
    for (std::size_t at = 0; at < all.size(); at += length) {
      const std::string_view field = std::string_view(all).substr(at, length);
      fields.emplace_back(field.substr(0, field.find('\0')));
    }
    if (!hasRoom(fields.size()) || !hasRoom(count * fields.size())) {
      add({}, classText(kStructClass));
      return;
    }
    for (std::uint64_t i = 1; i <= count; ++i)
      for (const std::string& field : fields)
        readPart(name + (count > 1 ? "(" + std::to_string(i) + ")." : ".") + field, end, nesting);
  }

  Mat5Source& source_;
  SequentialReader& in_;
  Element element_;
  std::uint64_t position_ = 0;  // in the element, unpacked
  std::string name_;            // of the array that is read
};

Mat5Source::Mat5Source(const std::filesystem::path& path) : StoredArraySource(path) {
  constexpr std::size_t kVersionAt = 124;
  std::array<char, kMatHeaderBytes> header{};
  if (file_.size() < header.size()) throw FormatError(path, "is cut off: no whole MAT file");
  file_.read(0, std::as_writable_bytes(std::span(header)));
  const std::string_view text(header.data(), header.size());
  const std::string_view version = text.substr(kVersionAt);
  isBigEndian_ = version == std::string_view("\1\0MI", 4);
  if (!isBigEndian_ && version != std::string_view("\0\1IM", 4))
    throw FormatError(path, "is not a MAT file of version 5: its header is damaged");
  for (std::uint64_t at = kMatHeaderBytes; at < file_.size();) {
    std::array<std::byte, kTagBytes> tag{};
    const auto number = [&](std::span<const std::byte> bytes) {
      return isBigEndian_ ? bigEndian(bytes) : littleEndian(bytes);
    };
    if (file_.size() - at < kTagBytes) throw FormatError(path, "is cut off within an array");
    file_.read(at, tag);
    const std::uint64_t type = number(std::span(tag).first(4));
    const std::uint64_t bytes = number(std::span(tag).subspan(4));
    at += kTagBytes;
    if (type != kMatrixElement && type != kCompressedElement)
      throw FormatError(path, "is damaged: no array at byte " + std::to_string(at - kTagBytes));
    if (bytes > file_.size() - at) throw FormatError(path, "is cut off within an array");
    const Element element{at, bytes, type == kCompressedElement};
    if (element.isCompressed) {
      InflatedBytes in(file_, at, bytes, Deflate::kZlib, "an array");
      Scan(*this, in, element).run();
    } else if (bytes > 0) {
      PlainBytes in(file_, at);
      Scan(*this, in, element).run();
    }
    at += bytes;
  }
  if (columns_.empty()) throw FormatError(path, "is a MAT file without arrays");
  recogniseOwn();
}

// In Palpate's own exports (docs/notes/exchange_formats.md) it is known what the axes are, and
// times, which are N x 1, have a row each.
void Mat5Source::recogniseOwn() {
  const auto has = [&](std::string_view name) {
    return std::any_of(columns_.begin(), columns_.end(), [&](const TableColumn& column) {
      return column.name == name;
    });
  };
  isOwn_ = has("provenance.program") && has("tactile.m0") && has("tactile.m0_static_mask");
  for (std::size_t c = 0; isOwn_ && c < columns_.size(); ++c) {
    std::vector<std::uint64_t>& shape = arrays_[c].header.shape;
    if (shape.size() != 2 || shape[0] != 1) continue;
    std::swap(shape[0], shape[1]);
    columns_[c].setArrayShape(shape);
  }
}

std::string Mat5Source::form() const {
  return "MAT file of version 5, " + counted(columns_.size(), "array");
}

std::unique_ptr<SequentialReader> Mat5Source::unpacked(std::size_t column) {
  const Element& element = elements_[column];
  if (!element.isCompressed) return nullptr;
  const NpyHeader& header = arrays_[column].header;
  const std::uint64_t bytes = header.numBytes().value_or(0);
  auto in = std::make_unique<InflatedBytes>(
      file_, element.offset, element.bytes, Deflate::kZlib, columns_[column].name);
  in->skip(header.dataOffset);
  return std::make_unique<PackedNumbers>(
      std::move(in), bytes, endOffset_[column] - header.dataOffset - bytes);
}

}  // namespace palpate
