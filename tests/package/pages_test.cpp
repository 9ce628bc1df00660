// Man page and completions against what the program itself says with --help.
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::pages_test {
namespace {
namespace fs = std::filesystem;
using Options = std::set<std::string>;  // long names, as "--json"

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string helpOf(const std::string& command) {
  std::vector<std::string> words =
      command.empty() ? std::vector<std::string>{"--demo"} : wordsOf(command);
  words.push_back("--help");
  const ProgramResult result = runProgram(PALPATE_PROGRAM, words);
  EXPECT_EQ(result.exitCode, 0) << command << ": " << result.err;
  return result.out;
}

// The first words of the indented lines below a line that ends with `title`.
std::vector<std::string> namesBelow(const std::string& help, const std::string& title) {
  std::vector<std::string> names;
  bool below = false;
  for (const std::string& line : linesOf(help)) {
    if (below && line.empty()) break;
    if (below) names.push_back(wordsOf(line).at(0));
    below = below || line.ends_with(title);
  }
  return names;
}

// Of all groups below "Commands:".
std::vector<std::string> commandsIn(const std::string& help) {
  std::vector<std::string> names;
  for (const std::string& line : linesOf(help.substr(help.find("\nCommands:\n"))))
    if (line.starts_with("  ")) names.push_back(wordsOf(line).at(0));
  return names;
}

Options optionsOf(const std::string& help) {
  const std::regex option("^  (-[a-z] \\[ )?(--[a-z][a-z0-9-]*)");
  Options options;
  std::smatch match;
  for (const std::string& line : linesOf(help))
    if (std::regex_search(line, match, option)) options.insert(match[2]);
  return options;
}

class Pages : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    said_ = new std::map<std::string, Options>;
    (*said_)[""] = optionsOf(helpOf(""));
    (*said_)[""].insert("--version");
    for (const std::string& command : commandsIn(runProgram(PALPATE_PROGRAM, {"--help"}).out)) {
      const std::string help = helpOf(command);
      const std::vector<std::string> kinds = namesBelow(help, "KIND:");
      for (const std::string& kind : kinds)
        (*said_)[command + " " + kind] = optionsOf(helpOf(command + " " + kind));
      if (kinds.empty()) (*said_)[command] = optionsOf(help);
    }
  }
  static void TearDownTestSuite() { delete said_; }

  static std::string page(const std::string& name) {
    return readFile(fs::path(PALPATE_BUILD_FOLDER) / "cmake/package/pages" / name);
  }
  static fs::path pathOf(const std::string& name) {
    return fs::path(PALPATE_BUILD_FOLDER) / "cmake/package/pages" / name;
  }
  // Of every command (kinds as "calibrate noise"), of the window "".
  static const std::map<std::string, Options>& said() { return *said_; }

 private:
  static inline std::map<std::string, Options>* said_ = nullptr;
};

TEST_F(Pages, HelpNamesCommandsKindsAndOptions) {
  EXPECT_GE(said().size(), 30u);
  EXPECT_TRUE(said().contains("calibrate tare"));
  EXPECT_TRUE(said().at("info").contains("--json"));
  EXPECT_TRUE(said().at("").contains("--screenshot"));
}

TEST_F(Pages, ManualHasEveryCommandWithItsOptionsAndNoOther) {
  const std::string manual = page("palpate.1");
  EXPECT_NE(manual.find(std::string("\"Palpate ") + PALPATE_VERSION + "\""), std::string::npos);
  const std::regex option("(^|, )\\\\fB(\\\\-\\\\-[a-z][a-z0-9\\\\-]*)\\\\fR");
  for (const auto& [command, options] : said()) {
    const std::string head = command.empty()
                                 ? "\n.SH OPTIONS OF THE WINDOW\n"
                                 : "\n.SS palpate " + replaced(command, "-", "\\-") + "\n";
    const std::size_t begin = manual.find(head);
    ASSERT_NE(begin, std::string::npos) << "no section " << head;
    const std::size_t end = manual.find("\n.S", begin + head.size());
    const std::string section = manual.substr(begin, end - begin);
    Options explained = {"--help", "--quiet"};  // of all commands, in front
    bool tagged = false;
    for (const std::string& line : linesOf(section)) {
      std::smatch match;
      if (tagged && std::regex_search(line, match, option))
        explained.insert(replaced(match[2], "\\-", "-"));
      tagged = line == ".TP";
    }
    EXPECT_EQ(explained, options) << "palpate " << command;
  }
  for (const char* every : {"\\-\\-quiet", "\\-\\-help"})
    EXPECT_NE(manual.find(every), std::string::npos) << every;
}

// The program breaks long texts into lines, even within a word (emulate_command.cpp has this one).
TEST_F(Pages, ManualHasTextsInOnePiece) {
  const std::string manual = page("palpate.1");
  EXPECT_NE(manual.find("insert=RATE stall=S@AT unplug=S@AT junk_start=BYTES boot=S."),
            std::string::npos);
  EXPECT_NE(manual.find("the picture or movie, or the folder of a series"), std::string::npos);
}

TEST_F(Pages, ManualIsSetWithoutComplaint) {
  if (!fs::exists("/usr/bin/man")) PALPATE_CANNOT_SHOW("man-db isn't installed");
  const ProgramResult result = runProgram(
      "/usr/bin/man", {"--warnings", "-l", pathOf("palpate.1").string()}, {{"LC_ALL", "C.UTF-8"}});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("palpate calibrate noise FILE"), std::string::npos);
  EXPECT_NE(result.out.find("EXIT STATUS"), std::string::npos);
}

TEST_F(Pages, BashOffersEveryCommandAndItsOptionsAndNoOther) {
  const fs::path library = "/usr/share/bash-completion/bash_completion";
  if (!fs::exists(library)) PALPATE_CANNOT_SHOW("bash-completion isn't installed");
  // Of each argument a line: what completes it.
  const std::string script = R"(. "$1"; . "$2"; cd "$3"; shift 3
for line; do
  COMP_WORDS=($line); [[ $line != *' ' ]] || COMP_WORDS+=("")
  COMP_LINE=$line COMP_POINT=${#line} COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  _palpate palpate
  echo "${COMPREPLY[*]}"
done)";
  const TemporaryFolder folder;
  for (const char* name : {"a.dsa", "B.DSA", "c.palpate", "d.json", "e.txt", "f.h5", "g.mcap"})
    writeFile(folder / name, "");
  fs::create_directory(folder / "place");
  std::vector<std::string> arguments = {
      "-c", script, "bash", library, pathOf("palpate.bash"), folder.path().string()};
  const std::size_t before = arguments.size();
  std::vector<std::string> commands;
  Options names;
  Options kinds;
  for (const auto& [command, options] : said()) {
    commands.push_back(command);
    arguments.push_back("palpate " + (command.empty() ? "a.dsa" : command) + " --");
    if (!command.empty()) names.insert(wordsOf(command)[0]);
    if (command.starts_with("calibrate ")) kinds.insert(wordsOf(command)[1]);
  }
  const std::vector<std::pair<std::string, Options>> others = {
      {"palpate calibrate ", kinds},
      {"palpate help recov", {"recover"}},
      {"palpate help calibrate ", kinds},
      {"palpate remote st", {"start", "status", "stop"}},
      {"palpate kinematics --hand sd", {"sdh2"}},
      {"palpate compare --align ", {"contact", "start", "clock"}},
      {"palpate calibrate step --loss h", {"huber"}},
      {"palpate info ", {"a.dsa", "B.DSA", "c.palpate", "f.h5", "g.mcap", "place"}},
      {"palpate import ", {"e.txt", "f.h5", "place"}},
      {"palpate filter --recipe ", {"d.json", "place"}},
      {"palpate demo -o ", {"place"}},
      {"palpate emulate --scene foam", {"foam_ball"}},
      {"palpate info --json c", {"c.palpate"}},
      {"palpate nothing.dsa e", {}}};
  for (const auto& [line, expected] : others) arguments.push_back(line);
  arguments.push_back("palpate ");
  const ProgramResult result = runProgram("/bin/bash", arguments);
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = linesOf(result.out);
  ASSERT_GE(lines.size(), arguments.size() - before);
  const auto offered = [&](std::size_t i) {
    const auto words = wordsOf(lines[i]);
    return Options(words.begin(), words.end());
  };
  std::size_t i = 0;
  for (const std::string& command : commands)
    EXPECT_EQ(offered(i++), said().at(command)) << command;
  for (const auto& [line, expected] : others) EXPECT_EQ(offered(i++), expected) << line;
  names.insert({"help", "a.dsa", "B.DSA", "c.palpate", "f.h5", "g.mcap", "place"});
  EXPECT_EQ(offered(i), names);
}

TEST_F(Pages, FishOffersEveryCommandAndItsOptionsAndNoOther) {
  if (!fs::exists("/usr/bin/fish")) GTEST_SKIP() << "fish isn't installed";
  std::string script = "source " + pathOf("palpate.fish").string() + "\n";
  for (const auto& [command, options] : said())
    script += "echo '= " + command + "'; complete -C 'palpate " +
              (command.empty() ? "a.dsa" : command) + " --'\n";
  const TemporaryFolder home;
  const ProgramResult result = runProgram("/usr/bin/fish",
                                          {"-N", "-c", script},
                                          {{"HOME", home.path().string()},
                                           {"XDG_CONFIG_HOME", home.path().string()},
                                           {"XDG_DATA_HOME", home.path().string()}});
  EXPECT_EQ(result.err, "");
  std::map<std::string, Options> offered;
  std::string command;
  for (const std::string& line : linesOf(result.out)) {
    if (line.starts_with("= "))
      command = line.substr(2);
    else if (!line.empty())
      offered[command].insert(line.substr(0, line.find('\t')));
  }
  offered[""].insert("--version");  // offered in the first place only
  EXPECT_EQ(offered, said());
}

TEST_F(Pages, ZshKnowsEveryCommandAndItsOptions) {
  const std::string text = page("_palpate");
  EXPECT_TRUE(text.starts_with("#compdef palpate\n"));
  for (const auto& [command, options] : said()) {
    if (command.empty()) continue;
    const std::string name = wordsOf(command).back();
    const std::size_t begin = text.find("\n        " + name + ")\n");
    const std::size_t found =
        begin != std::string::npos ? begin : text.find("\n      " + name + ")\n");
    ASSERT_NE(found, std::string::npos) << command;
    const std::string block = text.substr(found, text.find(";;\n", found) - found);
    for (const std::string& option : options)
      EXPECT_TRUE(std::regex_search(block, std::regex("'\\*" + option + "=?\\[")))
          << command << " " << option;
  }
  if (!fs::exists("/usr/bin/zsh"))
    GTEST_SKIP() << "zsh isn't installed: its grammar wasn't checked";
  EXPECT_EQ(runProgram("/usr/bin/zsh", {"-n", pathOf("_palpate").string()}).exitCode, 0);
}

}  // namespace
}  // namespace palpate::testing::pages_test
