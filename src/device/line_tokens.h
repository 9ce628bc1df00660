// The pieces of a line of numbers: blanks, separators, words and numbers.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>

namespace palpate::line_tokens {

inline bool isBlank(char c) { return c == ' ' || c == '\t'; }
inline bool isSeparator(char c) { return c == ',' || c == ';' || isBlank(c); }
inline bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

inline const char* skipBlanks(const char* at, const char* end) {
  while (at != end && isBlank(*at)) ++at;
  return at;
}

inline std::string_view tokenAt(const char* at, const char* end) {
  const char* stop = at;
  while (stop != end && !isSeparator(*stop)) ++stop;
  return {at, static_cast<std::size_t>(stop - at)};
}

// Reads a number at `at`; returns its end, or null when there is none.
inline const char* readNumber(const char* at, const char* end, double& value) {
  // Most values are whole numbers of few digits.
  const char* digit = at;
  std::uint32_t whole = 0;
  while (digit != end && digit - at < 9 && *digit >= '0' && *digit <= '9')
    whole = whole * 10 + static_cast<std::uint32_t>(*digit++ - '0');
  if (digit != at && (digit == end || isSeparator(*digit))) {
    value = whole;
    return digit;
  }
  if (at != end && *at == '+' && end - at > 1 && at[1] != '-') ++at;
  const auto [stop, failure] = std::from_chars(at, end, value);
  if (failure == std::errc::result_out_of_range) {
    // Too small is 0, too large is infinite, which is out of the range of values.
    const std::string_view text(at, static_cast<std::size_t>(stop - at));
    const std::size_t exponent = text.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos && exponent + 1 < text.size() &&
                      text[exponent + 1] == '-';
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  } else if (failure != std::errc()) {
    return nullptr;
  }
  return stop == end || isSeparator(*stop) ? stop : nullptr;
}

}  // namespace palpate::line_tokens
