// Converts numbers to text and back, the same in every locale: '.' as decimal point, and the
// shortest text that reads back as the same number.
#pragma once

#include <cstdint>
#include <optional>
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

}  // namespace palpate
