#include "palpate/core/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

template <typename Number>
void append(std::string& out, Number value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  out.append(text, end);
}

template <typename Number>
std::optional<Number> parsed(std::string_view text) noexcept {
  text = trimmed(text, " \t\r\n");
  Number value{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void appendNumber(std::string& out, double value) { append(out, value); }
void appendNumber(std::string& out, float value) { append(out, value); }
void appendNumber(std::string& out, std::int64_t value) { append(out, value); }

std::string numberText(double value) {
  std::string out;
  append(out, value);
  return out;
}

std::string numberText(float value) {
  std::string out;
  append(out, value);
  return out;
}

std::string fixedText(double value, int decimals) {
  char text[400];  // 309 digits before the point, 17 after
  const auto end =
      std::to_chars(
          text, text + sizeof text, value, std::chars_format::fixed, std::clamp(decimals, 0, 17))
          .ptr;
  std::string out(text, end);
  // A value that is rounded to zero has no sign.
  if (out.starts_with('-') && out.find_first_of("123456789") == std::string::npos &&
      std::isfinite(value))
    out.erase(0, 1);
  return out;
}

std::optional<double> parseDouble(std::string_view text) noexcept {
  const auto value = parsed<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parseInteger(std::string_view text) noexcept {
  return parsed<std::int64_t>(text);
}

}  // namespace palpate
