#include "recording/exchange/zip_writer.h"

#include <zlib.h>

#include "palpate/core/byte_writer.h"

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
  appendLittle(extra, 1, 2);
  appendLittle(extra, withOffset ? 24 : 16, 2);
  appendLittle(extra, size, 8);
  appendLittle(extra, size, 8);
  if (withOffset) appendLittle(extra, offset, 8);
  return extra;
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
  appendLittle(head, 0x04034B50, 4);
  appendLittle(head, kZipWriterVersion, 2);
  appendLittle(head, kChecksumFollows, 2);
  appendLittle(head, 0, 2);  // stored
  appendLittle(head, 0, 2);  // time
  appendLittle(head, kDosDate, 2);
  appendLittle(head, 0, 4);       // checksum
  appendLittle(head, kMax32, 4);  // sizes stand in the extra field
  appendLittle(head, kMax32, 4);
  appendLittle(head, name.size(), 2);
  appendLittle(head, extra.size(), 2);
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
  appendLittle(descriptor, 0x08074B50, 4);
  appendLittle(descriptor, entry.crc, 4);
  appendLittle(descriptor, entry.size, 8);
  appendLittle(descriptor, entry.size, 8);
  put(descriptor);
}

void ZipWriter::add(std::string_view name, std::string_view bytes) {
  begin(name, bytes.size());
  write(bytes);
  end();
}

void ZipWriter::finish() {
  const std::uint64_t start = position_;
  for (const Entry& entry : entries_) {
    const std::string extra = zip64(entry.size, true, entry.offset);
    std::string row;
    appendLittle(row, 0x02014B50, 4);
    appendLittle(row, kZipWriterVersion, 2);
    appendLittle(row, kZipWriterVersion, 2);
    appendLittle(row, kChecksumFollows, 2);
    appendLittle(row, 0, 2);  // stored
    appendLittle(row, 0, 2);  // time
    appendLittle(row, kDosDate, 2);
    appendLittle(row, entry.crc, 4);
    appendLittle(row, kMax32, 4);
    appendLittle(row, kMax32, 4);
    appendLittle(row, entry.name.size(), 2);
    appendLittle(row, extra.size(), 2);
    appendLittle(row, 0, 2);  // comment
    appendLittle(row, 0, 2);  // disk
    appendLittle(row, 0, 2);  // attributes
    appendLittle(row, 0, 4);
    appendLittle(row, kMax32, 4);  // offset
    put(row + entry.name + extra);
  }
  const std::uint64_t size = position_ - start;
  std::string end;
  appendLittle(end, 0x06064B50, 4);  // zip64 end of central directory
  appendLittle(end, 44, 8);
  appendLittle(end, kZipWriterVersion, 2);
  appendLittle(end, kZipWriterVersion, 2);
  appendLittle(end, 0, 4);
  appendLittle(end, 0, 4);
  appendLittle(end, entries_.size(), 8);
  appendLittle(end, entries_.size(), 8);
  appendLittle(end, size, 8);
  appendLittle(end, start, 8);
  appendLittle(end, 0x07064B50, 4);  // its locator
  appendLittle(end, 0, 4);
  appendLittle(end, position_, 8);
  appendLittle(end, 1, 4);
  appendLittle(end, 0x06054B50, 4);  // end of central directory
  appendLittle(end, 0, 2);
  appendLittle(end, 0, 2);
  appendLittle(end, 0xFFFF, 2);
  appendLittle(end, 0xFFFF, 2);
  appendLittle(end, kMax32, 4);
  appendLittle(end, kMax32, 4);
  appendLittle(end, 0, 2);
  put(end);
}

}  // namespace palpate
