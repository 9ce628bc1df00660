#include "recording/exchange/npz_file.h"

#include <zlib.h>

#include "palpate/core/byte_order.h"

namespace palpate {
namespace {

// PKWARE APPNOTE.TXT 6.3: local file header, central directory, zip64 records.
constexpr std::uint16_t kZipWriterVersion = 45;      // 4.5: zip64
constexpr std::uint16_t kChecksumFollows = 1u << 3;  // general purpose flag
constexpr std::uint32_t kMax32 = 0xFFFFFFFF;
// 1980-01-01: files do not depend on when they were made
constexpr std::uint16_t kDosDate = 0x0021;

// Extra field 1: sizes and offset as 64-bit numbers.
std::string zip64(std::uint64_t size, bool withOffset, std::uint64_t offset) {
  std::string extra;
  appendLittleEndian(extra, 1, 2);
  appendLittleEndian(extra, withOffset ? 24 : 16, 2);
  appendLittleEndian(extra, size, 8);
  appendLittleEndian(extra, size, 8);
  if (withOffset) appendLittleEndian(extra, offset, 8);
  return extra;
}

// The head of a .npy file, format 1.0 (numpy.lib.format): magic, version, length, a Python literal.
std::string npyHead(const std::string& type, const std::vector<std::size_t>& shape) {
  constexpr std::size_t kAlignment = 64;
  std::string dimensions;
  for (std::size_t size : shape) dimensions += std::to_string(size) + ", ";
  std::string literal =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + dimensions + "), }";
  const std::size_t before = 10;  // magic, version, length
  while ((before + literal.size() + 1) % kAlignment != 0) literal += ' ';
  literal += '\n';
  std::string head = "\x93NUMPY";
  head += '\x01';
  head += '\0';
  appendLittleEndian(head, literal.size(), 2);
  return head + literal;
}

}  // namespace

void ZipWriter::put(const std::string& bytes) {
  out_.write(bytes);
  position_ += bytes.size();
}

void ZipWriter::begin(std::string_view name, std::uint64_t size) {
  entries_.push_back({std::string(name), size, position_});
  const std::string extra = zip64(size, false, 0);
  std::string head;
  appendLittleEndian(head, 0x04034B50, 4);
  appendLittleEndian(head, kZipWriterVersion, 2);
  appendLittleEndian(head, kChecksumFollows, 2);
  appendLittleEndian(head, 0, 2);  // stored
  appendLittleEndian(head, 0, 2);  // time
  appendLittleEndian(head, kDosDate, 2);
  appendLittleEndian(head, 0, 4);       // checksum
  appendLittleEndian(head, kMax32, 4);  // sizes stand in the extra field
  appendLittleEndian(head, kMax32, 4);
  appendLittleEndian(head, name.size(), 2);
  appendLittleEndian(head, extra.size(), 2);
  put(head + std::string(name) + extra);
}

void ZipWriter::write(std::string_view bytes) {
  if (bytes.empty()) return;  // zlib would start its checksum over
  Entry& entry = entries_.back();
  entry.crc = static_cast<std::uint32_t>(
      crc32_z(entry.crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  out_.write(bytes);
  position_ += bytes.size();
}

void ZipWriter::end() {
  const Entry& entry = entries_.back();
  std::string descriptor;
  appendLittleEndian(descriptor, 0x08074B50, 4);
  appendLittleEndian(descriptor, entry.crc, 4);
  appendLittleEndian(descriptor, entry.size, 8);
  appendLittleEndian(descriptor, entry.size, 8);
  put(descriptor);
}

void ZipWriter::finish() {
  const std::uint64_t start = position_;
  for (const Entry& entry : entries_) {
    const std::string extra = zip64(entry.size, true, entry.offset);
    std::string row;
    appendLittleEndian(row, 0x02014B50, 4);
    appendLittleEndian(row, kZipWriterVersion, 2);
    appendLittleEndian(row, kZipWriterVersion, 2);
    appendLittleEndian(row, kChecksumFollows, 2);
    appendLittleEndian(row, 0, 2);  // stored
    appendLittleEndian(row, 0, 2);  // time
    appendLittleEndian(row, kDosDate, 2);
    appendLittleEndian(row, entry.crc, 4);
    appendLittleEndian(row, kMax32, 4);
    appendLittleEndian(row, kMax32, 4);
    appendLittleEndian(row, entry.name.size(), 2);
    appendLittleEndian(row, extra.size(), 2);
    appendLittleEndian(row, 0, 2);  // comment
    appendLittleEndian(row, 0, 2);  // disk
    appendLittleEndian(row, 0, 2);  // attributes
    appendLittleEndian(row, 0, 4);
    appendLittleEndian(row, kMax32, 4);  // offset
    put(row + entry.name + extra);
  }
  const std::uint64_t size = position_ - start;
  std::string end;
  appendLittleEndian(end, 0x06064B50, 4);  // zip64 end of central directory
  appendLittleEndian(end, 44, 8);
  appendLittleEndian(end, kZipWriterVersion, 2);
  appendLittleEndian(end, kZipWriterVersion, 2);
  appendLittleEndian(end, 0, 4);
  appendLittleEndian(end, 0, 4);
  appendLittleEndian(end, entries_.size(), 8);
  appendLittleEndian(end, entries_.size(), 8);
  appendLittleEndian(end, size, 8);
  appendLittleEndian(end, start, 8);
  appendLittleEndian(end, 0x07064B50, 4);  // its locator
  appendLittleEndian(end, 0, 4);
  appendLittleEndian(end, position_, 8);
  appendLittleEndian(end, 1, 4);
  appendLittleEndian(end, 0x06054B50, 4);  // end of central directory
  appendLittleEndian(end, 0, 2);
  appendLittleEndian(end, 0, 2);
  appendLittleEndian(end, 0xFFFF, 2);
  appendLittleEndian(end, 0xFFFF, 2);
  appendLittleEndian(end, kMax32, 4);
  appendLittleEndian(end, kMax32, 4);
  appendLittleEndian(end, 0, 2);
  put(end);
}

NpyArray::NpyArray(ZipWriter& zip,
                   const std::string& name,
                   const std::string& type,
                   std::size_t bytesPerNumber,
                   const std::vector<std::size_t>& shape)
    : zip_(zip) {
  std::uint64_t numbers = 1;
  for (std::size_t size : shape) numbers *= size;
  const std::string head = npyHead(type, shape);
  zip_.begin(name + ".npy", head.size() + numbers * bytesPerNumber);
  zip_.write(head);
}

void writeNpyText(ZipWriter& zip, const std::string& name, const std::string& ascii) {
  NpyArray array(zip, name, "<U" + std::to_string(ascii.size()), 4 * ascii.size(), {});
  for (unsigned char c : ascii) {
    array.u8(c);
    for (int i = 0; i < 3; ++i) array.u8(0);
  }
  array.end();
}

}  // namespace palpate
