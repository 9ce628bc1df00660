// The package lists bring all that the build, the tests and the program take from outside the
// checkout: cmake/package_lists, which says how that is known, on the folder that these tests were
// built in.
#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::package_lists_test {
namespace {

// exit code of the script: neither Debian 12 nor 13, no apt, no index of packages
constexpr int kCannotTell = 77;

ProgramResult check(std::vector<std::string> options = {}) {
  options.insert(options.begin(), PALPATE_BUILD_FOLDER);
  return runProgram(projectFolder() / "cmake/package_lists", options);
}

TEST(PackageLists, BringEveryFileThatIsTakenFromOutside) {
  const ProgramResult result = check();
  if (result.exitCode == kCannotTell) PALPATE_CANNOT_SHOW(result.out);
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
}

// libqt6opengl6-dev was missing once: qt6-base-dev only recommends it, so that machines had it by
// chance.
TEST(PackageLists, WhatIsMissingIsNamedWithTheListItBelongsTo) {
  const TemporaryFolder folder;
  writeFile(folder / "header.h", "");
  const std::string path = std::filesystem::canonical(folder / "header.h").string();
  const ProgramResult result = check({"--without=libmuparser-dev",
                                      "--without=python3-matplotlib",
                                      "--without=xauth",
                                      "--also=" + path});
  if (result.exitCode == kCannotTell) PALPATE_CANNOT_SHOW(result.out);
  EXPECT_EQ(result.exitCode, 1) << result.err;
  const std::string run = " not brought by cmake/debian-packages.txt. ";
  const std::string test =
      " not brought by cmake/debian-packages.txt and cmake/debian-test-packages.txt. ";
  for (const std::string& wanted : {"libmuparser-dev:" + run,
                                    "of no package:" + test + path,
                                    "python3-matplotlib:" + test,
                                    "xauth:" + test})
    EXPECT_NE(("\n" + result.out).find("\n" + wanted), std::string::npos)
        << wanted << " isn't in " << result.out;
}

}  // namespace
}  // namespace palpate::testing::package_lists_test
