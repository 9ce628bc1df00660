// Writes numbers and bytes as hexadecimal digits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace palpate {

enum class HexLetters { kCapital, kSmall };

// Appends the `count` lowest hexadecimal digits of `value` (1..16), the highest digit first.
inline void appendHexDigits(std::string& out,
                            std::uint64_t value,
                            int count,
                            HexLetters letters = HexLetters::kCapital) {
  const char* digits = letters == HexLetters::kCapital ? "0123456789ABCDEF" : "0123456789abcdef";
  for (int shift = 4 * (count - 1); shift >= 0; shift -= 4) out += digits[value >> shift & 0xF];
}

inline std::string hexDigits(std::uint64_t value, int count) {
  std::string text;
  appendHexDigits(text, value, count);
  return text;
}

// Returns two digits per byte.
inline std::string hexDigits(std::span<const std::byte> bytes,
                             HexLetters letters = HexLetters::kCapital) {
  std::string text;
  for (const std::byte byte : bytes)
    appendHexDigits(text, std::to_integer<std::uint64_t>(byte), 2, letters);
  return text;
}

}  // namespace palpate
