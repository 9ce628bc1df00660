// What was measured and what the pages say are one: README.md and docs/**/*.md against
// docs/figures.json, by `scripts/measure --check`.
#include <set>

#include <gtest/gtest.h>
#include <signal.h>

#include "project_rules/source_tree.h"
#include "testing/awaited.h"
#include "testing/background_program.h"
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

TEST_F(FiguresOfAPage, PagesInFoldersAreChecked) {
  fs::create_directories(folder_ / "docs/notes");
  writeFile(folder_ / "docs/notes/a.md", "<!--=nist.digits-->9.9<!---->\n");
  const std::string faults = faultsOf("# A\n");
  EXPECT_NE(faults.find("docs/notes/a.md:1: "), std::string::npos) << faults;
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

// The script as a module of Python, with parts of the test's own.
class MeasuredParts : public ::testing::Test {
 protected:
  std::vector<std::string> words(const std::string& code) const {
    return {"-c",
            "import importlib.machinery, importlib.util, os, re, sys, tempfile\n"
            "sys.dont_write_bytecode = True\n"
            "loader = importlib.machinery.SourceFileLoader('measure', sys.argv[1])\n"
            "measure = importlib.util.module_from_spec(importlib.util.spec_from_loader('measure', "
            "loader))\n"
            "loader.exec_module(measure)\n"
            "figures, tempfile.tempdir = measure.figures, sys.argv[2]\n"
            "def run(part):\n"
            "  measurer = measure.Measurer(True)\n"
            "  try: return measurer.run(part)\n"
            "  finally: measurer.close()\n" +
                code,
            (projectFolder() / "scripts/measure").string(),
            folder_.path().string()};
  }
  // What it prints.
  std::string python(const std::string& code) const {
    const ProgramResult result = runProgram("/usr/bin/python3", words(code));
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return result.out;
  }
  const TemporaryFolder folder_;
};

TEST_F(MeasuredParts, StandInACheckoutWithABlankInItsPath) {
  EXPECT_EQ(python("names = 'BENCH|PALPATE|TESTS|RECORDINGS|PYTHON|PWD'\n"
                   "for part in figures.PARTS:\n"
                   "  if re.search(rf'(?<!\")\\$({names})\\b', part.command): print(part.name)\n"
                   "  if re.search(rf'\\$({names})\\b', part.shown()): print(part.shown())\n"),
            "");
}

TEST_F(MeasuredParts, FailWithTheFirstCommandThatFails) {
  const std::string part =
      "print(run(figures.Part('x', 1, COMMAND, {'n': (figures.number('(1)'), str)}, idle=False)))";
  EXPECT_EQ(python("COMMAND = 'false\\necho 1'\n" + part), "None\n");
  EXPECT_NE(python("COMMAND = 'true\\necho 1'\n" + part).find("{'n': 1.0}"), std::string::npos);
}

TEST_F(MeasuredParts, OfSeveralOutputsHaveTheFigureOfEach) {
  EXPECT_EQ(
      python("def total(text, *more):\n"
             "  try: return figures.sum_of(r'lost (\\d)', *more)(figures.Output(text, 0, 0, 0))\n"
             "  except ValueError: return None\n"
             "print(total('found 1'), total('lost 1', 2), total('lost 1 lost 2', 2))"),
      "None None 3.0\n");
}

// The first call on an empty machine is measured by another script, at its time.
TEST_F(MeasuredParts, OfAFileHaveItsDateAndCommitAndWhatItHolds) {
  EXPECT_EQ(python("part = next(part for part in figures.PARTS if part.name == 'first_time')\n"
                   "lines = ['date 2026-01-02', 'commit 12345678'] + [\n"
                   "  f'{name} 7' for name in part.figures if name != 'program_mb']\n"
                   "part.command = 'printf \"' + '\\\\n'.join(lines) + '\"'\n"
                   "entry = run(part)\n"
                   "print(entry['date'], entry['commit'], entry['figures'].get('program_mb'),\n"
                   "      entry['figures']['tests_mb'])"),
            "2026-01-02 12345678 None 7.0\n");
}

TEST_F(MeasuredParts, LeaveNothingBehindWhenTheScriptIsEnded) {
  BackgroundProgram script(
      "/usr/bin/python3",
      words("figures.PARTS = [figures.Part('x', 60, f'echo $$ > {sys.argv[2]}/pid.part; '\n"
            "  f'mv {sys.argv[2]}/pid.part {sys.argv[2]}/pid; sleep 600', {}, idle=False)]\n"
            "sys.argv = ['measure', '--no-build', 'x']\n"
            "sys.exit(measure.main())"));
  ASSERT_TRUE(awaited([&] { return fs::exists(folder_ / "pid"); })) << script.err();
  script.signal(SIGTERM);
  EXPECT_EQ(script.wait(), 143);
  const pid_t command = std::stoi(readFile(folder_ / "pid"));
  fs::remove(folder_ / "pid");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  EXPECT_NE(::kill(command, 0), 0) << "its command still runs";
}

// C-D1: the least of several tries says nothing about the others.
TEST(Tests, MeasureOnce) {
  for (const SourceFile& file : cppFiles({"tests"})) {
    if (file.path == "tests/project_rules/figures_test.cpp") continue;
    for (const char* words :
         {"timely.h", " inTime(", "kTries", "best of", "Best of", "bestUs", "bestMs"})
      EXPECT_EQ(file.text.find(words), std::string::npos) << file.path << ": " << words;
  }
}

// C-D4: a test waits for a condition (testing/awaited.h). These have time itself for their subject
// (moments by chance, the pace of a fake, what a long run needs), or look for their condition in a
// loop of their own.
TEST(Tests, WaitForConditionsNotForTimes) {
  const std::set<std::string> onPurpose = {"tests/benchmarks/live_window_benchmark.cpp",
                                           "tests/capture/capture_stress_test.cpp",
                                           "tests/capture/series_recording_test.cpp",
                                           "tests/capture/soak.h",
                                           "tests/commands/kill_recording.h",
                                           "tests/control/grasp_control_test.cpp",
                                           "tests/control/grasp_fault_test.cpp",
                                           "tests/device/babbling_channel.h",
                                           "tests/device/replug.h",
                                           "tests/project_rules/figures_test.cpp",
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
