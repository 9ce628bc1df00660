// The package lists bring all that the build, the tests and the program take from outside the
// checkout: cmake/package_lists, which says how that is known, on the folder that these tests were
// built in.
#include <algorithm>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::package_lists_test {
namespace {

// exit code of the script: neither Debian 12 nor 13, no apt, no index of packages
constexpr int kCannotTell = 77;

// libqt6opengl6-dev was missing once: qt6-base-dev only recommends it, so that machines had it by
// chance. One call, since the script takes a while: as if three packages were not in the lists and
// a file of no package were taken, and then exactly these are missing.
TEST(PackageLists, BringEveryFileThatIsTakenFromOutsideAndNameWhatIsMissing) {
  const TemporaryFolder folder;
  writeFile(folder / "header.h", "");
  const std::string path = std::filesystem::canonical(folder / "header.h").string();
  const ProgramResult result = runProgram(projectFolder() / "cmake/package_lists",
                                          {PALPATE_BUILD_FOLDER,
                                           "--without=libmuparser-dev",
                                           "--without=python3-matplotlib",
                                           "--without=xauth",
                                           "--also=" + path});
  if (result.exitCode == kCannotTell) PALPATE_CANNOT_SHOW(result.out);
  EXPECT_EQ(result.exitCode, 1) << result.err;
  const std::string run = " not brought by cmake/debian-packages.txt. ";
  const std::string test =
      " not brought by cmake/debian-packages.txt and cmake/debian-test-packages.txt. ";
  std::vector<std::string> missing = {"libmuparser-dev:" + run,
                                      "libmuparser2v5:" + run,  // which it brings
                                      "of no package:" + test + path,
                                      "python3-matplotlib:" + test,
                                      "xauth:" + test};
  for (const std::string& line : linesOf(result.out)) {
    const auto named = std::find_if(missing.begin(), missing.end(), [&](const std::string& start) {
      return line.starts_with(start);
    });
    if (named != missing.end())
      missing.erase(named);
    else
      ADD_FAILURE() << line;
  }
  EXPECT_TRUE(missing.empty()) << missing.front() << " isn't in " << result.out;
}

}  // namespace
}  // namespace palpate::testing::package_lists_test
