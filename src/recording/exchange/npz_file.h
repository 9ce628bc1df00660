// The files that NumPy reads: a zip file of arrays (numpy.lib.format). Private to this module.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/byte_order.h"
#include "palpate/core/output_file.h"

namespace palpate {

// A zip file without compression, of named pieces, with 64-bit sizes where they are needed.
class ZipWriter {
 public:
  explicit ZipWriter(OutputFile& out) : out_(out) {}
  // Pieces one after the other: begin(), write() exactly `size` bytes in total, end(). The checksum
  // follows the bytes, so they need not be known beforehand.
  void begin(std::string_view name, std::uint64_t size);
  void write(std::string_view bytes);
  void end();
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

// One array, filled number by number in little-endian form.
class NpyArray {
 public:
  // `type` as NumPy names it ("<i8"), of `bytesPerNumber` bytes.
  NpyArray(ZipWriter& zip,
           const std::string& name,
           const std::string& type,
           std::size_t bytesPerNumber,
           const std::vector<std::size_t>& shape);
  void u8(std::uint64_t value) { put(value, 1); }
  void u16(std::uint64_t value) { put(value, 2); }
  void u32(std::uint64_t value) { put(value, 4); }
  void i64(std::int64_t value) { put(static_cast<std::uint64_t>(value), 8); }
  void f32(float value) { put(std::bit_cast<std::uint32_t>(value), 4); }
  void f64(double value) { put(std::bit_cast<std::uint64_t>(value), 8); }
  void end() {
    flush();
    zip_.end();
  }

 private:
  static constexpr std::size_t kPieceBytes = 1u << 16;

  void put(std::uint64_t value, int bytes) {
    appendLittleEndian(buffer_, value, bytes);
    if (buffer_.size() >= kPieceBytes) flush();
  }
  void flush() {
    zip_.write(buffer_);
    buffer_.clear();
  }

  ZipWriter& zip_;
  std::string buffer_;
};

// A text as a NumPy array of no dimension: UTF-32 code points, so that no pickle is needed.
void writeNpyText(ZipWriter& zip, const std::string& name, const std::string& ascii);

}  // namespace palpate
