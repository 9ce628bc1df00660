// A source is as optimised as its target asks for. GCC forgets the level of the command line behind
// `#pragma GCC optimize` (Eigen/Core has one) of a precompiled header, and goes on with the
// header's own.
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "palpate/core/json.h"

#include "project_rules/source_tree.h"
#include "testing/testing.h"

namespace palpate::testing::compile_options_test {
namespace {

// Path of a precompiled header -> level -> an example of what makes or reads it.
using Levels = std::map<std::string, std::map<std::string, std::string>>;

// The last one counts; nothing: -O0.
std::string levelOf(const std::string& command) {
  static const std::regex pattern(" -O([0-3sgz]|fast)?(?= )");
  std::string level = "-O0";
  for (std::sregex_iterator at(command.begin(), command.end(), pattern), end; at != end; ++at)
    level = at->str().substr(1);
  return level;
}

Levels levelsIn(const Json& commands) {
  static const std::regex header(" -include (\\S+/cmake_pch\\.hxx) ");
  Levels levels;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Json entry = commands.at(i);
    const std::string command = entry.at("command").asString() + " ";
    std::smatch match;
    if (std::regex_search(command, match, header))
      levels[match[1]].emplace(levelOf(command), entry.at("file").asString());
  }
  return levels;
}

std::string differences(const Levels& levels) {
  std::string text;
  for (const auto& [header, examples] : levels) {
    if (examples.size() < 2) continue;
    text += header + ":";
    for (const auto& [level, file] : examples) text += " " + level + " " + file;
    text += "\n";
  }
  return text;
}

TEST(CompileOptions, WhoReadsAPrecompiledHeaderIsOptimisedAsItIs) {
  const auto path = std::filesystem::path(PALPATE_BUILD_FOLDER) / "compile_commands.json";
  const Levels levels = levelsIn(Json::parse(readFile(path)));
  if (!PALPATE_PRECOMPILED) GTEST_SKIP() << "this build has no precompiled headers";
  EXPECT_GE(levels.size(), 2u) << "of the library and of its tests, at least";
  EXPECT_EQ(differences(levels), "");
}

TEST(CompileOptions, FindsATargetOfAnotherLevel) {
  const auto command = [](const std::string& options, const std::string& file) {
    return Json::object()
        .set("command", "c++ -O2 " + options + " -include /b/core.dir/cmake_pch.hxx -c " + file)
        .set("file", file);
  };
  Json commands = Json::array();
  commands.push(command("-x c++-header", "header"));
  commands.push(command("-O2", "b.cpp"));
  EXPECT_EQ(differences(levelsIn(commands)), "");
  commands.push(command("-O3", "a.cpp"));
  EXPECT_EQ(differences(levelsIn(commands)), "/b/core.dir/cmake_pch.hxx: -O2 header -O3 a.cpp\n");
}

}  // namespace
}  // namespace palpate::testing::compile_options_test
