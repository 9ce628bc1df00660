// docs/manual/columns.md defines every column that a table of the analysis prints; the pages that
// the program prints are up to date.
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "commands/palpate_program.h"

namespace palpate::column_docs_test {
namespace {

using testing::palpate;

// "m1_T02" and "angle_5" as the manual writes them: "mM_Tpq", "angle_N".
std::string writtenName(std::string name) {
  static const std::vector<std::pair<std::regex, std::string>> kForms = {
      {std::regex("^m[0-9]+_T[0-9]+$"), "mM_Tpq"},
      {std::regex("^m[0-9]+_"), "mM_"},
      {std::regex("^angle_[0-9]+$"), "angle_N"},
      {std::regex("^std_[0-9]+$"), "std_M"}};
  for (const auto& [form, written] : kForms) name = std::regex_replace(name, form, written);
  return name;
}

// analyst M9, m5
TEST(ColumnDocs, EveryColumnIsDefinedInItsSection) {
  const std::string recording = testing::dataFolder() / "demo_grasps.dsa";
  const std::string page =
      testing::readFile(testing::dataFolder().parent_path() / "docs/manual/columns.md");
  const std::vector<std::vector<std::string>> tables = {{"signals"},
                                                        {"slip"},
                                                        {"slip", "--segments"},
                                                        {"contact"},
                                                        {"contact", "--matrices"},
                                                        {"contact", "--size"},
                                                        {"grasps"},
                                                        {"labels"},
                                                        {"features", "--set", "best"},
                                                        {"features", "--set", "session"},
                                                        {"features", "--set", "statistics"},
                                                        {"features", "--set", "study"}};
  for (std::vector<std::string> words : tables) {
    const std::string head = "\n## " + words.front() + "\n";
    const auto begin = page.find(head);
    ASSERT_NE(begin, std::string::npos) << words.front();
    const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
    words.push_back(recording);
    const auto result = palpate(words);
    std::istringstream header(result.out.substr(0, result.out.find('\n')));
    std::size_t columns = 0;
    for (std::string name; std::getline(header, name, ','); ++columns)
      EXPECT_NE(section.find("`" + writtenName(name) + "`"), std::string::npos)
          << "docs/manual/columns.md does not define " << name << " of " << words.front();
    EXPECT_GT(columns, 4u) << words.front() << ": " << result.err;
  }
}

TEST(ColumnDocs, ThePageOfColumnsIsWhatTheProgramPrints) {
  const auto printed = palpate({"help", "columns"});
  ASSERT_EQ(printed.exitCode, 0) << printed.err;
  EXPECT_EQ(testing::readFile(testing::dataFolder().parent_path() / "docs/manual/tables.md"),
            printed.out)
      << "make it again: palpate help columns > docs/manual/tables.md";
}

TEST(ColumnDocs, ThePageOfOptionsIsWhatTheProgramPrints) {
  const auto printed = palpate({"help", "commands"});
  ASSERT_EQ(printed.exitCode, 0) << printed.err;
  EXPECT_NE(printed.out.find("\n## calibrate tare\n"), std::string::npos);
  EXPECT_EQ(testing::readFile(testing::dataFolder().parent_path() / "docs/manual/options.md"),
            printed.out)
      << "make it again: palpate help commands > docs/manual/options.md";
}

// Every column says what it means, and a number with a unit in its name has that unit.
TEST(ColumnDocs, EveryColumnHasAMeaningAndItsUnit) {
  const auto printed = palpate({"help", "columns"});
  std::istringstream lines(printed.out);
  const std::map<std::string, std::string> units = {{"_mm", "mm"},
                                                    {"_s", "s"},
                                                    {"_ms", "ms"},
                                                    {"_deg", "deg"},
                                                    {"_hz", "Hz"},
                                                    {"_n", "N"},
                                                    {"_kpa", "kPa"}};
  const std::regex row("\\| `(.*)` \\| (.*) \\| (integer|number|flag|text) \\| (.*) \\|");
  std::size_t columns = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    ++columns;
    EXPECT_FALSE(cells[4].str().empty()) << line;
    for (const auto& [ending, unit] : units) {
      if (cells[1].str().ends_with(ending)) {
        EXPECT_EQ(cells[2], unit) << line;
      }
    }
  }
  EXPECT_GT(columns, 250u);
}

}  // namespace
}  // namespace palpate::column_docs_test
