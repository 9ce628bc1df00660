#include "recording/zip_writer.h"

#include <zlib.h>

namespace palpate {
namespace {

// PKWARE APPNOTE.TXT 6.3: local file header, central directory, zip64 records.
constexpr std::uint16_t kZipWriterVersion = 45;      // 4.5: zip64
constexpr std::uint16_t kChecksumFollows = 1u << 3;  // general purpose flag
constexpr std::uint32_t kMax32 = 0xFFFFFFFF;
constexpr std::uint16_t kDosDate =
    0x0021;  // 1980-01-01: files do not depend on when they were made

void zipWriterLittle(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * i & 0xFF);
}

// Extra field 1: sizes and offset as 64-bit numbers.
std::string zip64(std::uint64_t size, bool withOffset, std::uint64_t offset) {
  std::string extra;
  zipWriterLittle(extra, 1, 2);
  zipWriterLittle(extra, withOffset ? 24 : 16, 2);
  zipWriterLittle(extra, size, 8);
  zipWriterLittle(extra, size, 8);
  if (withOffset) zipWriterLittle(extra, offset, 8);
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
  zipWriterLittle(head, 0x04034B50, 4);
  zipWriterLittle(head, kZipWriterVersion, 2);
  zipWriterLittle(head, kChecksumFollows, 2);
  zipWriterLittle(head, 0, 2);  // stored
  zipWriterLittle(head, 0, 2);  // time
  zipWriterLittle(head, kDosDate, 2);
  zipWriterLittle(head, 0, 4);       // checksum
  zipWriterLittle(head, kMax32, 4);  // sizes stand in the extra field
  zipWriterLittle(head, kMax32, 4);
  zipWriterLittle(head, name.size(), 2);
  zipWriterLittle(head, extra.size(), 2);
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
  zipWriterLittle(descriptor, 0x08074B50, 4);
  zipWriterLittle(descriptor, entry.crc, 4);
  zipWriterLittle(descriptor, entry.size, 8);
  zipWriterLittle(descriptor, entry.size, 8);
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
    zipWriterLittle(row, 0x02014B50, 4);
    zipWriterLittle(row, kZipWriterVersion, 2);
    zipWriterLittle(row, kZipWriterVersion, 2);
    zipWriterLittle(row, kChecksumFollows, 2);
    zipWriterLittle(row, 0, 2);  // stored
    zipWriterLittle(row, 0, 2);  // time
    zipWriterLittle(row, kDosDate, 2);
    zipWriterLittle(row, entry.crc, 4);
    zipWriterLittle(row, kMax32, 4);
    zipWriterLittle(row, kMax32, 4);
    zipWriterLittle(row, entry.name.size(), 2);
    zipWriterLittle(row, extra.size(), 2);
    zipWriterLittle(row, 0, 2);  // comment
    zipWriterLittle(row, 0, 2);  // disk
    zipWriterLittle(row, 0, 2);  // attributes
    zipWriterLittle(row, 0, 4);
    zipWriterLittle(row, kMax32, 4);  // offset
    put(row + entry.name + extra);
  }
  const std::uint64_t size = position_ - start;
  std::string end;
  zipWriterLittle(end, 0x06064B50, 4);  // zip64 end of central directory
  zipWriterLittle(end, 44, 8);
  zipWriterLittle(end, kZipWriterVersion, 2);
  zipWriterLittle(end, kZipWriterVersion, 2);
  zipWriterLittle(end, 0, 4);
  zipWriterLittle(end, 0, 4);
  zipWriterLittle(end, entries_.size(), 8);
  zipWriterLittle(end, entries_.size(), 8);
  zipWriterLittle(end, size, 8);
  zipWriterLittle(end, start, 8);
  zipWriterLittle(end, 0x07064B50, 4);  // its locator
  zipWriterLittle(end, 0, 4);
  zipWriterLittle(end, position_, 8);
  zipWriterLittle(end, 1, 4);
  zipWriterLittle(end, 0x06054B50, 4);  // end of central directory
  zipWriterLittle(end, 0, 2);
  zipWriterLittle(end, 0, 2);
  zipWriterLittle(end, 0xFFFF, 2);
  zipWriterLittle(end, 0xFFFF, 2);
  zipWriterLittle(end, kMax32, 4);
  zipWriterLittle(end, kMax32, 4);
  zipWriterLittle(end, 0, 2);
  put(end);
}

}  // namespace palpate
