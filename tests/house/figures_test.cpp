// What was measured and what the pages say are one: README.md and docs/*.md against docs/figures.json, by
// `scripts/measure --check`.
#include <set>

#include <gtest/gtest.h>

#include "house/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::figures_test {
namespace {
namespace fs = std::filesystem;

ProgramResult measure(const std::vector<std::string>& words) {
  return runProgram(projectFolder() / "scripts/measure", words);
}

TEST(Figures, OfThePagesAreThoseThatWereMeasured) {
  const ProgramResult result = measure({"--check"});
  EXPECT_EQ(result.exitCode, 0) << "scripts/measure --pages writes them:\n" << result.err;
}

// A project with one page and one measurement.
class FiguresOfAPage : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "docs");
    writeFile(folder_ / "docs/figures.json",
              R"({"parts": {"nist": {"commit": "12345678", "date": "2026-01-02", "machine": "m",
                  "seconds": 1, "others": 0.0, "figures": {"digits": 9.41, "runs": 54}}}})");
  }
  // What the check says of a page.
  std::string faultsOf(const std::string& page) {
    writeFile(folder_ / "README.md", page);
    const ProgramResult result = measure({"--check", "--root", folder_.path().string()});
    EXPECT_EQ(result.exitCode, result.err.empty() ? 0 : 1) << result.err;
    return result.err;
  }
  const TemporaryFolder folder_;
};

TEST_F(FiguresOfAPage, WhatWasMeasuredPasses) {
  EXPECT_EQ(faultsOf("NIST: <!--=nist.digits-->9.4<!----> digits.\n"), "");
}

TEST_F(FiguresOfAPage, AnotherFigureThanTheMeasuredOneFails) {
  const std::string faults = faultsOf("# A\nNIST: <!--=nist.digits-->9.9<!----> digits.\n");
  EXPECT_NE(faults.find("README.md:2: "), std::string::npos) << faults;
  EXPECT_NE(faults.find("<!--=nist.digits-->9.4<!---->"), std::string::npos) << faults;
}

TEST_F(FiguresOfAPage, AFigureThatNoCommandMeasuresFails) {
  EXPECT_NE(faultsOf("<!--=nist.speed-->7<!---->\n").find("no such figure: nist.speed"),
            std::string::npos);
  EXPECT_NE(faultsOf("<!-- table: wishes -->\n<!-- end of table -->\n").find("no such table"),
            std::string::npos);
}

TEST_F(FiguresOfAPage, ATypedFigureInATableOfMeasurementsFails) {
  const std::string head = "| what | figure | command |\n|---|---|---|\n";
  EXPECT_NE(
      faultsOf(head + "| a stop | worst 8.8 ms | `x` |\n").find("README.md:3: 'worst 8.8 ms'"),
      std::string::npos);
  EXPECT_EQ(faultsOf(head + "| a stop | p99 <!--=nist.digits-->9.4<!----> | `x 1` |\n"), "");
  EXPECT_EQ(faultsOf("| column | meaning |\n|---|---|\n| 1 | 2 |\n"), "") << "measures nothing";
}

TEST_F(FiguresOfAPage, PagesAreWrittenByTheScript) {
  writeFile(folder_ / "README.md",
            "<!--=nist.digits-->1<!---->\n<!-- table: accuracy -->\nold\n"
            "<!-- end of table -->\n");
  ASSERT_EQ(measure({"--pages", "--root", folder_.path().string()}).exitCode, 0);
  const std::string page = readFile(folder_ / "README.md");
  EXPECT_NE(page.find("<!--=nist.digits-->9.4<!---->\n"), std::string::npos) << page;
  EXPECT_NE(page.find("| 9.4 | "), std::string::npos) << page;
  EXPECT_NE(page.find("2026-01-02, 12345678"), std::string::npos) << page;
  EXPECT_EQ(page.find("old"), std::string::npos) << page;
  EXPECT_EQ(faultsOf(page), "");
}

TEST(MeasureScript, NamesItsPartsAndRefusesOthers) {
  const ProgramResult list = measure({"--list"});
  EXPECT_EQ(list.exitCode, 0) << list.err;
  for (const char* part : {"stops ", "escapes ", "wire ", "dsa ", "all "})
    EXPECT_NE(("\n" + list.out).find(std::string("\n") + part), std::string::npos) << part;
  const ProgramResult wrong = measure({"--no-build", "everything"});
  EXPECT_EQ(wrong.exitCode, 2);
  EXPECT_NE(wrong.err.find("no such part: everything"), std::string::npos) << wrong.err;
}

// C-D1: the least of several tries says nothing about the others.
TEST(Tests, MeasureOnce) {
  for (const SourceFile& file : cppFiles({"tests"})) {
    if (file.path == "tests/house/figures_test.cpp") continue;
    for (const char* words :
         {"timely.h", " inTime(", "kTries", "best of", "Best of", "bestUs", "bestMs"})
      EXPECT_EQ(file.text.find(words), std::string::npos) << file.path << ": " << words;
  }
}

// C-D4: a test waits for a condition (testing/awaited.h). These have time itself for their subject (moments by chance,
// the pace of a fake, what a long run needs), or look for their condition in a loop of their own.
TEST(Tests, WaitForConditionsNotForTimes) {
  const std::set<std::string> onPurpose = {"tests/benchmarks/live_window_benchmark.cpp",
                                           "tests/capture/capture_stress_test.cpp",
                                           "tests/capture/soak.h",
                                           "tests/commands/kill_recording.h",
                                           "tests/control/grasp_control_test.cpp",
                                           "tests/control/grasp_fault_test.cpp",
                                           "tests/device/babbling_channel.h",
                                           "tests/device/replug.h",
                                           "tests/house/figures_test.cpp",
                                           "tests/live/processing_chain_test.cpp",
                                           "tests/testing/awaited.h",
                                           "tests/testing/background_program.cpp",
                                           "tests/testing/process_facts.cpp"};
  for (const SourceFile& file : cppFiles({"tests"})) {
    if (file.text.find("sleep_for(") == std::string::npos) continue;
    EXPECT_TRUE(onPurpose.contains(file.path)) << file.path << ": testing/awaited.h";
  }
}

}  // namespace
}  // namespace palpate::testing::figures_test
