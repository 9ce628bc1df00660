#include "recording/import/nested_text.h"

#include "palpate/core/escaped_line.h"
#include "palpate/recording/table_source.h"

#include "recording/import/cell_text.h"

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

}  // namespace

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
