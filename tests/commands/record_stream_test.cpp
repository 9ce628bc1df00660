// The real program records streams of other hands: from standard input, and what it refuses.
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::record_stream_test {
namespace {
using namespace testing;

constexpr const char* kPad = "flat_pad_16x16";

std::string line(int n, int numbers = 256) {
  std::string text = "frame#" + std::to_string(n);
  for (int k = 0; k < numbers; ++k) text += "," + std::to_string((7 * n + 3 * k) % 1000);
  return text + "\n";
}

// Records what a shell prints on the program's standard input.
ProgramResult recordText(const TemporaryFolder& folder,
                         const std::string& text,
                         const std::string& hand = kPad,
                         const std::string& more = "") {
  const auto file = folder / "lines.txt";
  writeFile(file, text);
  const TemporaryFolder home;
  return runProgram(
      "/bin/sh",
      {"-c",
       std::string("exec '") + PALPATE_PROGRAM + "' record --stream - --hand '" + hand + "' " +
           more + " -o '" + (folder / "a.palpate").string() + "' < '" + file.string() + "'"},
      {{"HOME", home.path().string()}, {"XDG_DATA_HOME", home.path().string()}});
}

TEST(RecordStream, EveryLineOfStandardInputIsRecorded) {
  const TemporaryFolder folder;
  std::string text;
  for (int n = 0; n < 300; ++n) text += line(n);
  const ProgramResult result = recordText(folder, text);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("300 frames"), std::string::npos) << result.out;
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.numFrames(), 300u);
  for (std::size_t n = 0; n < 300; ++n)
    for (std::size_t k = 0; k < 256; ++k)
      ASSERT_EQ(profile.frame(n).values[k], static_cast<float>((7 * n + 3 * k) % 1000));
}

TEST(RecordStream, TheLastRefusedLineIsNamed) {
  const TemporaryFolder folder;
  const ProgramResult result = recordText(folder, line(0) + line(1) + line(2, 255));
  EXPECT_EQ(result.exitCode, 3) << result.err;
  EXPECT_EQ(result.err, "palpate: 1 refused (the last: line 3: 255 numbers instead of 256)\n");
}

// The hand is recorded without it.
TEST(RecordStream, ASeriesThatIsNotThereIsTold) {
  const TemporaryFolder folder;
  const ProgramResult result =
      recordText(folder, line(0) + line(1), kPad, "--series wrist=tcp:127.0.0.1:1");
  EXPECT_EQ(result.exitCode, 3) << result.err;
  EXPECT_NE(result.err.find("series wrist: no row was recorded"), std::string::npos) << result.err;
  EXPECT_EQ(openRecording(folder / "a.palpate").numFrames(), 2u);
}

TEST(RecordStream, SeriesThatCannotBeReadAreRefused) {
  for (const char* more : {"--series wrist",
                           "--series Wrist=tcp:127.0.0.1:1",
                           "--series wrist=udp:nine",
                           "--series wrist=-",
                           "--series wrist=udp:0 --series wrist=udp:0",
                           "--series angles=udp:0",
                           "--series wrist=udp:0 --series-columns 'wrist=a,a'",
                           "--series-columns wrist=a"}) {
    const TemporaryFolder folder;
    const ProgramResult result = recordText(folder, line(0), kPad, more);
    EXPECT_EQ(result.exitCode, 2) << more << result.err;
  }
}

// A pad of 2 x 3, full scale 1023.
std::string smallPad(const TemporaryFolder& folder) {
  std::filesystem::create_directory(folder / "pad");
  writeFile(folder / "pad/hand.json",
            R"({"format":"palpate-hand","version":1,"name":"Pad","full_scale":1023,)"
            R"("matrices":[{"name":"pad","rows":2,"columns":3,"pitch_mm":5.0}]})");
  return (folder / "pad").string();
}

// stranger S2, S9.
TEST(RecordStream, LabelsAreTaxelsAndALineWithoutEndIsNone) {
  const TemporaryFolder folder;
  const ProgramResult result = recordText(folder,
                                          "p5:6 p4:5 p3:4 p2:3 p1:2 p0:1\n"
                                          "p5:60 p4:50 p3:40 p2:30 p1:20 p0:14",
                                          smallPad(folder));
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.err,
            "palpate: 1 refused (the last: line 2: the last line has no end: its last number may "
            "be cut off)\n");
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.numFrames(), 1u);
  EXPECT_EQ(profile.frame(0).values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  const TemporaryFolder other;
  const ProgramResult named = recordText(other, "f:1 e:2 d:3 c:4 b:5 a:6\n", smallPad(other));
  EXPECT_EQ(named.exitCode, 0);
  EXPECT_NE(named.err.find("the labels (\"f\" to \"a\") don't say which taxel each is"),
            std::string::npos)
      << named.err;
}

// stranger 52: each second frame was that of an IMU, and a temperature was a force.
TEST(RecordStream, OtherLinesAreLeftOutAndNamed) {
  const TemporaryFolder folder;
  const ProgramResult result = recordText(
      folder, "pad:1,2,3,4,5,6\nimu:0,1,2,900,5,6\npad:7,8,9,10,11,12\n", smallPad(folder));
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.err,
            "palpate: 1 refused (the last: line 2: \"imu\" is not one of the hand's names, and its "
            "frames come without it)\n");
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frame(1).values, (std::vector<float>{7, 8, 9, 10, 11, 12}));
}

TEST(RecordStream, ALoneLineWithAnotherNameIsAFrameAndSaid) {
  const TemporaryFolder folder;
  const ProgramResult result = recordText(folder, "raw:1,2,3,4,5,6\n", smallPad(folder));
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.err,
            "palpate: lines with \"raw\" are taken for the frames: it is not one of the hand's "
            "names, but no other lines are frames\n");
}

TEST(RecordStream, ValuesOverTheFullScaleAreKeptAndTold) {
  const TemporaryFolder folder;
  std::string text;
  for (int n = 0; n < 40; ++n) {
    for (int k = 0; k < 6; ++k) text += (k ? "," : "") + std::to_string(40 * (6 * n + k));
    text += "\n";
  }
  const ProgramResult result = recordText(folder, text, smallPad(folder));
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("36 frames with values outside the hand's range (the last: line 40: "
                            "value 1 is 9360, not in 0..1023 counts)"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("full_scale in hand.json"), std::string::npos) << result.err;
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.numFrames(), 40u);
  EXPECT_EQ(profile.frame(39).values, (std::vector<float>{9360, 9400, 9440, 9480, 9520, 9560}));
}

TEST(RecordStream, LossesAreInTheFileWithTheFigureThatIsPrinted) {
  const TemporaryFolder folder;
  std::string text;
  for (int n = 0; n < 200; ++n)
    if (n % 6 != 5) text += line(n);
  const ProgramResult result = recordText(folder, text + line(200, 255), kPad, "--json");
  EXPECT_EQ(result.exitCode, 3) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("lost").asInteger(), 33);
  EXPECT_EQ(json.at("last_refused").asString(), "line 168: 255 numbers instead of 256");
  const auto info = palpate({"info", folder / "a.palpate", "--json"});
  ASSERT_EQ(Json::parse(info.out).at("lost").size(), 1u) << info.out;
  EXPECT_EQ(Json::parse(info.out).at("lost").at(0).at("lost").asInteger(), 33);
}

TEST(RecordStream, WhatTheFirstNumberIsTakenForIsSaid) {
  const TemporaryFolder folder;
  std::string ascends, constant;
  for (int n = 0; n < 40; ++n) {
    ascends += std::to_string(10 * n) + ",6,7,8,9,10,300\n";
    constant += "5,6,7,8,9,10,300\n";
  }
  const ProgramResult told = recordText(folder, ascends, smallPad(folder));
  EXPECT_EQ(told.exitCode, 0);
  EXPECT_EQ(told.err,
            "palpate: the first of 7 numbers of a frame is taken for its time in milliseconds; if "
            "it is not, name its unit (--time s, ms or us) or --time none\n");
  const TemporaryFolder other;
  const ProgramResult refused = recordText(other, constant, smallPad(other));
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_NE(refused.err.find("does not ascend"), std::string::npos) << refused.err;
}

TEST(RecordStream, WithoutAFrameTheReasonIsSaid) {
  const TemporaryFolder folder;
  expectOneLineError(recordText(folder, line(0, 255)),
                     1,
                     {"no frame arrived", "line 1: 255 numbers instead of 256"});
  EXPECT_FALSE(std::filesystem::exists(folder / "a.palpate"));
}

TEST(RecordStream, RefusesOptionsThatMakeNoSense) {
  const auto refused = [](std::vector<std::string> options, const std::string& word) {
    options.insert(options.begin(), "record");
    options.insert(options.end(), {"-o", "a.palpate"});
    expectOneLineError(palpate(options), 2, {word});
  };
  refused({"--stream", "udp:0"}, "--stream needs --hand");
  refused({"--stream", "udp:0", "--hand", kPad, "--dsa", "x"}, "not both");
  refused({"--dsa", "x", "--format", "lines"}, "--format needs --stream");
  refused({"--stream", "udp:x", "--hand", kPad}, "is not udp:[ADDRESS:]PORT");
  refused({"--stream", "udp:0", "--hand", kPad, "--format", "xml"}, "xml");
  refused({"--stream", "udp:0", "--hand", kPad, "--format", "binary", "--time", "s"}, "--time");
  refused({"--stream", "udp:0", "--hand", kPad, "--baud", "10"}, "baud");
}

}  // namespace
}  // namespace palpate::record_stream_test
