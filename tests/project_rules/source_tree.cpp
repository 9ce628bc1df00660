#include "project_rules/source_tree.h"

#include <algorithm>

#include "testing/testing.h"

namespace palpate::testing {
namespace fs = std::filesystem;
namespace {

std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

}  // namespace

fs::path projectFolder() { return PALPATE_PROJECT_FOLDER; }

std::vector<SourceFile> cppFiles(const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(projectFolder() / folder)) {
      const std::string ending = entry.path().extension();
      if (!entry.is_regular_file() || (ending != ".h" && ending != ".cpp")) continue;
      files.push_back(
          {fs::relative(entry.path(), projectFolder()).generic_string(), readFile(entry.path())});
    }
  }
  std::sort(
      files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::vector<std::string> cellsOf(std::string_view line) {
  std::vector<std::string> cells;
  if (line.size() < 2 || line.front() != '|' || line.back() != '|') return cells;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '|' && line[i - 1] != '\\') {
      cells.push_back(trimmed(cell));
      cell.clear();
    } else {
      cell += line[i];
    }
  }
  return cells;
}

std::vector<std::string> codeWordsOf(std::string_view text) {
  std::vector<std::string> words;
  for (;;) {
    const auto begin = text.find('`');
    if (begin == std::string_view::npos) return words;
    text.remove_prefix(begin + 1);
    const auto end = text.find('`');
    if (end == std::string_view::npos) return words;
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string> sectionOf(std::string_view page, std::string_view title) {
  std::vector<std::string> section;
  bool inside = false;
  for (const std::string& line : linesOf(page)) {
    if (line.starts_with("## "))
      inside = trimmed(std::string_view(line).substr(3)) == title;
    else if (inside)
      section.push_back(line);
  }
  return section;
}

}  // namespace palpate::testing
