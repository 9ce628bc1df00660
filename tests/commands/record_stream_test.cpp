// The real program records streams of other hands: from standard input, and what it refuses.
#include "palpate/core/error.h"
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
ProgramResult recordText(const TemporaryFolder& folder, const std::string& text) {
  const auto file = folder / "lines.txt";
  writeFile(file, text);
  const TemporaryFolder home;
  return runProgram(
      "/bin/sh",
      {"-c",
       std::string("exec '") + PALPATE_PROGRAM + "' record --stream - --hand " + kPad + " -o '" +
           (folder / "a.palpate").string() + "' < '" + file.string() + "'"},
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
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("1 refused (the last: line 3: 255 numbers instead of 256)"),
            std::string::npos)
      << result.out;
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
