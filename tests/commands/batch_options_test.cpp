#include <csignal>
#include <filesystem>

#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "testing/background_program.h"

namespace palpate::batch_options_test {
namespace {

namespace fs = std::filesystem;
using testing::expectOneLineError;
using testing::palpate;

class BatchOptionsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "in/deep");
    ASSERT_EQ(palpate({"synthesize", "-o", in("a.dsa"), "--duration", "2"}).exitCode, 0);
    fs::copy_file(in("a.dsa"), in("deep/b.dsa"));
  }
  std::string in(const std::string& name = {}) const { return folder_ / ("in/" + name); }
  std::string out(const std::string& name) const { return folder_ / ("out/" + name); }
  // What stands behind the lines of the results.
  static std::string summary(std::size_t done, std::size_t skipped, std::size_t failed) {
    const auto row = [](std::string name, std::size_t count) {
      name.resize(14, ' ');
      const std::string number = std::to_string(count);
      return name + std::string(6 - number.size(), ' ') + number + "\n";
    };
    return row("done", done) + row("skipped", skipped) + row("failed", failed);
  }
  testing::TemporaryFolder folder_;
};

TEST_F(BatchOptionsTest, SignalsOfEachRecordingAreThoseOfTheCommand) {
  const auto result = palpate({"signals", in(), "-o", out("{name}.csv"), "--threads", "2"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(
      result.out,
      out("a.csv") + ": 64 frames\n" + out("deep/b.csv") + ": 64 frames\n" + summary(2, 0, 0));
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(testing::readFile(out("deep/b.csv")) == palpate({"signals", in("deep/b.dsa")}).out);
}

TEST_F(BatchOptionsTest, SlipFeaturesAndConversionsToo) {
  EXPECT_EQ(palpate({"slip", in(), "-o", out("{name}.csv"), "-q"}).exitCode, 0);
  EXPECT_TRUE(testing::readFile(out("a.csv")) == palpate({"slip", in("a.dsa")}).out);
  EXPECT_EQ(palpate({"slip", in(), "--segments", "-o", out("{name}.slips.csv"), "-q"}).exitCode, 0);
  EXPECT_TRUE(testing::readFile(out("a.slips.csv")) ==
              palpate({"slip", in("a.dsa"), "--segments"}).out);
  // Long enough for a grasp.
  const std::string recording = folder_ / "long.dsa";
  ASSERT_EQ(palpate({"synthesize", "-o", recording, "--duration", "12"}).exitCode, 0);
  const std::string features = out("{name}.features.csv");
  EXPECT_EQ(palpate({"features", recording, "--set", "statistics", "-o", features, "-q"}).exitCode,
            0);
  EXPECT_TRUE(testing::readFile(out("long.features.csv")) ==
              palpate({"features", recording, "--set", "statistics"}).out);
  EXPECT_EQ(palpate({"convert", in(), "-o", out("{folder}/{name}.npz"), "-q"}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("a.dsa"), (folder_ / "one.npz").string()}).exitCode, 0);
  EXPECT_TRUE(testing::readFile(out("a.npz")) == testing::readFile(folder_ / "one.npz"));
}

TEST_F(BatchOptionsTest, ResumesAndReports) {
  const std::string report = folder_ / "report.csv";
  testing::writeFile(in("bad.dsa"), "hello");
  const std::vector<std::string> words = {
      "signals", in(), "-o", out("{name}.csv"), "--resume", "--report", report};
  const auto first = palpate(words);
  EXPECT_EQ(first.exitCode, 3);
  EXPECT_EQ(std::count(first.err.begin(), first.err.end(), '\n'), 1) << first.err;
  EXPECT_NE(first.out.find(summary(2, 0, 1)), std::string::npos) << first.out;
  fs::remove(out("a.csv"));
  const auto second = palpate(words);
  EXPECT_EQ(second.exitCode, 3);
  EXPECT_NE(second.out.find(summary(1, 1, 1)), std::string::npos) << second.out;
  EXPECT_TRUE(fs::exists(out("a.csv")));
  const std::string table = testing::readFile(report);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;
  EXPECT_EQ(table.rfind("source,result,state,text,files\n", 0), 0U) << table;
  EXPECT_NE(table.find(",skipped,"), std::string::npos) << table;
  EXPECT_NE(table.find(",failed,"), std::string::npos) << table;
}

TEST_F(BatchOptionsTest, FoldersAreConvertedByTheOldWordsToo) {
  const std::vector<std::string> words = {
      "convert", in(), out(""), "--to-form", "npz", "--resume", "-q"};
  EXPECT_EQ(palpate(words).exitCode, 0);
  EXPECT_TRUE(fs::exists(out("deep/b.npz")));
  // It is a batch also without its options, which leaves no table behind the lines.
  const auto plain = palpate({"convert", in(), folder_ / "plain", "--to-form", "npz"});
  EXPECT_EQ(plain.exitCode, 0) << plain.err;
  EXPECT_EQ(plain.out,
            (folder_ / "plain/a.npz").string() + ": 64 frames\n" +
                (folder_ / "plain/deep/b.npz").string() + ": 64 frames\n");
  const auto braces = palpate({"convert", in(), folder_ / "{x}", "--to-form", "npz", "-q"});
  EXPECT_EQ(braces.exitCode, 0) << braces.err;
  EXPECT_TRUE(testing::readFile(folder_ / "{x}/a.npz") == testing::readFile(out("a.npz")));
  const auto again = palpate({"convert", in(), out(""), "--to-form", "npz", "--resume"});
  EXPECT_EQ(again.exitCode, 0) << again.err;
  EXPECT_NE(again.out.find(summary(0, 2, 0)), std::string::npos) << again.out;
}

TEST_F(BatchOptionsTest, BadInputGetsOneLine) {
  fs::create_directories(folder_ / "empty");
  expectOneLineError(
      palpate({"signals", folder_ / "empty", "-o", out("{name}.csv")}), 1, {"no recording"});
  expectOneLineError(
      palpate({"signals", in(), "-o", in("made/{name}.csv")}), 1, {"is in the folder"});
  expectOneLineError(
      palpate({"signals", in(), "-o", out("{hand}.csv")}), 2, {"{hand} isn't known"});
  expectOneLineError(palpate({"signals", in(), "-o", out("{name}.txt")}),
                     2,
                     {"must end in .csv, .json, .npz, .mat, .h5, .hdf5, .mcap"});
  expectOneLineError(palpate({"signals", in(), "--units-row", "-o", out("{name}.npz")}),
                     2,
                     {"--units-row is for .csv"});
  expectOneLineError(palpate({"convert", in(), "-o", out("{name}.txt")}), 2, {".palpate"});
  expectOneLineError(palpate({"signals", in(), "--resume"}), 2, {"--resume needs -o"});
  expectOneLineError(palpate({"convert", in("a.dsa"), "-o", out("{name}.npz"), "--from", "3"}),
                     2,
                     {"--from doesn't go with -o"});
  expectOneLineError(palpate({"convert", in("a.dsa")}), 2, {"-o TEMPLATE"});
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  testing::writeFile(folder_ / "out", "a file");
  expectOneLineError(palpate({"signals", in(), "-o", out("{name}.csv")}), 1, {"out"});
}

TEST_F(BatchOptionsTest, UnitsStandInTheSecondRowOfEachTable) {
  for (const std::string command : {"signals", "slip"}) {
    const std::string names = out(command + "_{name}.csv");
    EXPECT_EQ(palpate({command, in(), "--units-row", "-o", names, "-q"}).exitCode, 0);
    EXPECT_TRUE(testing::readFile(out("deep/" + command + "_b.csv")) ==
                palpate({command, in("deep/b.dsa"), "--units-row"}).out)
        << command;
  }
  expectOneLineError(palpate({"convert", in(), "-o", out("{name}.npz"), "--units-row"}),
                     2,
                     {"--units-row is for .csv"});
  for (const std::string command : {"signals", "features"}) {
    expectOneLineError(palpate({command, in(), "-o", out("{name}.json"), "--units-row"}),
                       2,
                       {"--units-row is for .csv"});
    expectOneLineError(
        palpate({command, in(), "-o", out("{name}.csv"), "--json"}), 2, {"end in .json"});
  }
}

// All files below a folder but hidden ones.
std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& each : fs::recursive_directory_iterator(folder))
    if (each.is_regular_file() && each.path().filename() != ".palpate_batch")
      files.push_back(each.path());
  return files;
}

TEST_F(BatchOptionsTest, CtrlCLeavesWholeFilesAndResumeGoesOn) {
  constexpr std::size_t kFiles = 200;
  ASSERT_EQ(palpate({"synthesize", "-o", in("0.dsa"), "--duration", "20"}).exitCode, 0);
  fs::remove_all(in("deep"));
  fs::remove(in("a.dsa"));
  for (std::size_t i = 1; i < kFiles; ++i)
    fs::create_hard_link(in("0.dsa"), in(std::to_string(i) + ".dsa"));
  const std::string whole = palpate({"signals", in("0.dsa")}).out;
  const std::vector<std::string> words = {"signals", in(), "-o", out("{name}.csv"), "--resume"};
  for (const int number : {SIGINT, SIGTERM}) {
    testing::BackgroundProgram program(PALPATE_PROGRAM, words);
    ASSERT_TRUE(program.awaitLine(" frames")) << program.err();
    program.signal(number);
    EXPECT_EQ(program.wait(), 3);
    // Standard error is no terminal: it has no line of progress.
    EXPECT_EQ(program.err().rfind("palpate: interrupted: ", 0), 0U) << program.err();
    const std::string err = program.err();
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_NE(err.find("of 200 are done; continue with --resume"), std::string::npos);
    EXPECT_NE(program.out().find("\nnot done "), std::string::npos) << program.out();
    EXPECT_LT(filesBelow(out("")).size(), kFiles);
  }
  const std::size_t before = filesBelow(out("")).size();
  for (const fs::path& file : filesBelow(out("")))
    EXPECT_TRUE(testing::readFile(file) == whole) << file;
  const auto rest = palpate(words);
  EXPECT_EQ(rest.exitCode, 0) << rest.err;
  EXPECT_EQ(rest.err, "");
  EXPECT_NE(rest.out.find(summary(kFiles - before, before, 0)), std::string::npos);
  EXPECT_EQ(filesBelow(out("")).size(), kFiles);
}

// As on a full disk: no file may be larger than 8 kB.
TEST_F(BatchOptionsTest, WhatCanNotBeWrittenFailsWithALineEach) {
  const auto result = testing::runProgram("/bin/bash",
                                          {"-c",
                                           "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\"",
                                           PALPATE_PROGRAM,
                                           "signals",
                                           in(),
                                           "-o",
                                           out("{name}.csv"),
                                           "--report",
                                           folder_ / "report.csv"});
  EXPECT_EQ(result.exitCode, 1) << result.out;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
  EXPECT_NE(result.err.find("a.csv"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("deep/b.csv"), std::string::npos) << result.err;
  EXPECT_TRUE(filesBelow(out("")).empty());
  const auto again = palpate({"signals", in(), "-o", out("{name}.csv"), "--resume"});
  EXPECT_EQ(again.exitCode, 0) << again.err;
}

TEST_F(BatchOptionsTest, TwoRecordingsNeverGetOneResult) {
  fs::copy_file(in("a.dsa"), in("deep/a.dsa"));
  expectOneLineError(
      palpate({"signals", in(), "-o", out("{folder}x.csv")}), 1, {"from both", "deep/a.dsa"});
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace palpate::batch_options_test
