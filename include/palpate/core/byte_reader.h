// A bounds-checked cursor over little-endian bytes, for readers of packets and files. Reading past
// the end accesses no memory: it sets a failure that remains and returns zero, so that a parser
// needs only one check, at its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <palpate/core/byte_order.h>

namespace palpate {

// Reads numbers one after the other from bytes.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  std::uint8_t u8() noexcept { return static_cast<std::uint8_t>(little(1)); }
  std::uint16_t u16() noexcept { return static_cast<std::uint16_t>(little(2)); }
  std::uint32_t u32() noexcept { return static_cast<std::uint32_t>(little(4)); }
  std::uint64_t u64() noexcept { return little(8); }
  std::int64_t i64() noexcept { return static_cast<std::int64_t>(little(8)); }
  float f32() noexcept;   // IEEE 754 binary32
  double f64() noexcept;  // IEEE 754 binary64
  // Returns the next `count` bytes. When fewer are left, it returns none and sets the failure.
  std::span<const std::byte> take(std::size_t count) noexcept;

  std::size_t position() const noexcept { return position_; }
  std::size_t remaining() const noexcept { return bytes_.size() - position_; }
  // Returns false after an attempt to read past the end.
  bool ok() const noexcept { return !failed_; }

 private:
  // Inline for speed, because frames are decoded unit by unit.
  std::uint64_t little(std::size_t count) noexcept {
    if (failed_ || count > remaining()) {
      failed_ = true;
      return 0;
    }
    const std::uint64_t value = littleEndian(bytes_.subspan(position_, count));
    position_ += count;
    return value;
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool failed_ = false;
};

}  // namespace palpate
