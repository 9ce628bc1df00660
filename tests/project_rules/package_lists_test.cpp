// The package lists bring all that the build, the scripts, the tests and the program take from
// outside the checkout: cmake/package_lists, which says how that is known, on the folder that these
// tests were built in.
#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::package_lists_test {
namespace {
namespace fs = std::filesystem;

// exit code of the script: no Debian 12, no apt, no index of packages
constexpr int kCannotTell = 77;

class PackageLists : public ::testing::Test {
 protected:
  // What is taken from outside is gathered once, it is judged by several tests.
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    gathered_ = script({"gather", PALPATE_BUILD_FOLDER, "-o", evidence()});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  void SetUp() override {
    if (gathered_.exitCode == kCannotTell) PALPATE_CANNOT_SHOW(gathered_.out);
    ASSERT_EQ(gathered_.exitCode, 0) << gathered_.out << gathered_.err;
  }

  static ProgramResult script(const std::vector<std::string>& arguments) {
    return runProgram(projectFolder() / "cmake/package_lists", arguments);
  }
  static std::string evidence() { return (*folder_ / "evidence.json").string(); }
  // apt's index, read once, is kept for the next call.
  static ProgramResult check(std::vector<std::string> options) {
    fs::create_directories(*folder_ / "apt");
    options.insert(options.begin(), {"check", evidence(), "--cache", (*folder_ / "apt").string()});
    return script(options);
  }
  // A copy of a list without some of its packages.
  static std::string listWithout(const std::string& list,
                                 const std::vector<std::string>& packages) {
    std::string text;
    for (const std::string& line : linesOf(readFile(projectFolder() / "cmake" / list)))
      if (std::find(packages.begin(), packages.end(), line) == packages.end()) text += line + "\n";
    writeFile(*folder_ / list, text);
    return (*folder_ / list).string();
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static ProgramResult gathered_;
};
std::unique_ptr<TemporaryFolder> PackageLists::folder_;
ProgramResult PackageLists::gathered_;

TEST_F(PackageLists, BringEveryFileThatIsTakenFromOutside) {
  const ProgramResult result = check({});
  if (result.exitCode == kCannotTell) PALPATE_CANNOT_SHOW(result.out);
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
}

// libqt6opengl6-dev was missing once: qt6-base-dev only recommends it, so that machines had it by
// chance.
TEST_F(PackageLists, WhatIsMissingIsNamedWithTheListItBelongsTo) {
  writeFile(*folder_ / "header.h", "");
  const std::string path = fs::canonical(*folder_ / "header.h").string();
  const ProgramResult result = check(
      {"--level=test",
       "--list=run=" + listWithout("debian-packages.txt", {"libqt6opengl6-dev"}),
       "--list=test=" + listWithout("debian-test-packages.txt", {"python3-matplotlib", "xauth"}),
       "--also=test=" + path});
  if (result.exitCode == kCannotTell) PALPATE_CANNOT_SHOW(result.out);
  EXPECT_EQ(result.exitCode, 1) << result.err;
  const std::string lists =
      " not brought by cmake/debian-packages.txt and cmake/debian-test-packages.txt. ";
  std::vector<std::string> begins = {
      "of no package:" + lists + path, "python3-matplotlib:" + lists, "xauth:" + lists};
  // A build without the window takes nothing from Qt.
  if (*PALPATE_PROGRAM) begins.insert(begins.begin() + 1, "libqt6opengl6-dev:" + lists);
  const auto lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), begins.size()) << result.out;
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_TRUE(lines[i].starts_with(begins[i])) << lines[i];
}

// One of the sources of what is taken: the programs that scripts call, found by reading them.
TEST(ShellWords, AreThoseThatStandWhereACommandDoes) {
  const TemporaryFolder folder;
  writeFile(folder / "script", R"(#!/bin/sh
# comment it's "no command
own() { sed s/x/y/ "$1"; }
VALUE=$(date +%s) OTHER='a b' tar -c x | gzip -9 >"$HOME/a b" 2>&1
if [ -f x ] && ! cmp -s a b; then mv a b; else own; fi
case "$1" in
  start | stop) systemctl "$1" ;;
  *) echo "it's $(basename "$0"), said (cut) 'paste'" ;;
esac
(cd /tmp && ninja -C x) &
xargs -0 -n 1 strip </dev/null
exec env -u VALUE LC_ALL=C \
  sort <<END
wc is data
END
awk '{ print }
uniq' file; $computed; /usr/bin/join
)");
  const ProgramResult result = runProgram(
      "/usr/bin/python3",
      {(projectFolder() / "cmake/shell_words.py").string(), (folder / "script").string()});
  EXPECT_EQ(result.out,
            "/usr/bin/join\nawk\nbasename\ncd\ncmp\ndate\necho\nenv\ngzip\nmv\nninja\nsed\nsort\n"
            "strip\nsystemctl\ntar\nxargs\n")
      << result.err;
}

}  // namespace
}  // namespace palpate::testing::package_lists_test
