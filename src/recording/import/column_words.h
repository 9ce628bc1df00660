// Columns by the words of their names, and their shapes. Private to this module.
#pragma once

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/recording/table_source.h"

#include "recording/import/cell_text.h"

namespace palpate {

// The words of a name, in small letters: "fingerTip_3.angle [deg]" has fingertip, angle, deg.
inline std::set<std::string> wordsOf(std::string_view name) {
  std::set<std::string> words;
  std::string word;
  for (const char letter : std::string(name) + " ") {
    if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
      word += smallLetters(std::string_view(&letter, 1));
    } else if (!word.empty()) {
      words.insert(std::exchange(word, {}));
    }
  }
  return words;
}

inline bool hasWord(const TableColumn& column, const std::set<std::string>& wanted) {
  const auto words = wordsOf(column.name);
  return std::any_of(
      words.begin(), words.end(), [&](const std::string& word) { return wanted.contains(word); });
}

inline bool isScalar(const TableColumn& column) { return column.shape.empty(); }

inline bool sameRows(const TableColumn& first, const TableColumn& second) {
  return !first.numRows || !second.numRows || first.numRows == second.numRows;
}

inline const std::set<std::string> kAngleWords = {
    "angle", "angles", "axis", "axes", "joint", "joints", "q"};
inline const std::set<std::string> kTemperatureWords = {
    "temperature", "temperatures", "temp", "temps", "degc", "celsius"};

}  // namespace palpate
