// A zip file without compression, of named pieces, with 64-bit sizes where they are needed. Private
// to this module (NPZ files).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/output_file.h"

namespace palpate {

class ZipWriter {
 public:
  explicit ZipWriter(OutputFile& out) : out_(out) {}
  // Pieces one after the other: begin(), write() exactly `size` bytes in total, end(). The checksum
  // follows the bytes, so they need not be known beforehand.
  void begin(std::string_view name, std::uint64_t size);
  void write(std::string_view bytes);
  void end();
  // A whole piece at once.
  void add(std::string_view name, std::string_view bytes);
  void finish();  // the directory

 private:
  struct Entry {
    std::string name;
    std::uint64_t size = 0;
    std::uint64_t offset = 0;
    std::uint32_t crc = 0;
  };
  void put(const std::string& bytes);

  OutputFile& out_;
  std::vector<Entry> entries_;
  std::uint64_t position_ = 0;
};

}  // namespace palpate
