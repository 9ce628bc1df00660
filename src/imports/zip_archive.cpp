#include "imports/zip_archive.h"

#include <algorithm>
#include <array>
#include <utility>

#include <zlib.h>

#include "palpate/core/byte_reader.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

constexpr std::size_t kEndBytes = 22;  // end of central directory without its comment
constexpr std::size_t kLongestZipComment = 65'535;
constexpr std::size_t kLocatorBytes = 20;  // of the 64-bit end record
constexpr std::uint64_t kMaxZipEntries = 10'000;
constexpr std::uint64_t kMaxDirectoryBytes = 16u << 20;
constexpr std::uint32_t kNoSize32 = 0xFFFFFFFF;

std::vector<std::byte> bytesAt(const RandomReader& file, std::uint64_t offset, std::size_t count) {
  std::vector<std::byte> bytes(count);
  file.read(offset, bytes);
  return bytes;
}

struct DirectoryPlace {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
  std::uint64_t numEntries = 0;
};

DirectoryPlace findDirectory(const RandomReader& file) {
  const std::uint64_t tail = std::min<std::uint64_t>(file.size(), kEndBytes + kLongestZipComment);
  const auto bytes = bytesAt(file, file.size() - tail, static_cast<std::size_t>(tail));
  for (std::size_t back = kEndBytes; back <= bytes.size(); ++back) {
    const std::size_t at = bytes.size() - back;
    ByteReader in{std::span<const std::byte>(bytes).subspan(at)};
    if (in.u32() != 0x06054B50) continue;
    const std::uint16_t disk = in.u16();
    in.u16();
    in.u16();
    DirectoryPlace place;
    place.numEntries = in.u16();
    place.size = in.u32();
    place.offset = in.u32();
    if (disk != 0 && disk != 0xFFFF) throw FormatError(file.path(), "is a part of a zip archive");
    const std::uint64_t end = file.size() - back;
    if (end < kLocatorBytes) return place;
    const auto locator = bytesAt(file, end - kLocatorBytes, kLocatorBytes);
    ByteReader locatorIn(locator);
    if (locatorIn.u32() != 0x07064B50) return place;
    locatorIn.u32();
    const auto record = bytesAt(file, locatorIn.u64(), 56);
    ByteReader recordIn(record);
    if (recordIn.u32() != 0x06064B50)
      throw FormatError(file.path(), "is damaged: its zip directory can't be found");
    recordIn.take(28);
    place.numEntries = recordIn.u64();
    place.size = recordIn.u64();
    place.offset = recordIn.u64();
    return place;
  }
  throw FormatError(file.path(), "is cut off: the directory at the end of the zip file is missing");
}

// Takes the 64-bit sizes from the extra field.
void readZip64(ByteReader extra, ZipEntry& entry) {
  while (extra.ok() && extra.remaining() >= 4) {
    const std::uint16_t id = extra.u16();
    ByteReader field(extra.take(extra.u16()));
    if (id != 1) continue;
    if (entry.size == kNoSize32) entry.size = field.u64();
    if (entry.packedSize == kNoSize32) entry.packedSize = field.u64();
    if (entry.offset == kNoSize32) entry.offset = field.u64();
    return;
  }
}

}  // namespace

std::vector<ZipEntry> readZipDirectory(const RandomReader& file) {
  const DirectoryPlace place = findDirectory(file);
  if (place.numEntries > kMaxZipEntries || place.size > kMaxDirectoryBytes)
    throw FormatError(file.path(), "declares a zip directory that is too large");
  const auto bytes = bytesAt(file, place.offset, static_cast<std::size_t>(place.size));
  ByteReader in(bytes);
  std::vector<ZipEntry> entries;
  for (std::uint64_t i = 0; i < place.numEntries; ++i) {
    ZipEntry entry;
    const bool isEntry = in.u32() == 0x02014B50;
    in.u32();  // versions
    const std::uint16_t flags = in.u16();
    const std::uint16_t method = in.u16();
    in.u32();  // time and date
    entry.crc = in.u32();
    entry.packedSize = in.u32();
    entry.size = in.u32();
    const std::uint16_t nameBytes = in.u16();
    const std::uint16_t extraBytes = in.u16();
    const std::uint16_t commentBytes = in.u16();
    in.take(8);  // disk, attributes
    entry.offset = in.u32();
    const auto name = in.take(nameBytes);
    entry.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
    readZip64(ByteReader(in.take(extraBytes)), entry);
    in.take(commentBytes);
    if (!in.ok() || !isEntry)
      throw FormatError(file.path(), "is damaged: its zip directory can't be read");
    if ((flags & 1u) != 0) throw FormatError(file.path(), inQuotes(entry.name) + " is encrypted");
    if (method != 0 && method != 8)
      throw FormatError(file.path(),
                        inQuotes(entry.name) + " is compressed with an unknown method (" +
                            std::to_string(method) + ")");
    entry.deflated = method == 8;
    entries.push_back(std::move(entry));
  }
  return entries;
}

ZipEntryReader::ZipEntryReader(const RandomReader& file, ZipEntry entry)
    : file_(file), entry_(std::move(entry)) {
  constexpr std::size_t kLocalHeaderBytes = 30;
  std::array<std::byte, kLocalHeaderBytes> head{};
  file.read(entry_.offset, head);
  ByteReader in(head);
  if (in.u32() != 0x04034B50)
    throw FormatError(file.path(), "is damaged: " + inQuotes(entry_.name) + " can't be found");
  in.take(22);
  const std::uint64_t nameBytes = in.u16();
  const std::uint64_t extraBytes = in.u16();
  data_ = entry_.offset + kLocalHeaderBytes + nameBytes + extraBytes;
  if (data_ > file.size() || entry_.packedSize > file.size() - data_)
    throw FormatError(file.path(), "is cut off: " + inQuotes(entry_.name) + " is incomplete");
  if (!entry_.deflated && entry_.packedSize != entry_.size)
    throw FormatError(file.path(), "is damaged: two sizes of " + inQuotes(entry_.name));
  if (entry_.deflated)
    inflated_ =
        std::make_unique<InflatedBytes>(file, data_, entry_.packedSize, Deflate::kRaw, entry_.name);
}

void ZipEntryReader::read(std::span<std::byte> bytes) {
  const auto damaged = [this](const char* what) {
    return FormatError(file_.path(), "is damaged: " + inQuotes(entry_.name) + " " + what);
  };
  if (bytes.size() > entry_.size - position_) throw damaged("ends too early");
  if (inflated_)
    inflated_->read(bytes);
  else
    file_.read(data_ + position_, bytes);
  position_ += bytes.size();
  if (!bytes.empty())
    crc_ = static_cast<std::uint32_t>(
        crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  if (position_ == entry_.size && crc_ != entry_.crc) throw damaged("has a wrong checksum");
}

}  // namespace palpate
