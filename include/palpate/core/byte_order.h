// Converts bytes in either order to numbers; core/byte_writer.h converts numbers to bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace palpate {

// Converts at most 8 bytes, the lowest first.
constexpr std::uint64_t littleEndian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i)
    value = value << 8 | std::to_integer<std::uint64_t>(bytes[i - 1]);
  return value;
}

// Converts at most 8 bytes, the highest first.
constexpr std::uint64_t bigEndian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (const std::byte byte : bytes) value = value << 8 | std::to_integer<std::uint64_t>(byte);
  return value;
}

}  // namespace palpate
