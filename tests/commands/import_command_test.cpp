#include "palpate/imports/import_mapping.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::import_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

// A table for the built-in flat pad of 16 x 16.
std::string padTable(int rows, const std::string& bad = "") {
  std::string text = "time_ms";
  for (int i = 0; i < 256; ++i) text += ",taxel" + std::to_string(i);
  text += "\n";
  for (int row = 0; row < rows; ++row) {
    text += std::to_string(10 * row);
    for (int i = 0; i < 256; ++i) text += "," + std::to_string((row + i) % 1000);
    text += "\n" + (row == 1 ? bad : "");
  }
  return text;
}

class ImportCommand : public ::testing::Test {
 protected:
  void SetUp() override { testing::writeFile(in("pad.csv"), padTable(20)); }
  std::string in(const char* name) const { return folder_ / name; }

  testing::TemporaryFolder folder_;
};

TEST_F(ImportCommand, MakesARecordingOfATable) {
  const auto result = palpate({"import", in("pad.csv"), "--hand", "flat_pad_16x16"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, in("pad.palpate") + ": 20 frames in 0.190 s, 100.0 Hz\n");
  const Profile profile = openRecording(in("pad.palpate"));
  ASSERT_EQ(profile.numFrames(), 20u);
  EXPECT_EQ(profile.frameTimeUs(3), 30'000);
  EXPECT_EQ(profile.frame(3).values[255], 258.0F);
  EXPECT_EQ(profile.hand().name, builtInHand("flat_pad_16x16").name);
  expectOneLineError(
      palpate({"import", in("pad.csv"), "--hand", "flat_pad_16x16"}), 1, {"exists already"});
  EXPECT_EQ(
      palpate({"import", in("pad.csv"), "--hand", "flat_pad_16x16", "--force", "-q"}).exitCode, 0);
}

TEST_F(ImportCommand, TimesThatRepeatNameTheOptionThatKeepsTheRows) {
  std::string text = padTable(4);
  text.replace(text.find("\n30,") + 1, 2, "20");
  testing::writeFile(in("pad.csv"), text);
  const auto result = palpate({"import", in("pad.csv"), "--hand", "flat_pad_16x16"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("where times repeat, --rate keeps all rows"), std::string::npos)
      << result.err;
}

TEST_F(ImportCommand, RefusedRowsAreCountedAndTheCodeSaysSo) {
  testing::writeFile(in("pad.csv"), padTable(20, "15,oops\n"));
  const auto result = palpate(
      {"import", in("pad.csv"), "--hand", "flat_pad_16x16", "-o", in("o.palpate"), "--json"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.out.find("\"wrong_count\": 1"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("1 row refused"), std::string::npos) << result.err;
  EXPECT_EQ(openRecording(in("o.palpate")).numFrames(), 20u);
  expectOneLineError(
      palpate(
          {"import", in("pad.csv"), "--hand", "flat_pad_16x16", "-o", in("p.palpate"), "--strict"}),
      1,
      {"pad.csv: line 4 has 2 cells instead of 257"});
  EXPECT_FALSE(std::filesystem::exists(in("p.palpate")));
}

TEST_F(ImportCommand, ValuesThatTheHandDoesNotHaveAreKeptAndTheCodeSaysSo) {
  std::string row = "200";
  for (int i = 0; i < 256; ++i) row += i == 3 ? ",-5" : ",1";
  testing::writeFile(in("pad.csv"), padTable(20) + row + "\n");
  const auto result = palpate(
      {"import", in("pad.csv"), "--hand", "flat_pad_16x16", "-o", in("o.palpate"), "--json"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.out.find("\"below\": 1"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("1 value outside the hand's range: 1 below 0; the first: line 22"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(openRecording(in("o.palpate")).frame(20).values[3], -5.0F);
}

TEST_F(ImportCommand, TheOrderOfThreeComponentsIsAnOption) {
  std::filesystem::create_directory(in("skin"));
  testing::writeFile(in("skin") + "/hand.json",
                     R"({"format": "palpate-hand", "version": 1, "name": "skin", "full_scale": 1000,
          "components": 3, "signed": true,
          "matrices": [{"name": "pad", "rows": 1, "columns": 2, "pitch_mm": 4.0}]})");
  testing::writeFile(in("skin.csv"), "time_s,a0,a1,a2,a3,a4,a5\n0,1,2,3,4,5,-6\n1,0,0,0,0,0,0\n");
  const auto import = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"import", in("skin.csv"), "--hand", in("skin")};
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words);
  };
  const auto preview = import({"--preview"});
  EXPECT_EQ(preview.exitCode, 0) << preview.err;
  EXPECT_NE(preview.out.find("--components planar"), std::string::npos) << preview.out;
  EXPECT_EQ(import({"-o", in("o.palpate"), "--components", "planar"}).exitCode, 0);
  EXPECT_EQ(openRecording(in("o.palpate")).frame(0).readings,
            (std::vector<float>{1, 3, 5, 2, 4, -6}));
  EXPECT_NE(import({"--components", "xyz"}).exitCode, 0);
}

TEST_F(ImportCommand, AnotherTableBecomesASeries) {
  testing::writeFile(in("ft.csv"), "t_ms,fx [N],fz [N]\n0,1,2\n5,x,4\n10,5,6\n");
  testing::writeFile(in("bare.csv"), "fx,fz\n5,1\n4,1\n6,2\n");
  const std::string wrench = "wrench=" + in("ft.csv");
  const auto import = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {
        "import", in("pad.csv"), "--hand", "flat_pad_16x16", "-o", in("o.palpate"), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words);
  };
  const auto result = import({"--series", wrench});
  EXPECT_EQ(result.exitCode, 3) << result.err;
  EXPECT_NE(result.out.find("series wrench: 2 columns (fx [N], fz [N]), 3 samples, 200.0 Hz\n"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find("1 cell of series is not a number; the first: ft.csv, line 3"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(openRecording(in("o.palpate")).series().back().name, "wrench");
  EXPECT_NE(import({"--series", wrench, "--json"}).out.find("\"name\": \"wrench\""),
            std::string::npos);
  const std::string bare = "bare=" + in("bare.csv");
  expectOneLineError(import({"--series", bare}), 1, {"(--series-rate bare=HZ)"});
  EXPECT_EQ(import({"--series", bare, "--series-rate", "bare=100"}).exitCode, 0);
  const auto preview = palpate(
      {"import", in("pad.csv"), "--hand", "flat_pad_16x16", "--preview", "--series", wrench});
  EXPECT_NE(preview.out.find("become series wrench; time: t_ms [ms]"), std::string::npos)
      << preview.out;
  expectOneLineError(import({"--series", "wrench"}), 2, {"is not NAME=FILE"});
  expectOneLineError(
      import({"--series", "Wrench=a.csv"}), 2, {"not a name of a series", "(wrench)"});
  expectOneLineError(import({"--series", wrench, "--series", wrench}), 2, {"twice"});
  expectOneLineError(import({"--series-rate", "wrench=100"}), 2, {"there is no --series"});
  expectOneLineError(
      import({"--series", wrench, "--series-rate", "wrench=0"}), 2, {"is not a rate of"});
  expectOneLineError(import({"--series", "wrench=" + in("pad.csv")}), 1, {"is the table itself"});
}

TEST_F(ImportCommand, APreviewWritesNothing) {
  const auto result = palpate({"import", in("pad.csv"), "--hand", "flat_pad_16x16", "--preview"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  for (const char* words : {"text, separated by commas, names in line 1",
                            "257 columns",
                            "#1 time_ms [ms]",
                            "taxel0 to taxel255 (256 columns)",
                            "time: time_ms [ms, by the file]",
                            "all 20 rows: 20 frames in 0.190 s, 100.0 Hz, 0 gaps"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  EXPECT_FALSE(std::filesystem::exists(in("pad.palpate")));
  expectOneLineError(
      palpate({"import", in("pad.csv"), "--hand", "flat_pad_16x16", "--preview", "--force"}),
      2,
      {"--preview writes nothing"});
}

TEST_F(ImportCommand, AMappingIsKeptAndUsedAgain) {
  testing::writeFile(in("raw.txt"), [] {
    std::string text;
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < 256; ++i) text += "0," + std::to_string(i % 10) + ";";
      text += "\n";
    }
    return text;
  }());
  const std::vector<std::string> given = {"import",     in("raw.txt"),
                                          "--hand",     "flat_pad_16x16",
                                          "-o",         in("a.palpate"),
                                          "--decimal",  "comma",
                                          "--matrix",   "0=#1..#256",
                                          "--scale",    "10",
                                          "--offset",   "5",
                                          "--rate",     "50",
                                          "--start",    "2026-11-22T10:31:05Z",
                                          "--save-map", in("m.json")};
  const auto first = palpate(given);
  EXPECT_EQ(first.exitCode, 0) << first.err;
  EXPECT_EQ(readMapping(in("m.json")).time.rateHz, 50.0);
  const auto again = palpate({"import",
                              in("raw.txt"),
                              "--hand",
                              "flat_pad_16x16",
                              "-o",
                              in("b.palpate"),
                              "--map",
                              in("m.json")});
  EXPECT_EQ(again.exitCode, 0) << again.err;
  const Profile a = openRecording(in("a.palpate"));
  const Profile b = openRecording(in("b.palpate"));
  ASSERT_EQ(a.numFrames(), 3u);
  ASSERT_EQ(b.numFrames(), 3u);
  EXPECT_EQ(a.frame(2).values, b.frame(2).values);
  EXPECT_EQ(a.frameTimeUs(2), b.frameTimeUs(2));
  EXPECT_EQ(a.frame(0).values[3], 8.0F);  // 0,3 * 10 + 5
  expectOneLineError(
      palpate({"import", in("raw.txt"), "--hand", "flat_pad_16x16"}), 1, {"--decimal comma"});
}

TEST_F(ImportCommand, RefusesOptionsThatMakeNoSense) {
  const auto refused = [&](std::vector<std::string> options, int code, const std::string& words) {
    options.insert(options.begin(), {"import", in("pad.csv")});
    expectOneLineError(palpate(options), code, {words});
  };
  refused({}, 2, "needs --hand");
  refused({"--hand", "nonesuch"}, 1, "nonesuch");
  const std::string pad = "flat_pad_16x16";
  refused({"--hand", pad, "--scale", "2"}, 2, "need --matrix");
  refused({"--hand", pad, "--rate", "10", "--time", "time_ms"}, 2, "--time");
  refused({"--hand", pad, "--rate", "0"}, 2, "--rate");
  refused({"--hand", pad, "--start", "soon"}, 2, "not a date");
  refused({"--hand", pad, "--delimiter", "pipe"}, 2, "semicolon");
  refused({"--hand", pad, "--decimal", "comma", "--delimiter", "comma"}, 1, "another delimiter");
  refused({"--hand", pad, "--matrix", "300=a"}, 2, "0 to 255");
  refused({"--hand", pad, "--matrix", "0=absent*"}, 1, "absent*");
  refused({"--hand", pad, "--matrix", "0=taxel*", "--scale", "0"}, 2, "--scale 0");
  refused({"--hand", pad, "--map", in("absent.json")}, 1, "absent.json");
  refused({"--hand", pad, "-o", in("o.csv")}, 1, "written as .palpate");
  refused({"--hand", "sdh2"}, 1, "6 matrices of 14 x 6 and 13 x 6");
  expectOneLineError(palpate({"import", in("absent.csv"), "--hand", pad}), 1, {"absent.csv"});
}

}  // namespace
}  // namespace palpate::import_command_test
