// The files of the project as text, for tests that read the project itself.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::testing {

struct SourceFile {
  std::string path;  // from the top of the project, with '/'
  std::string text;
};

// The top of the project that these tests were built from.
std::filesystem::path projectFolder();
// C++ headers and sources below `folders` (from the top), sorted by path.
std::vector<SourceFile> cppFiles(const std::vector<std::string>& folders);

std::vector<std::string> linesOf(std::string_view text);
// A Markdown table row's cells, without blanks around; nothing when the line is no row.
std::vector<std::string> cellsOf(std::string_view line);
// All `words` in backticks.
std::vector<std::string> codeWordsOf(std::string_view text);
// The lines of a Markdown page below "## TITLE" up to the next "## ".
std::vector<std::string> sectionOf(std::string_view page, std::string_view title);

}  // namespace palpate::testing
