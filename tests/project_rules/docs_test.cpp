// The manual agrees with itself and with the program: links, pictures, commands, options, docks;
// and what it shows runs.
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::docs_test {
namespace {
namespace fs = std::filesystem;

// The pages at the top and docs/**/*.md, by path from the top.
const std::map<std::string, std::string>& pages() {
  static const auto all = [] {
    std::map<std::string, std::string> found;
    for (const char* name : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md"})
      found[name] = readFile(projectFolder() / name);
    for (const auto& entry : fs::recursive_directory_iterator(projectFolder() / "docs"))
      if (entry.path().extension() == ".md")
        found[fs::relative(entry.path(), projectFolder()).generic_string()] =
            readFile(entry.path());
    return found;
  }();
  return all;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
    found.push_back((*at)[at->size() > 1 ? 1 : 0].str());
  return found;
}

// As GitHub names the place of a heading.
std::string anchorOf(std::string heading) {
  std::string anchor;
  for (const char letter : heading)
    if (letter == ' ')
      anchor += '-';
    else if (std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return anchor;
}

std::set<std::string> anchorsOf(const std::string& page) {
  std::set<std::string> anchors;
  for (const std::string& line : linesOf(page))
    if (line.starts_with("#")) anchors.insert(anchorOf(line.substr(line.find_first_not_of("# "))));
  return anchors;
}

// What stands as code: words in backticks, and indented lines.
std::vector<std::string> codesOf(const std::string& page) {
  std::vector<std::string> codes;
  for (const std::string& line : linesOf(page)) {
    if (line.starts_with("    ")) codes.push_back(line.substr(4));
    for (const std::string& code : codeWordsOf(line)) codes.push_back(code);
  }
  return codes;
}

// A call of the program as a page writes it: the words behind `palpate` or `scripts/run`; nothing
// where it is none.
std::optional<std::vector<std::string>> callIn(const std::string& code) {
  std::smatch match;
  if (!std::regex_match(
          code,
          match,
          std::regex("(?:[A-Z_]+=\\S* )*(?:time )?(?:palpate|scripts/run) +([^#>&]*).*")))
    return std::nullopt;
  std::istringstream text(match[1].str());
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

std::set<std::string> optionsIn(const std::string& text) {
  const auto found = matches(text, "(?:^|[^-a-zA-Z0-9])(--[a-z][-a-z0-9]*)");
  return {found.begin(), found.end()};
}

class Docs : public ::testing::Test {
 protected:
  void SetUp() override {
    if (program_.empty()) GTEST_SKIP() << "built without the program (PALPATE_APPS=OFF)";
    if (!commands_.empty()) return;
    const std::string help = run({"--help"});
    const std::string list = help.substr(help.find("\nCommands:\n"));
    for (const std::string& name : matches(list, "\n  ([a-z][a-z-]*) ")) commands_.insert(name);
    ASSERT_GT(commands_.size(), 20u);
    for (const std::string& name : commands_) options_[name] = optionsIn(run({name, "--help"}));
    commands_.insert("help");
    for (const std::string& kind : matches(run({"calibrate", "--help"}), "\n  ([a-z]+)  "))
      options_["calibrate " + kind] = optionsIn(run({"calibrate", kind, "--help"}));
    options_[""] = optionsIn(run({"--screenshot", "x.png", "--help"}));
    options_[""].merge(optionsIn(help));
    options_[""].insert("--version");
  }
  static std::string run(const std::vector<std::string>& words) {
    const ProgramResult result = runProgram(PALPATE_PROGRAM, words);
    EXPECT_EQ(result.exitCode, 0) << words.front() << ": " << result.err;
    return result.out;
  }
  // "info", "calibrate step", "" for the window.
  std::string commandOf(const std::vector<std::string>& words) const {
    if (words.empty() || !commands_.contains(words[0])) return "";
    if (words.size() > 1 && options_.contains(words[0] + " " + words[1]))
      return words[0] + " " + words[1];
    return words[0];
  }
  const std::string program_ = PALPATE_PROGRAM;
  // The same for all tests.
  inline static std::set<std::string> commands_;
  inline static std::map<std::string, std::set<std::string>> options_;  // by command
};

TEST(Manual, LinksLeadSomewhere) {
  for (const auto& [name, text] : pages()) {
    const fs::path folder = (projectFolder() / name).parent_path();
    for (const std::string& link : matches(text, "\\]\\(([^)\\s]+)\\)")) {
      if (link.find("://") != std::string::npos) continue;
      const std::string file = link.substr(0, link.find('#'));
      const fs::path target = file.empty() ? projectFolder() / name : folder / file;
      ASSERT_TRUE(fs::exists(target)) << name << " links to " << link;
      if (const auto hash = link.find('#'); hash != std::string::npos) {
        EXPECT_TRUE(anchorsOf(readFile(target)).contains(link.substr(hash + 1)))
            << name << " links to " << link;
      }
    }
  }
}

TEST(Manual, EveryPageStandsInItsContents) {
  const std::string& contents = pages().at("docs/README.md");
  for (const auto& [name, text] : pages()) {
    EXPECT_TRUE(text.starts_with("# ")) << name;
    if (!name.starts_with("docs/") || name == "docs/README.md") continue;
    const std::string link = "](" + name.substr(5) + ")";
    EXPECT_NE(contents.find(link), std::string::npos) << "docs/README.md lacks " << name;
  }
}

// Pages for a person with a task are short and few; the reference and the notes are not.
TEST(Manual, WrittenPagesAreShort) {
  const std::set<std::string> reference{"commands",
                                        "options",
                                        "tables",
                                        "columns",
                                        "keys",
                                        "docks",
                                        "files",
                                        "python",
                                        "stream_protocol",
                                        "glossary",
                                        "numbers"};
  constexpr std::ptrdiff_t kMaxPages = 25, kMaxWords = 1400;
  std::ptrdiff_t written = 0;
  for (const auto& [name, text] : pages()) {
    if (!name.starts_with("docs/manual/")) continue;
    if (reference.contains(fs::path(name).stem().string())) continue;
    ++written;
    std::istringstream words(text);
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(words), {}), kMaxWords)
        << name << ": evidence and details belong in docs/notes";
  }
  EXPECT_LE(written, kMaxPages);
}

TEST(Manual, PicturesAreShownAndSmall) {
  constexpr std::uintmax_t kLargest = 150'000, kMoving = 2'000'000, kAll = 4'000'000;
  std::uintmax_t all = 0;
  for (const auto& entry : fs::directory_iterator(projectFolder() / "docs/pictures")) {
    const std::string name = entry.path().filename().string();
    const bool moves = entry.path().extension() == ".gif";
    EXPECT_LE(entry.file_size(), moves ? kMoving : kLargest) << name;
    all += entry.file_size();
    EXPECT_TRUE(std::any_of(pages().begin(),
                            pages().end(),
                            [&](const auto& page) {
                              return page.second.find("pictures/" + name + ")") !=
                                     std::string::npos;
                            }))
        << "no page shows " << name;
  }
  EXPECT_LE(all, kAll);
}

TEST(Manual, KindsOfEventsAreInTheFormat) {
  const std::string& page = pages().at("docs/notes/palpate_format.md");
  std::string rows;
  for (const std::string& line : sectionOf(page, "Events")) {
    const auto cells = cellsOf(line);
    if (cells.size() > 1) rows += cells[0] + "\n";
  }
  std::set<std::string> kinds;
  for (const SourceFile& file : cppFiles({"src", "apps"}))
    for (const std::string& kind :
         matches(file.text,
                 "(?:\\bevent(?:Now)?\\(\\s*|\\.kind = |(?:[a-z]U|\\bu)s, )\"([a-z_]+)\"(?=[,;])"))
      kinds.insert(kind);
  EXPECT_GT(kinds.size(), 6u);
  for (const std::string& kind : kinds)
    EXPECT_NE(rows.find("`" + kind + "`"), std::string::npos)
        << "docs/notes/palpate_format.md lacks events of kind " << kind;
}

TEST_F(Docs, CommandsAndOptionsInPagesExist) {
  std::size_t calls = 0;
  for (const auto& [name, text] : pages())
    for (const std::string& code : codesOf(text)) {
      const auto words = callIn(code);
      if (!words) continue;
      ++calls;
      const std::string command = commandOf(*words);
      if (!words->empty() && command.empty()) {
        EXPECT_FALSE(std::regex_match(words->front(), std::regex("[a-z][a-z-]+")))
            << name << ": no command '" << words->front() << "' in: " << code;
      }
      for (const std::string& option : optionsIn(code))
        EXPECT_TRUE(options_.at(command).contains(option))
            << name << ": no option " << option << " in: " << code;
    }
  EXPECT_GT(calls, 100u);
}

// An option that stands alone is some command's, or another program's.
TEST_F(Docs, OptionsThatStandAloneExist) {
  std::set<std::string> known{"--test-dir", "--benchmark", "--preset"};
  for (const auto& [command, options] : options_) known.insert(options.begin(), options.end());
  for (const auto& [name, text] : pages())
    for (const std::string& code : codesOf(text))
      if (code.starts_with("--")) {
        for (const std::string& option : optionsIn(code))
          EXPECT_TRUE(known.contains(option)) << name << ": " << code;
      }
}

// The options of commands are in the page that the program prints; column_docs_test compares it.
TEST_F(Docs, EveryCommandAndOptionOfTheWindowIsInTheManual) {
  const std::string& page = pages().at("docs/manual/commands.md");
  for (const auto& [command, options] : options_)
    EXPECT_NE(page.find("| `palpate " + command), std::string::npos)
        << "docs/manual/commands.md has no row for " << command;
  std::string written;
  for (const auto& [name, text] : pages())
    if (name != "docs/manual/options.md") written += text;
  const std::set<std::string> told = optionsIn(written);
  for (const std::string& option : options_.at(""))
    EXPECT_TRUE(told.contains(option)) << "no page tells of " << option;
}

// Lines of pages that need nothing but the demonstration recording, in the order of the page.
TEST_F(Docs, WhatPagesShowRuns) {
  std::size_t ran = 0;
  for (const auto& [name, text] : pages()) {
    const TemporaryFolder folder;
    fs::create_directory_symlink(projectFolder() / "data", folder / "data");
    for (const std::string& line : linesOf(text)) {
      if (!line.starts_with("    ") || line.find("data/demo_grasps.dsa") == std::string::npos)
        continue;
      const auto words = callIn(line.substr(4));
      if (!words || commandOf(*words).empty()) continue;
      const std::string command =
          std::regex_replace(line, std::regex("^ +(palpate|scripts/run)"), "\"$$1\"");
      const ProgramResult result = runProgram(
          "/bin/bash", {"-c", "cd \"$0\" && " + command, (folder / ".").string(), program_});
      EXPECT_EQ(result.exitCode, 0) << name << ": " << line << "\n" << result.err;
      ++ran;
    }
  }
  EXPECT_GT(ran, 10u);
}

TEST_F(Docs, EveryDockIsDescribed) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgram(PALPATE_PROGRAM,
                                          {"--screenshot",
                                           (folder / "x.png").string(),
                                           "--dock",
                                           "?",
                                           (dataFolder() / "demo_grasps.dsa").string()},
                                          {{"QT_QPA_PLATFORM", "offscreen"}});
  const std::string there = "there are ";
  ASSERT_NE(result.err.find(there), std::string::npos) << result.err;
  const auto docks = matches(result.err.substr(result.err.find(there) + there.size()), "[A-Za-z]+");
  EXPECT_GT(docks.size(), 8u);
  for (const std::string& dock : docks)
    EXPECT_NE(pages().at("docs/manual/docks.md").find("\n## " + dock + "\n"), std::string::npos)
        << dock;
}

}  // namespace
}  // namespace palpate::testing::docs_test
