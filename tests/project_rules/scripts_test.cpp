// The scripts where all goes well or something is done twice; what they say where something is
// missing: set_up_test.cpp.
#include <gtest/gtest.h>

#include "project_rules/scripts_checkout.h"
#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::scripts_test {
namespace {
namespace fs = std::filesystem;

TEST_F(Scripts, RunInstallsConfiguresBuildsAndHandsOver) {
  const ProgramResult result = call("run", {"info", "a file.dsa"});
  EXPECT_EQ(result.exitCode, 3) << result.err;  // the program's own
  EXPECT_EQ(result.out, (folder_ / "elsewhere").string() + "\n[info][a file.dsa]");
  const auto lines = linesOf(logged());
  ASSERT_EQ(lines.size(), 3u) << logged();
  EXPECT_TRUE(lines[0].starts_with("apt-get ")) << lines[0];
  EXPECT_TRUE(lines[0].ends_with(" satisfy --no-install-recommends first second")) << lines[0];
  EXPECT_EQ(lines[1], "cmake --preset release -DPALPATE_TESTS=OFF -DPALPATE_BENCHMARKS=OFF");
  EXPECT_TRUE(lines[2].ends_with("build/release --quiet palpate palpate_python")) << lines[2];
}

TEST_F(Scripts, RunIsSilentAndCallsNothingWhenNothingChanged) {
  call("run", {"info"});
  const ProgramResult result = call("run", {"info"});
  EXPECT_EQ(logged(), "");
  EXPECT_EQ(result.err, "");
}

TEST_F(Scripts, RunWithoutArgumentsShowsTheDemonstration) {
  const std::string there = (folder_ / "elsewhere").string() + "\n";
  EXPECT_EQ(call("run", {}, {{"DISPLAY", ":7"}}).out, there + "[--demo]");
  EXPECT_EQ(call("run", {}, {{"WAYLAND_DISPLAY", "wayland-0"}}).out, there + "[--demo]");
  const ProgramResult headless = call("run");
  EXPECT_EQ(headless.out, there + "[demo][-o][palpate-demo]");
  EXPECT_NE(headless.err.find("no display"), std::string::npos) << headless.err;
}

TEST_F(Scripts, PackageListsAreUpdatedOnlyWhenTheFirstTryFails) {
  standInApt(log("apt-get") + "case \"$*\" in *update) touch '" + (folder_ / "new").string() +
             "';; *) [ -f '" + (folder_ / "new").string() +
             "' ] || { echo 'E: Failed to fetch x  404  Not Found'; exit 100; };; esac");
  EXPECT_EQ(call("run").exitCode, 3);
  const auto lines = linesOf(logged());
  ASSERT_GE(lines.size(), 3u);
  EXPECT_TRUE(lines[1].ends_with(" update")) << lines[1];
  EXPECT_TRUE(lines[2].ends_with(" second")) << lines[2];
}

TEST_F(Scripts, CopiedCheckoutIsConfiguredAnew) {
  call("run", {"info"});
  fs::rename(checkout_, folder_ / "moved");
  checkout_ = folder_ / "moved";
  const ProgramResult result = call("run", {"info"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(logged().find("cmake --preset release"), std::string::npos) << logged();
  EXPECT_NE(logged().find("ninja "), std::string::npos) << logged();
}

TEST_F(Scripts, UnknownSuiteIsWrongUsage) {
  const ProgramResult result = call("test", {"everything"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.err.find("scripts/test asan"), std::string::npos) << result.err;
}

TEST_F(Scripts, SuitesInstallTheirOwnPackagesBesideTheOthers) {
  writeFile(checkout_ / "cmake/debian-test-packages.txt", "third\nfourth [fuzz]\nfifth [tidy]\n");
  standInApt(log("apt-get") + "exit 1");
  call("test");
  EXPECT_NE(logged().find("--no-install-recommends first second third\n"), std::string::npos)
      << logged();
  const ProgramResult result = call("test", {"fuzz"});
  EXPECT_NE(logged().find("--no-install-recommends first second third fourth\n"), std::string::npos)
      << logged();
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, "0 passed, 1 failed, 0 skipped\n");
}

class PackageScript : public Scripts {
 protected:
  void SetUp() override {
    Scripts::SetUp();
    fs::create_directories(checkout_ / "cmake/package");
    writeFile(checkout_ / "cmake/package/debian-tools.txt", "third\nfourth [try]\n");
    standInApt("", "", 0);  // nothing is missing
    standIn("cpack", log("cpack") + "touch palpate_0.2.0-1_amd64.deb");
    // What is unpacked: a program that works.
    standIn("dpkg-deb",
            "mkdir -p \"$3/usr/bin\"; printf '#!/bin/sh\\n' > \"$3/usr/bin/palpate\"; "
            "chmod +x \"$3/usr/bin/palpate\"");
    for (const char* tool : {"lintian", "desktop-file-validate", "appstreamcli", "xmllint"})
      standIn(tool, log(tool));
  }
  const std::string package_ = "build/release/palpate_0.2.0-1_amd64.deb\n";
};

TEST_F(PackageScript, BuildsOnlyWhatIsInstalledPacksAndChecks) {
  const ProgramResult result = call("package");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(result.out.ends_with(package_)) << result.out;
  const auto lines = linesOf(logged());
  ASSERT_EQ(lines.size(), 7u) << logged();
  EXPECT_EQ(lines[0], "cmake --preset release -DPALPATE_TESTS=OFF -DPALPATE_BENCHMARKS=OFF");
  EXPECT_TRUE(lines[1].ends_with("build/release --quiet palpate_installed")) << lines[1];
  EXPECT_EQ(lines[2], "cpack -G DEB");
  EXPECT_TRUE(lines[3].starts_with("lintian ")) << lines[3];
}

TEST_F(PackageScript, NamesNoPackageThatFailsACheck) {
  standIn("lintian", "echo 'E: palpate: something'; exit 2");
  const ProgramResult result = call("package");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("E: palpate: something"), std::string::npos) << result.err;
}

TEST_F(PackageScript, SaysWhyPackingFailed) {
  standIn("cpack", "echo 'CPack Error: no'; exit 1");
  const ProgramResult result = call("package");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.err.find("CPack Error: no"), std::string::npos) << result.err;
}

TEST_F(PackageScript, TrialTakesRootAndAFolder) {
  EXPECT_EQ(call("package", {"--try"}).exitCode, 2);
  EXPECT_EQ(call("package", {"--install"}).exitCode, 2);
  standIn("id", "echo 1000");
  const ProgramResult result = call("package", {"--try", (folder_ / "trial").string()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.err.find("root"), std::string::npos) << result.err;
  EXPECT_EQ(logged(), "");
}

// Report lines as ctest 3.25 writes them.
class CountTests : public ::testing::Test {
 protected:
  ProgramResult count(const std::string& cases) const {
    const TemporaryFolder folder;
    writeFile(
        folder / "report.xml",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite>\n" + cases + "</testsuite>\n");
    return runProgram((projectFolder() / "scripts/count_tests").string(),
                      {(folder / "report.xml").string()});
  }
  const std::string passed_ =
      "\t<testcase name=\"a\" classname=\"a\" time=\"0.01\" status=\"run\">\n\t\t<system-out>x "
      "status=\"fail\"</system-out>\n\t</testcase>\n";
  const std::string failed_ =
      "\t<testcase name=\"b\" classname=\"b\" time=\"0.01\" status=\"fail\">\n\t\t<failure "
      "message=\"\"/>\n<system-out>x status=\"run\"</system-out>\n\t</testcase>\n";
  const std::string skipped_ =
      "\t<testcase name=\"c\" classname=\"c\" time=\"0.01\" status=\"notrun\">\n\t\t<skipped "
      "message=\"SKIP_REGULAR_EXPRESSION_MATCHED\"/>\n\t</testcase>\n";
  const std::string missing_ =
      "\t<testcase name=\"d\" classname=\"d\" time=\"0\" status=\"notrun\">\n\t\t<skipped "
      "message=\"Unable to find executable\"/>\n\t</testcase>\n";
};

TEST_F(CountTests, CountsEachKind) {
  const ProgramResult result = count(passed_ + passed_ + failed_ + skipped_ + passed_);
  EXPECT_EQ(result.out, "3 passed, 1 failed, 1 skipped\n");
  EXPECT_EQ(result.exitCode, 1);
}

TEST_F(CountTests, SucceedsWhenNothingFailed) {
  const ProgramResult result = count(passed_ + skipped_);
  EXPECT_EQ(result.out, "1 passed, 0 failed, 1 skipped\n");
  EXPECT_EQ(result.exitCode, 0);
}

TEST_F(CountTests, WhatCouldNotRunHasFailed) {
  EXPECT_EQ(count(passed_ + missing_).out, "1 passed, 1 failed, 0 skipped\n");
}

TEST_F(CountTests, NoTestIsAFailure) {
  EXPECT_EQ(count("").out, "0 passed, 1 failed, 0 skipped\n");
  const ProgramResult result =
      runProgram((projectFolder() / "scripts/count_tests").string(), {"/nowhere/report.xml"});
  EXPECT_EQ(result.out, "0 passed, 1 failed, 0 skipped\n");
  EXPECT_EQ(result.exitCode, 1);
}

}  // namespace
}  // namespace palpate::testing::scripts_test
