// One cell of a text: what it holds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/imports/table_source.h"

namespace palpate {

inline std::string smallLetters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return small;
}

// A cell without blanks and quotes around it.
inline std::string_view trimmedCell(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

// The number in a cell, finite or not; nothing when it is a text.
inline std::optional<double> cellNumber(std::string_view cell, char decimal) {
  cell = trimmedCell(cell);
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  if (decimal != '.') {
    constexpr std::size_t kLongestNumber = 64;
    const auto comma = cell.find(decimal);
    if (cell.find('.') != std::string_view::npos) return std::nullopt;
    if (comma != std::string_view::npos && cell.size() <= kLongestNumber) {
      std::string pointed(cell);
      pointed[comma] = '.';
      return parseDouble(pointed);
    }
  }
  if (const auto number = parseDouble(cell)) return number;
  // Fortran's double precision: 1.0D+02.
  constexpr std::size_t kLongestFortran = 40;
  const auto exponent = cell.find_first_of("Dd");
  if (exponent == std::string_view::npos || cell.find('.') > exponent ||
      cell.size() > kLongestFortran ||
      cell.find_first_not_of("0123456789+-.Dd") != std::string_view::npos)
    return std::nullopt;
  std::string usual(cell);
  usual[exponent] = 'e';
  return parseDouble(usual);
}

// Whether a number with one comma may have it after its thousands: "1,010".
inline bool mayBeThousands(std::string_view cell) {
  cell = trimmedCell(cell);
  const auto comma = cell.find(',');
  return comma >= 1 && comma <= 3 && cell.size() == comma + 4 && cell[0] != '0' &&
         cell.find_first_not_of("0123456789,") == std::string_view::npos;
}

// A hint at what a cell with a comma is, for messages; empty for others.
inline std::string commaHint(std::string_view cell) {
  if (!cellNumber(cell, ',')) return {};
  return mayBeThousands(cell) ? " (a comma of thousands, or a decimal comma?)"
                              : " (a decimal comma?)";
}

// What a text stands for: "not a number" or infinity; nothing for another text.
inline std::optional<double> notFiniteValue(std::string_view cell) {
  std::string word = smallLetters(trimmedCell(cell));
  if (word.starts_with('-') || word.starts_with('+')) word.erase(0, 1);
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (word == "inf" || word == "infinity") return std::numeric_limits<double>::infinity();
  return std::nullopt;
}

// Whether a float can hold a value.
inline bool fitsFloat(double value) {
  return std::isfinite(value) &&
         std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

inline CellState cellStateOf(std::string_view cell, char decimal, double& value) {
  cell = trimmedCell(cell);
  value = 0.0;
  if (cell.empty()) return CellState::kEmpty;
  if (const auto number = cellNumber(cell, decimal)) {
    value = *number;
    return fitsFloat(value) ? CellState::kNumber : CellState::kNotFinite;
  }
  const auto notFinite = notFiniteValue(cell);
  value = notFinite.value_or(0.0);
  return notFinite ? CellState::kNotFinite : CellState::kText;
}

}  // namespace palpate
