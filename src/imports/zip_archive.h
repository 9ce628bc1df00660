// Reads the files in a zip archive, stored or deflated, also those with 64-bit sizes (PKWARE
// APPNOTE.TXT 6.3). Only what NumPy's .npz files need: no encryption, no parts on several disks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "imports/inflated_bytes.h"
#include "imports/random_reader.h"

namespace palpate {

struct ZipEntry {
  std::string name;
  std::uint64_t size = 0;        // [bytes], decompressed
  std::uint64_t packedSize = 0;  // [bytes] in the archive
  std::uint64_t offset = 0;      // of its local header
  std::uint32_t crc = 0;
  bool deflated = false;
};

// Returns the entries of the directory at the end of an archive. Throws FormatError: cut off, too
// many, of an unknown form.
std::vector<ZipEntry> readZipDirectory(const RandomReader& file);

// Reads the content of one entry from its beginning to its end. At the end it compares the
// checksum.
class ZipEntryReader final : public SequentialReader {
 public:
  // `file` must outlive this object. Throws FormatError.
  ZipEntryReader(const RandomReader& file, ZipEntry entry);
  // Throws FormatError: the content ends before, is damaged, or its checksum differs.
  void read(std::span<std::byte> bytes) override;
  std::uint64_t position() const noexcept { return position_; }

 private:
  const RandomReader& file_;
  ZipEntry entry_;
  std::uint64_t data_ = 0;  // where the content begins in the file
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;
  std::unique_ptr<InflatedBytes> inflated_;  // null: stored
};

}  // namespace palpate
