// Numbers as text and back, the same in every locale: '.' decimals, shortest form that reads back
// to the same number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace palpate {

// Shortest text that reads back as the same value; "nan", "inf", "-inf" for what is no number.
std::string numberText(double value);
std::string numberText(float value);
// Fixed number of decimals (0..17), e.g. fixedText(3.14159, 2) = "3.14"; never "-0.00".
std::string fixedText(double value, int decimals);
// Appends the shortest text of `value` to `out`: for long tables.
void appendNumber(std::string& out, double value);
void appendNumber(std::string& out, float value);
void appendNumber(std::string& out, std::int64_t value);

// The whole of `text` as a number (blanks around it allowed, a leading + not); nothing when it
// isn't one, has trailing characters, or doesn't fit. Accepts no NaN and no infinity.
std::optional<double> parseDouble(std::string_view text) noexcept;
std::optional<std::int64_t> parseInteger(std::string_view text) noexcept;

}  // namespace palpate
