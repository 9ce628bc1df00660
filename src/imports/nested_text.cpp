#include "imports/nested_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/imports/table_source.h"

#include "imports/cell_text.h"

namespace palpate {
namespace {

constexpr std::string_view kOpening = "[({";
constexpr std::string_view kClosing = "])}";

class NestedScanner {
 public:
  NestedScanner(std::string_view text, NestedLine& line) : text_(text), line_(line) {}

  bool scanAll(const std::string& name) {
    return isIn(kOpening) && scanValue(name, 0) && at_ == text_.size();
  }

 private:
  bool isIn(std::string_view letters) const {
    return at_ < text_.size() && letters.find(text_[at_]) != std::string_view::npos;
  }
  void skip(std::string_view letters) {
    while (isIn(letters)) ++at_;
  }
  bool scanValue(const std::string& name, int depth) {
    constexpr int kDeepest = 16;
    if (depth > kDeepest) return false;
    skip(" \t");
    if (isIn("{")) return scanObject(name, depth);
    if (isIn("[(")) return scanList(name, depth);
    std::string_view value;
    if (isIn("\"'")) {
      if (!scanText(value)) return false;
    } else {
      const std::size_t end = std::min(text_.find_first_of(",;]}) \t", at_), text_.size());
      value = text_.substr(at_, end - at_);
      at_ = end;
      if (value.empty()) return false;
      if (value == "null" || value == "None") value = {};
    }
    line_.names.push_back(name);
    line_.values.push_back(value);
    return line_.values.size() <= kMaxNumbersPerRow;
  }
  bool scanText(std::string_view& value) {
    const char quote = text_[at_++];
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != quote) at_ += text_[at_] == '\\' ? 2 : 1;
    if (at_ >= text_.size()) return false;
    value = text_.substr(begin, at_++ - begin);
    return true;
  }
  bool scanList(const std::string& name, int depth) {
    const char closing = kClosing[kOpening.find(text_[at_++])];
    for (std::size_t i = 0;; ++i) {
      skip(" \t,;");
      if (at_ >= text_.size()) return false;
      if (text_[at_] == closing) break;
      if (!scanValue(name + "[" + std::to_string(i) + "]", depth + 1)) return false;
    }
    ++at_;
    return true;
  }
  bool scanObject(const std::string& name, int depth) {
    ++at_;
    while (true) {
      skip(" \t,");
      if (isIn("}")) break;
      std::string_view key;
      if (!isIn("\"'") || !scanText(key)) return false;
      skip(" \t");
      if (!isIn(":")) return false;
      ++at_;
      if (!scanValue((name.empty() ? "" : name + ".") + std::string(key), depth + 1)) return false;
    }
    ++at_;
    return true;
  }

  std::string_view text_;
  NestedLine& line_;
  std::size_t at_ = 0;
};

// What an object of a list is called by, the first of these that tells all of them apart; a text
// unless it is a number by its name.
struct PartKey {
  std::string_view name;
  bool isNumber;
};
constexpr std::array<PartKey, 9> kPartKeys = {{{"matrix_id", true},
                                               {"name", false},
                                               {"matrix", false},
                                               {"sensor", false},
                                               {"pad", false},
                                               {"finger", false},
                                               {"sensor_id", true},
                                               {"pad_id", true},
                                               {"id", true}}};

// The list and the number in front of a place in a name that is behind a ']': "pads" and 1 of
// "pads[1]".
struct ListPlace {
  std::string_view list;
  std::size_t number = 0;
};
std::optional<ListPlace> listPlaceOf(std::string_view name) {
  const auto bracket = name.rfind('[');
  if (!name.ends_with(']') || bracket == std::string_view::npos) return std::nullopt;
  const auto number = parseInteger(name.substr(bracket + 1, name.size() - bracket - 2));
  if (!number) return std::nullopt;
  return ListPlace{name.substr(0, bracket), static_cast<std::size_t>(*number)};
}

std::string_view parentOf(std::string_view name) {
  const auto dot = name.rfind('.');
  return name.substr(0, dot == std::string_view::npos ? 0 : dot);
}

// The names of the parts of a list, by their numbers in it.
using PartNames = std::map<std::size_t, std::string_view>;
using ListNames = std::map<std::string_view, PartNames>;

class PartNaming {
 public:
  explicit PartNaming(NestedLine& line) : line_(line) {}

  void run() {
    findNames();
    if (keyed_.empty() && beside_.empty()) return;
    chooseKeys();
    countBeside();
    NestedLine named;
    for (std::size_t i = 0; i < line_.names.size() && line_.fault.empty(); ++i) {
      if (used_.contains(i)) continue;
      named.names.push_back(nameOf(line_.names[i]));
      named.values.push_back(line_.values[i]);
    }
    if (!line_.fault.empty()) return;
    line_.names = std::move(named.names);
    line_.values = std::move(named.values);
  }

 private:
  struct Keyed {
    std::array<PartNames, kPartKeys.size()> names;
    std::array<std::vector<std::size_t>, kPartKeys.size()> values;  // places in the line
  };

  void findNames() {
    for (std::size_t i = 0; i < line_.names.size(); ++i) {
      const std::string_view name = line_.names[i];
      const std::string_view value = line_.values[i];
      const bool isNumber = parseDouble(value).has_value();
      if (const auto place = listPlaceOf(name)) {
        const std::string_view key = place->list.substr(
            parentOf(place->list).empty() ? 0 : parentOf(place->list).size() + 1);
        if ((key == "name" || key == "names") && !isNumber && !value.empty()) {
          beside_[parentOf(place->list)][place->number] = value;
          nameLists_.insert(place->list);
        }
        continue;
      }
      const auto dot = name.rfind('.');
      if (dot == std::string_view::npos) continue;
      const auto place = listPlaceOf(name.substr(0, dot));
      const auto key = std::find_if(kPartKeys.begin(), kPartKeys.end(), [&](const PartKey& each) {
        return each.name == name.substr(dot + 1) && (each.isNumber || !isNumber);
      });
      if (!place || key == kPartKeys.end()) continue;
      const auto k = static_cast<std::size_t>(key - kPartKeys.begin());
      keyed_[place->list].names[k][place->number] = value;
      keyed_[place->list].values[k].push_back(i);
    }
  }

  // Of each list the first key by which its objects differ.
  void chooseKeys() {
    for (const auto& [list, keyed] : keyed_) {
      std::optional<std::size_t> chosen;
      std::optional<std::size_t> first;
      for (std::size_t k = 0; k < kPartKeys.size() && !chosen; ++k) {
        if (keyed.names[k].empty()) continue;
        if (!first) first = k;
        std::set<std::string_view> different;
        for (const auto& [number, name] : keyed.names[k]) different.insert(name);
        if (different.size() == keyed.names[k].size()) chosen = k;
      }
      if (!chosen) {
        line_.fault = " has parts of " + shortened(list) + " with the same " +
                      std::string(kPartKeys[*first].name);
        return;
      }
      names_[list] = keyed.names[*chosen];
      used_.insert(keyed.values[*chosen].begin(), keyed.values[*chosen].end());
    }
  }

  // Lists beside a list of names belong to it where they are as long.
  void countBeside() {
    std::map<std::string_view, std::size_t> lengths;
    if (beside_.empty()) return;
    for (std::size_t i = 0; i < line_.names.size(); ++i) {
      const std::string_view name = line_.names[i];
      for (auto open = name.find('['); open != std::string_view::npos;
           open = name.find('[', open + 1)) {
        const std::string_view list = name.substr(0, open);
        const auto number = parseInteger(name.substr(open + 1, name.find(']', open) - open - 1));
        if (!number || !beside_.contains(parentOf(list))) continue;
        auto& length = lengths[list];
        length = std::max(length, static_cast<std::size_t>(*number) + 1);
        if (nameLists_.contains(list)) used_.insert(i);
      }
    }
    for (const auto& [list, length] : lengths) {
      const PartNames& names = beside_[parentOf(list)];
      if (names.size() != length || nameLists_.contains(list)) continue;
      std::set<std::string_view> different;
      for (const auto& [number, name] : names) different.insert(name);
      if (different.size() != length)
        line_.fault = " names two parts of " + shortened(list) + " the same";
      names_[list] = names;
    }
  }

  std::string nameOf(std::string_view name) {
    std::string made;
    std::size_t done = 0;
    for (auto open = name.find('['); open != std::string_view::npos;
         open = name.find('[', open + 1)) {
      const auto names = names_.find(name.substr(0, open));
      const auto close = name.find(']', open);
      if (names == names_.end() || close == std::string_view::npos) continue;
      const auto number = parseInteger(name.substr(open + 1, close - open - 1));
      const auto part =
          number ? names->second.find(static_cast<std::size_t>(*number)) : names->second.end();
      if (part == names->second.end() || part->second.empty()) {
        line_.fault = " has a part of " + shortened(names->first) + " without a name";
        return {};
      }
      // A text in brackets would be a unit.
      const bool isNumber = parseInteger(part->second).has_value();
      made.append(name, done, open - done).append(isNumber ? "[" : ".").append(part->second);
      done = isNumber ? close : close + 1;
    }
    return made.append(name, done);
  }

  NestedLine& line_;
  std::map<std::string_view, Keyed> keyed_;  // by list of objects
  ListNames beside_;                         // by what holds the list of names and others
  std::set<std::string_view> nameLists_;
  ListNames names_;             // by list
  std::set<std::size_t> used_;  // values that are names
};

}  // namespace

void useGivenNames(NestedLine& line) { PartNaming(line).run(); }

bool flattenNested(std::string_view text, const std::string& name, NestedLine& line) {
  return NestedScanner(text, line).scanAll(name);
}

void splitNestedCells(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  std::size_t begin = 0;
  int depth = 0;
  bool isQuoted = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char letter = line[at];
    if (letter == '"') isQuoted = !isQuoted;
    if (isQuoted) continue;
    if (kOpening.find(letter) != std::string_view::npos) ++depth;
    if (kClosing.find(letter) != std::string_view::npos) --depth;
    if (letter != delimiter || depth > 0) continue;
    cells.push_back(line.substr(begin, at - begin));
    begin = at + 1;
  }
  cells.push_back(line.substr(begin));
}

bool isNestedText(std::string_view cell) {
  cell = trimmedCell(cell);
  const auto opening = cell.size() < 2 ? std::string_view::npos : kOpening.find(cell.front());
  return opening != std::string_view::npos && cell.back() == kClosing[opening];
}

}  // namespace palpate
