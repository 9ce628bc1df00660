// Rules of the project: sizes, names, headers, lists and pages agree with each other.
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::project_rules_test {
namespace {
namespace fs = std::filesystem;

std::vector<SourceFile> allCpp() { return cppFiles({"include", "src", "apps", "tests"}); }

TEST(ProjectRules, NoFileIsLongerThan1000Lines) {
  for (const SourceFile& file : allCpp()) EXPECT_LE(linesOf(file.text).size(), 1000u) << file.path;
}

TEST(ProjectRules, NoFileIsNamedAfterNothing) {
  const std::regex nothing("(^|/|_)(utils?|helpers?|common|misc|manager)(_|/|\\.|$)");
  for (const SourceFile& file : allCpp())
    EXPECT_FALSE(std::regex_search(file.path, nothing)) << file.path;
}

TEST(ProjectRules, NamesOfFilesAreSnakeCase) {
  const std::regex snake("[a-z0-9_/]+\\.(h|cpp)");
  for (const SourceFile& file : allCpp())
    EXPECT_TRUE(std::regex_match(file.path, snake)) << file.path;
}

TEST(ProjectRules, EveryHeaderIsIncludedOnceAndSaysWhatItIs) {
  for (const SourceFile& file : allCpp()) {
    if (!file.path.ends_with(".h")) continue;
    EXPECT_NE(file.text.find("\n#pragma once\n"), std::string::npos) << file.path;
    EXPECT_TRUE(file.text.starts_with("//")) << file.path << " doesn't begin with what it is";
  }
}

// The first #include of a source is compiled with nothing before it: so a header that is first
// somewhere includes all that it needs. The few others are compiled here.
TEST(ProjectRules, EveryPublicHeaderCompilesByItself) {
  const std::regex pattern("#include [<\"]([^>\"]+)[>\"]");
  std::set<std::string> first;
  for (const SourceFile& file : allCpp()) {
    std::smatch match;
    if (file.path.ends_with(".cpp") && std::regex_search(file.text, match, pattern))
      first.insert(match[1]);
  }
  const std::string folder = (projectFolder() / "include").string();
  for (const SourceFile& file : cppFiles({"include"})) {
    const std::string name = file.path.substr(std::string("include/").size());
    if (first.contains(name)) continue;
    const ProgramResult result = runProgram(PALPATE_COMPILER,
                                            {"-std=c++20",
                                             "-fsyntax-only",
                                             "-I" + folder,
                                             "-isystem",
                                             PALPATE_EIGEN,
                                             "-x",
                                             "c++",
                                             "-include",
                                             name,
                                             "/dev/null"});
    EXPECT_EQ(result.exitCode, 0) << name << ": " << result.err;
  }
}

TEST(ProjectRules, EveryPublicHeaderHasATestOfItsName) {
  // Nothing but a type that work is given to, and errors; what uses them tests them.
  const std::set<std::string> without = {"core/error",
                                         "device/device",
                                         "emulator/hand_model",
                                         "live/live_results",
                                         "model/cell_truth",
                                         "model/hand_state",
                                         "model/taxel_place",
                                         "model/time_span"};
  // The parts of the native recording are tested where they meet: writing and reading, damage.
  const std::map<std::string, std::string> testedTogether = {
      {"recording/crop", "recording/palpate_recording"},
      {"recording/palpate_blocks", "recording/palpate_recording"},
      {"recording/palpate_reader", "recording/palpate_recording"},
      {"recording/palpate_schema", "recording/palpate_damage"},
      {"recording/palpate_recovery", "recording/palpate_damage"},
      {"recording/palpate_writer", "recording/palpate_recording"},
      {"recording/recording_lock", "recording/palpate_files"},
      {"recording/hdf5_process", "recording/hdf5_program"},
      {"recording/foreign_file", "imports/table_source"},
      {"model/event", "recording/palpate_recording"},
      {"recording/recording_data", "recording/recording_format"},
      {"recording/second_summary", "recording/palpate_recording"},
      {"recording/table_export", "recording/table_export"},
      // Columns of result tables are tested where a command prints them.
      {"calibration/pressure_rows", "commands/calibrate_command"},
      {"kinematics/taxel_rows", "commands/kinematics_command"},
      {"laboratory/ghost_rows", "commands/ghosts_command"},
      {"recognition/answer_rows", "commands/classify_command"},
      {"recognition/size_rows", "commands/contact_command"},
      {"signals/centre_rows", "signals/curve_rows"},
      {"signals/spectrum_rows", "signals/curve_rows"},
      {"model/matrix_rows", "slip/slip_rows"},
      {"model/profile_over", "model/fitted_times"},
      {"interop/recent_link", "interop/live_stream"}};
  const std::regex pattern("include/palpate/(.*)\\.h");
  for (const SourceFile& file : cppFiles({"include"})) {
    std::smatch match;
    ASSERT_TRUE(std::regex_match(file.path, match, pattern)) << file.path;
    const std::string name = match[1];
    const auto together = testedTogether.find(name);
    const std::string test = together == testedTogether.end() ? name : together->second;
    EXPECT_EQ(fs::exists(projectFolder() / "tests" / (test + "_test.cpp")), !without.contains(name))
        << name;
  }
}

// The SDH-2 is one hand of many: only its drivers, its control and its emulation name it.
TEST(ProjectRules, OnlyDriversControlAndEmulatorNameTheSdh2) {
  const std::regex allowed("(include/palpate|src)/(device|control|emulator)/.*");
  const std::regex name("sdh2", std::regex::icase);
  for (const SourceFile& file : cppFiles({"include", "src", "apps"}))
    EXPECT_TRUE(std::regex_match(file.path, allowed) || !std::regex_search(file.text, name))
        << file.path;
}

TEST(ProjectRules, EveryTestIsBuilt) {
  for (const SourceFile& file : cppFiles({"tests"})) {
    if (!file.path.ends_with("_test.cpp")) continue;
    const fs::path path = projectFolder() / file.path;
    fs::path folder = path.parent_path();
    while (!fs::exists(folder / "CMakeLists.txt")) folder = folder.parent_path();
    const std::string list = readFile(folder / "CMakeLists.txt");
    EXPECT_TRUE(std::regex_search(list, std::regex("\\b" + path.stem().string() + "\\b")))
        << file.path << " isn't in its CMakeLists.txt";
  }
}

TEST(ProjectRules, PackageListsAreWellFormed) {
  const std::regex entry(
      "[a-z0-9][a-z0-9+.-]+( \\[(bookworm|trixie|fuzz|coverage|tidy|asan|tsan|slow|fresh)\\]|  # "
      "at "
      "least [0-9.:]+)?");
  std::set<std::string> seen;
  for (const char* list : {"debian-packages.txt", "debian-test-packages.txt"}) {
    const std::string text = readFile(projectFolder() / "cmake" / list);
    EXPECT_TRUE(text.ends_with('\n')) << list;
    for (const std::string& line : linesOf(text)) {
      if (line.empty() || line[0] == '#') continue;
      EXPECT_TRUE(std::regex_match(line, entry)) << list << ": '" << line << "'";
      EXPECT_TRUE(seen.insert(line.substr(0, line.find("  #"))).second)
          << list << ": twice: " << line;
    }
  }
  const std::string tools = readFile(projectFolder() / "cmake/package/debian-tools.txt");
  for (const std::string& line : linesOf(tools)) {
    if (line.empty() || line[0] == '#') continue;
    EXPECT_TRUE(std::regex_match(line, std::regex("[a-z0-9.+-]+( \\[try\\])?"))) << line;
  }
  EXPECT_TRUE(seen.contains("qt6-base-dev"));
  EXPECT_FALSE(seen.contains("libopencv-dev")) << "brings Qt 5 (docs/architecture.md)";
}

TEST(ProjectRules, ScriptsAreRunnableBash) {
  for (const char* name : {"scripts/run",
                           "scripts/test",
                           "scripts/format",
                           "scripts/tidy",
                           "scripts/package",
                           "cmake/empty_debian.sh",
                           "cmake/fresh_machine",
                           "cmake/package/trial",
                           "cmake/package/try_package",
                           "scripts/prepare.sh",
                           ".ci/run"}) {
    const fs::path path = projectFolder() / name;
    const ProgramResult result = runProgram("/bin/bash", {"-n", path.string()});
    EXPECT_EQ(result.exitCode, 0) << name << ": " << result.err;
    const bool runnable = (fs::status(path).permissions() & fs::perms::owner_exec) != fs::perms();
    EXPECT_EQ(runnable, !std::string(name).ends_with(".sh")) << name;
  }
}

// A command takes the range of a number from the option struct that the number is for, or names it
// (OptionRange). Those with an end that depends on the recording are left; this list only shrinks.
TEST(ProjectRules, CommandsParseNumbersWithNamedRanges) {
  const std::map<std::string, int> allowed{{"apps/palpate/commands/spectrum_command.cpp", 1}};
  const std::regex literal("given\\.(number|integer)\\(\\s*\"[a-z-]+\",\\s*[^,)]+,");
  std::map<std::string, int> found;
  for (const SourceFile& file : cppFiles({"apps/palpate/commands"})) {
    const auto count = std::distance(
        std::sregex_iterator(file.text.begin(), file.text.end(), literal), std::sregex_iterator());
    if (count > 0) found[file.path] = static_cast<int>(count);
  }
  EXPECT_EQ(found, allowed);
}

TEST(ProjectRules, FilesAndCommandsThatPagesNameExist) {
  const std::regex link("\\]\\(([^)#:]+)\\)");
  const std::regex script("\\b(scripts/[a-z_]+)");
  const std::regex command("palpate ([a-z]+)( |`|$)");
  const std::string sources = readFile(projectFolder() / "apps/palpate/commands/commands.cpp");
  for (const char* page : {"README.md", "docs/architecture.md"}) {
    const std::string text = readFile(projectFolder() / page);
    const fs::path folder = (projectFolder() / page).parent_path();
    const auto each = [&](const std::regex& pattern, auto check) {
      for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
        check((*at)[1].str());
    };
    each(link, [&](const std::string& name) {
      EXPECT_TRUE(fs::exists(folder / name)) << page << " links to " << name;
    });
    each(script, [&](const std::string& name) {
      EXPECT_TRUE(fs::exists(projectFolder() / name)) << page << " names " << name;
    });
    // Commands stand in code: `palpate info FILE` or an indented line.
    for (const std::string& line : linesOf(text)) {
      std::vector<std::string> codes = codeWordsOf(line);
      if (line.starts_with("    ")) codes.push_back(line);
      for (const std::string& code : codes) {
        std::smatch match;
        if (std::regex_search(code, match, command)) {
          EXPECT_NE(sources.find("{\"" + match[1].str() + "\","), std::string::npos)
              << page << ": " << code;
        }
      }
    }
  }
}

}  // namespace
}  // namespace palpate::testing::project_rules_test
