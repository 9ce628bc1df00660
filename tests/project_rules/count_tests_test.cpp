// The count at the end of scripts/test: from ctest's report of processes and the processes' own
// reports.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::count_tests_test {
namespace {

// Lines as ctest 3.25 and GoogleTest 1.12 write them.
class CountTestsOfProcesses : public ::testing::Test {
 protected:
  void entry(const std::string& name, bool passed) {
    entries_ += "\t<testcase name=\"" + name + "\" classname=\"x\" time=\"0.1\" status=\"" +
                (passed ? "run" : "fail") + "\">\n" +
                (passed ? "" : "\t\t<failure message=\"\"/>\n") + "\t</testcase>\n";
  }
  void own(const std::string& name, const std::string& cases) {
    writeFile(folder_ / (name + ".xml"),
              "<?xml version=\"1.0\"?>\n<testsuites><testsuite name=\"S\">" + cases +
                  "</testsuite></testsuites>\n");
  }
  ProgramResult count() {
    writeFile(folder_ / "report.xml", "<testsuite>\n" + entries_ + "</testsuite>\n");
    return runProgram((projectFolder() / "scripts/count_tests").string(),
                      {(folder_ / "report.xml").string(), folder_.path().string(), "2"});
  }
  static std::string lastLine(const std::string& text) {
    const std::vector<std::string> lines = linesOf(text);
    return lines.empty() ? "" : lines.back();
  }
  const std::string good_ = "<testcase name=\"A\" status=\"run\" time=\"0.25\" classname=\"S\" />";
  const std::string bad_ =
      "<testcase name=\"B\" status=\"run\" time=\"1.5\" classname=\"S\"><failure "
      "message=\"x\"/></testcase>";
  const std::string skipped_ =
      "<testcase name=\"C\" status=\"run\" result=\"skipped\" time=\"0\" classname=\"S\"><skipped "
      "message=\"no data\"/></testcase>";
  // pytest's form of a test that passed.
  const std::string python_ = "<testcase classname=\"test_x\" name=\"test_y\" time=\"0.01\"/>";
  TemporaryFolder folder_;
  std::string entries_;
};

TEST_F(CountTestsOfProcesses, CountsTheTestsNotTheProcesses) {
  entry("core/a_test", true);
  own("core.a_test", good_ + good_ + skipped_);
  entry("python/test_x", true);
  own("python.test_x", python_);
  entry("project_rules/format_test", true);  // has no report of its own
  const ProgramResult result = count();
  EXPECT_EQ(lastLine(result.out), "4 passed, 0 failed, 1 skipped");
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_NE(result.out.find("core/a_test.S.A 0.2"), std::string::npos) << result.out;
}

TEST_F(CountTestsOfProcesses, AFailedTestCountsOnceAndIsNamed) {
  entry("core/a_test", false);
  own("core.a_test", good_ + bad_);
  const ProgramResult result = count();
  EXPECT_EQ(lastLine(result.out), "1 passed, 1 failed, 0 skipped");
  EXPECT_NE(result.out.find("failed: core/a_test.S.B"), std::string::npos) << result.out;
  EXPECT_EQ(result.exitCode, 1);
}

TEST_F(CountTestsOfProcesses, AProcessThatDiedIsAFailure) {
  entry("core/a_test", false);  // no report: it crashed before it wrote one
  entry("core/b_test", false);  // it crashed after its tests had passed
  own("core.b_test", good_);
  writeFile(folder_ / "core.c_test.xml", "<testsuites><testsuite");  // .. or while it wrote
  entry("core/c_test", false);
  EXPECT_EQ(lastLine(count().out), "1 passed, 3 failed, 0 skipped");
}

TEST_F(CountTestsOfProcesses, AnEntryThatLeftNoReportHasShownNothing) {
  entry("core/a_test", true);
  own("core.a_test", good_);
  entry("core/b_test", true);
  const ProgramResult result = count();
  EXPECT_EQ(lastLine(result.out), "1 passed, 1 failed, 0 skipped");
  EXPECT_NE(result.out.find("failed: core/b_test"), std::string::npos) << result.out;
  EXPECT_EQ(result.exitCode, 1);
}

TEST_F(CountTestsOfProcesses, AFilterThatLeavesNothingHasShownNothing) {
  entry("core/a_test", true);
  own("core.a_test", "");
  const ProgramResult result = count();
  EXPECT_EQ(lastLine(result.out), "0 passed, 1 failed, 0 skipped");
  EXPECT_EQ(result.exitCode, 1);
}

// This program by itself, on tests that aren't there.
ProgramResult ownTests(const std::vector<std::string>& words, const std::string& filter = "") {
  return runProgram(std::filesystem::read_symlink("/proc/self/exe"),
                    words,
                    {{"TEST_FILTER", filter}, {"PALPATE_TEST_REPORTS", ""}});
}

TEST(TestPrograms, FailWhereTheirFileHasNoTest) {
  const ProgramResult result =
      ownTests({"--file=nowhere_test", "--entry=project_rules/nowhere_test"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.err.find("no test is selected"), std::string::npos) << result.err;
}

TEST(TestPrograms, MayBeLeftWithoutATestByAFilter) {
  EXPECT_EQ(ownTests({"--file=count_tests_test"}, "another/.*").exitCode, 0);
  EXPECT_EQ(ownTests({"--file=count_tests_test", "--gtest_filter=Another.*"}).exitCode, 0);
}

void endForWantOfATool() { PALPATE_CANNOT_SHOW("no tool"); }

TEST(CannotShow, IsAFailureWhereEverythingMustBeShown) {
  const char* before = std::getenv("PALPATE_REQUIRE_DATA");
  const std::string kept = before ? before : "";
  ::setenv("PALPATE_REQUIRE_DATA", "1", 1);
  EXPECT_FATAL_FAILURE(endForWantOfATool(), "no tool");
  ::setenv("PALPATE_REQUIRE_DATA", "0", 1);
  EXPECT_FALSE(mustShow());
  ::setenv("PALPATE_REQUIRE_DATA", kept.c_str(), 1);
}

}  // namespace
}  // namespace palpate::testing::count_tests_test
