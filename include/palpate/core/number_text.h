// Converts numbers to text and back, the same in every locale: '.' as decimal point, and the
// shortest text that reads back as the same number. Also counts with their noun and hexadecimal
// digits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace palpate {

// Returns the shortest text that reads back as the same value; "nan", "inf" or "-inf" for values
// that are not finite.
std::string numberText(double value);
std::string numberText(float value);
// Returns a text with a fixed number of decimals (0..17), for example fixedText(3.14159, 2) =
// "3.14"; never "-0.00".
std::string fixedText(double value, int decimals);
// Appends the shortest text of `value` to `out`; used for long tables.
void appendNumber(std::string& out, double value);
void appendNumber(std::string& out, float value);
void appendNumber(std::string& out, std::int64_t value);

// Reads the whole `text` as a number; blanks around it are allowed, a leading + is not. Returns
// nothing when `text` is not a number, has other characters after it, is NaN or infinite, or when
// the number does not fit.
std::optional<double> parseDouble(std::string_view text) noexcept;
std::optional<std::int64_t> parseInteger(std::string_view text) noexcept;

// A count with its noun: "1 frame", "2 frames".
inline std::string counted(std::uint64_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

// The letters of hexadecimal digits.
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
