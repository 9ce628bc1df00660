#include "palpate/core/text_table.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

constexpr std::size_t kRowsPerPiece = 4096;  // rows between two reports of progress

// Control characters would reach the terminal that shows the table; a cell may have tabs and line
// breaks, nothing else.
std::string withoutControls(const std::string& cell) {
  constexpr unsigned char kDelete = 0x7F;
  std::string safe;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const auto byte = static_cast<unsigned char>(cell[i]);
    const auto next = i + 1 < cell.size() ? static_cast<unsigned char>(cell[i + 1]) : 0;
    const bool isLater = byte == 0xC2 && next >= 0x80 && next <= 0x9F;  // U+0080 to U+009F
    const bool isBreak = byte == '\n' || byte == '\t' || (byte == '\r' && next == '\n');
    if (isLater || (byte < ' ' && !isBreak) || byte == kDelete)
      safe += escapedLine(std::string_view(cell).substr(i, isLater ? 2 : 1));
    else
      safe += cell[i];
    if (isLater) ++i;
  }
  return safe;
}

void appendCsv(const std::vector<std::string>& cells, std::string& out) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += ',';
    const std::string cell = withoutControls(cells[i]);
    if (cell.find_first_of(",\"\r\n") == std::string::npos) {
      out += cell;
      continue;
    }
    out += '"';
    for (const char letter : cell) {
      if (letter == '"') out += '"';
      out += letter;
    }
    out += '"';
  }
  out += '\n';
}

void appendTabbed(const std::vector<std::string>& cells, std::string& out) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += '\t';
    for (const char letter : cells[i])
      out += letter == '\t' || letter == '\n' || letter == '\r' ? ' ' : letter;
  }
  out += '\n';
}

std::vector<std::string> checkedRow(const TextTable& table, std::size_t row) {
  std::vector<std::string> cells = table.row(row);
  if (cells.size() != table.header.size())
    throw std::invalid_argument("row " + std::to_string(row) + " has " +
                                std::to_string(cells.size()) + " cells, the header " +
                                std::to_string(table.header.size()));
  return cells;
}

std::string text(const TextTable& table,
                 std::size_t maxRows,
                 void (*append)(const std::vector<std::string>&, std::string&)) {
  std::string out;
  append(table.header, out);
  for (std::size_t row = 0; row < std::min(table.numRows, maxRows); ++row)
    append(checkedRow(table, row), out);
  return out;
}

}  // namespace

std::string csvLine(const std::vector<std::string>& cells) {
  std::string out;
  appendCsv(cells, out);
  return out;
}

void writeTable(const TextTable& table,
                const std::filesystem::path& path,
                Overwrite overwrite,
                const Progress& progress) {
  OutputFile file(path, overwrite);
  std::string piece = csvLine(table.header);
  for (std::size_t row = 0; row < table.numRows; ++row) {
    appendCsv(checkedRow(table, row), piece);
    if ((row + 1) % kRowsPerPiece != 0) continue;
    file.write(piece);
    piece.clear();
    const double fraction = static_cast<double>(row + 1) / static_cast<double>(table.numRows);
    if (progress && !progress(fraction)) throw Cancelled();
  }
  file.write(piece);
  if (progress && !progress(1.0)) throw Cancelled();
  file.commit();
}

std::string csvText(const TextTable& table, std::size_t maxRows) {
  return text(table, maxRows, &appendCsv);
}

std::string tabbedText(const TextTable& table, std::size_t maxRows) {
  return text(table, maxRows, &appendTabbed);
}

}  // namespace palpate
