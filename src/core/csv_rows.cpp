#include "palpate/core/csv_rows.h"

#include "palpate/core/error.h"

namespace palpate {

std::string quotedCell(std::string_view cell) {
  constexpr std::size_t kMaximumBytes = 100;
  if (cell.size() <= kMaximumBytes) return "'" + std::string(cell) + "'";
  std::size_t end = kMaximumBytes;
  // Not within a letter of several bytes.
  while (end > 0 && (static_cast<unsigned char>(cell[end]) & 0xC0u) == 0x80u) --end;
  return "'" + std::string(cell.substr(0, end)) + "...'";
}

CsvRows::CsvRows(std::string_view csv) : rest_(csv) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  const std::string_view first = rest_.substr(0, rest_.find('\n'));
  for (const char delimiter : {'\t', ';', ','})
    if (first.find(delimiter) != std::string_view::npos) delimiter_ = delimiter;
}

bool CsvRows::next(std::vector<std::string>& cells) {
  do {
    if (rest_.empty()) return false;
    line_ = nextLine_;
    readRow(cells);
  } while (cells.size() == 1 && cells[0].empty());
  return true;
}

void CsvRows::readRow(std::vector<std::string>& cells) {
  cells.assign(1, {});
  bool quoted = false;
  std::size_t i = 0;
  for (; i < rest_.size(); ++i) {
    const char c = rest_[i];
    if (c == '\n') ++nextLine_;
    if (quoted) {
      if (c != '"')
        cells.back() += c;
      else if (i + 1 < rest_.size() && rest_[i + 1] == '"')
        cells.back() += rest_[++i];
      else
        quoted = false;
    } else if (c == '"' && cells.back().empty()) {
      quoted = true;
    } else if (c == delimiter_) {
      if (cells.size() == kMaximumCells)
        throw Error("line " + std::to_string(line_) + " has more than " +
                    std::to_string(kMaximumCells) + " cells");
      cells.emplace_back();
    } else if (c == '\n') {
      ++i;
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  unclosed_ = quoted;
  rest_.remove_prefix(i);
}

}  // namespace palpate
