// Columns by the words of their names, and their shapes. Private to this module.
#pragma once

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/imports/table_source.h"

#include "imports/cell_text.h"

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

// The words of a name in their order, in small letters, also apart where the case changes or a
// number begins: "leftPad_12" has left, pad, 12.
inline std::vector<std::string> nameParts(std::string_view name) {
  const auto kindOf = [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return std::isdigit(byte) != 0                   ? '0'
           : std::isupper(byte) != 0                 ? 'A'
           : std::isalpha(byte) != 0 || byte >= 0x80 ? 'a'
                                                     : ' ';
  };
  std::vector<std::string> parts;
  char last = ' ';
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char kind = kindOf(name[i]);
    const char next = i + 1 < name.size() ? kindOf(name[i + 1]) : ' ';
    const bool goesOn = kind == last || (last == 'A' && kind == 'a');
    const bool beginsWord = last == 'A' && kind == 'A' && next == 'a';  // "RPad"
    if (kind != ' ' && (!goesOn || beginsWord)) parts.emplace_back();
    if (kind != ' ') parts.back() += smallLetters(name.substr(i, 1));
    last = kind;
  }
  return parts;
}

// Words as one text, to compare: "leftpad12" of "left pad 12" and "LeftPad12"; numbers stay apart.
inline std::string joinedParts(const std::vector<std::string>& parts,
                               std::size_t begin,
                               std::size_t end) {
  std::string joined;
  for (std::size_t i = begin; i < end; ++i) {
    if (!joined.empty() && std::isdigit(static_cast<unsigned char>(joined.back())) != 0 &&
        std::isdigit(static_cast<unsigned char>(parts[i][0])) != 0)
      joined += '_';
    joined += parts[i];
  }
  return joined;
}
inline std::string nameKey(std::string_view name) {
  const auto parts = nameParts(name);
  return joinedParts(parts, 0, parts.size());
}

// Names by which one of several things is called, as nameKey() of each. A number alone names
// nothing.
using NameKeys = std::map<std::string, std::size_t, std::less<>>;
inline void addName(NameKeys& keys, std::string_view name, std::size_t thing) {
  std::string key = nameKey(name);
  if (key.find_first_not_of("0123456789_") != std::string::npos)
    keys.try_emplace(std::move(key), thing);
}

// Which of several things a text names, by the words of its name: the longest name that is in the
// text, of several the first one.
inline std::optional<std::size_t> namedIn(std::string_view text, const NameKeys& keys) {
  constexpr std::size_t kMaxParts = 32;
  std::optional<std::size_t> found;
  std::size_t length = 0;
  auto parts = nameParts(text);
  if (parts.size() > kMaxParts) parts.resize(kMaxParts);
  for (std::size_t begin = 0; begin < parts.size(); ++begin)
    for (std::size_t end = begin + 1; end <= parts.size(); ++end) {
      const auto named = keys.find(joinedParts(parts, begin, end));
      if (named == keys.end() || named->first.size() <= length) continue;
      found = named->second;
      length = named->first.size();
    }
  return found;
}

inline bool isScalar(const TableColumn& column) { return column.shape.empty(); }

// Whether its numbers may be values.
inline bool holdsNumbers(const TableColumn& column) {
  return column.isNumeric && column.type != "bool";
}

inline bool sameRows(const TableColumn& first, const TableColumn& second) {
  return !first.numRows || !second.numRows || first.numRows == second.numRows;
}

// Of columns that count rows or say which taxels are active.
inline const std::set<std::string> kCounterWords = {
    "active", "mask", "index", "file", "frame", "sample", "seq", "sequence", "counter"};
inline const std::set<std::string> kAngleWords = {
    "angle", "angles", "axis", "axes", "joint", "joints", "q"};
// Of what was measured, where other columns are of the same joint.
inline const std::set<std::string> kMeasuredWords = {
    "position", "positions", "pos", "actual", "measured", "present", "angle", "angles"};
// Of a joint or a sensor, but not its position or temperature.
inline const std::set<std::string> kOtherQuantityWords = {
    "velocity", "velocities", "vel",     "speed",    "speeds",   "acceleration", "accelerations",
    "acc",      "accel",      "effort",  "efforts",  "torque",   "torques",      "tau",
    "force",    "forces",     "current", "currents", "voltage",  "power",        "load",
    "target",   "targets",    "goal",    "command",  "commands", "commanded",    "cmd",
    "desired",  "setpoint",   "error",   "dq",       "qd",       "qdot",         "limit"};
inline const std::set<std::string> kTemperatureWords = {
    "temperature", "temperatures", "temp", "temps", "degc", "celsius"};

}  // namespace palpate
