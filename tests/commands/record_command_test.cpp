// The real program on an emulated hand that runs in the test: what the hand sends is what is
// recorded.
#include <csignal>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "emulator/numbered_hand.h"
#include "testing/awaited.h"
#include "testing/background_program.h"

namespace palpate::record_command_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

std::unique_ptr<EmulatedHand> handAt(double hz) {
  EmulatedHandOptions options;
  options.rate = EmulationRate::kFixed;
  options.hz = hz;
  return std::make_unique<EmulatedHand>(std::make_unique<NumberedHand>(), options);
}

// Each frame is one that was sent, none is missing in between.
void expectConsecutive(const std::vector<fs::path>& paths) {
  std::optional<std::uint64_t> last;
  for (const fs::path& path : paths) {
    const Profile profile = openRecording(path);
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      const auto number = NumberedHand::numberOf(profile.frame(i).values);
      ASSERT_TRUE(number) << path << ", frame " << i << " was never sent";
      ASSERT_EQ(*number, last.value_or(*number - 1) + 1) << path << ", frame " << i;
      last = number;
    }
  }
}

// Waits until an unfinished recording holds so many frames.
bool awaitFrames(const fs::path& path, std::size_t frames) {
  return testing::awaited([&] {
    try {
      return openRecording(path).numFrames() >= frames;
    } catch (const Error&) {  // not there yet
      return false;
    }
  });
}

TEST(RecordCommand, RecordsWhatTheHandSends) {
  const TemporaryFolder folder;
  const auto hand = handAt(100.0);
  const auto result = palpate({"record",
                               "--dsa",
                               hand->dsaPort(),
                               "--sdh",
                               hand->sdhPort(),
                               "-o",
                               folder / "a.palpate",
                               "--duration",
                               "1.5",
                               "--json",
                               "--operator",
                               "Ada"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json json = Json::parse(result.out);
  const Profile profile = openRecording(folder / "a.palpate");
  EXPECT_EQ(json.at("frames").asInteger(), static_cast<std::int64_t>(profile.numFrames()));
  EXPECT_EQ(json.at("angles").asInteger(), static_cast<std::int64_t>(profile.numAngles()));
  EXPECT_EQ(json.at("temperatures").asInteger(),
            static_cast<std::int64_t>(profile.numTemperatures()));
  EXPECT_EQ(json.at("bad_checksums").asInteger(), 0);
  EXPECT_EQ(json.at("lost").asInteger(), 0);
  EXPECT_EQ(json.at("gaps").asInteger(), 0);
  EXPECT_NEAR(json.at("rate_hz").asDouble(), 100.0, 15.0);
  EXPECT_NEAR(json.at("mean_rate_hz").asDouble(), 100.0, 10.0);
  EXPECT_TRUE(json.at("complete").asBool());
  // S counts from the first frame.
  EXPECT_LT(profile.durationUs(), 1'500'000);
  EXPECT_GT(profile.durationUs(), 1'300'000);
  EXPECT_GT(profile.numAngles(), 60u);
  EXPECT_GE(profile.numTemperatures(), 1u);
  expectConsecutive({folder / "a.palpate"});
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
}

// The numbered hand touches from its first frame on.
TEST(RecordCommand, ContactBeginsItAndItsDurationCountsFromThere) {
  const TemporaryFolder folder;
  const auto hand = handAt(100.0);
  const auto result = palpate({"record",
                               "--dsa",
                               hand->dsaPort(),
                               "-o",
                               folder / "a.palpate",
                               "--start-on-contact",
                               "--stop-without-contact",
                               "5",
                               "--duration",
                               "1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Profile profile = openRecording(folder / "a.palpate");
  EXPECT_GT(profile.durationUs(), 800'000);
  EXPECT_LT(profile.durationUs(), 3'000'000) << "with the two seconds before, at most";
  expectConsecutive({folder / "a.palpate"});
}

TEST(RecordCommand, ASignalEndsItCleanly) {
  const TemporaryFolder folder;
  const auto hand = handAt(100.0);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const fs::path path = folder / (std::to_string(number) + ".palpate");
    BackgroundProgram program(PALPATE_PROGRAM,
                              {"record", "--dsa", hand->dsaPort(), "-o", path.string()});
    ASSERT_TRUE(awaitFrames(path, 20));
    program.signal(number);
    EXPECT_EQ(program.wait(), 0) << program.err();
    EXPECT_NE(program.out().find(" frames in "), std::string::npos) << program.out();
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
    EXPECT_FALSE(fs::exists(path.string() + "-journal"));
    EXPECT_FALSE(fs::exists(path.string() + ".lock"));
    expectConsecutive({path});
  }
}

TEST(RecordCommand, AnMcapFileBesideEachPartHoldsTheSame) {
  const TemporaryFolder folder;
  const auto hand = handAt(300.0);
  const auto result = palpate({"record",
                               "--dsa",
                               hand->dsaPort(),
                               "-o",
                               folder / "a.palpate",
                               "--duration",
                               "1.5",
                               "--split-minutes",
                               "0.0167",
                               "--mcap",
                               "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out).at("mcap_files").size(), 2u);
  for (const char* name : {"a", "a_002"}) {
    const Profile native = openRecording(folder / (name + std::string(".palpate")));
    const Profile mcap = openRecording(folder / (name + std::string(".mcap")));
    ASSERT_EQ(native.numFrames(), mcap.numFrames());
    for (std::size_t i = 0; i < native.numFrames(); ++i) {
      ASSERT_EQ(native.frame(i).values, mcap.frame(i).values);
      ASSERT_EQ(native.frame(i).deviceUs, mcap.frame(i).deviceUs);
    }
  }
  const auto again = palpate(
      {"record", "--dsa", hand->dsaPort(), "-o", folder / "a_002.palpate", "--duration", "1"});
  EXPECT_EQ(again.exitCode, 1);
}

// The emulated hand goes on; what was in the file for a second is there.
TEST(RecordCommand, OfAKilledProcessTheMcapFileHasItsWholeChunks) {
  const TemporaryFolder folder;
  const auto hand = handAt(300.0);
  const fs::path path = folder / "a.palpate";
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"record", "--dsa", hand->dsaPort(), "-o", path.string(), "--mcap"});
  ASSERT_TRUE(awaitFrames(path, 900));
  program.signal(SIGKILL);
  program.wait();
  const auto opened = palpate({"convert", folder / "a.mcap", folder / "c.palpate"});
  EXPECT_EQ(opened.exitCode, 1);
  EXPECT_NE(opened.err.find("'palpate recover'"), std::string::npos) << opened.err;
  EXPECT_EQ(palpate({"recover", folder / "a.mcap", folder / "b.palpate"}).exitCode, 3);
  const Profile saved = openRecording(folder / "b.palpate");
  const Profile native = openRecording(path);
  EXPECT_GT(saved.numFrames(), 200u);
  ASSERT_LE(saved.numFrames(), native.numFrames());
  for (std::size_t i = 0; i < saved.numFrames(); ++i) {
    ASSERT_EQ(saved.frameTimeUs(i), native.frameTimeUs(i));
    ASSERT_EQ(saved.frame(i).values, native.frame(i).values);
  }
}

TEST(RecordCommand, AHandThatIsGoneAtTheEndIsToldByTheExitCode) {
  const TemporaryFolder folder;
  EmulatedHandOptions options;
  options.rate = EmulationRate::kFixed;
  options.hz = 100.0;
  options.faults.unplugs = {{.atS = 2.0, .durationS = 60.0}};
  const EmulatedHand hand(std::make_unique<NumberedHand>(), options);
  const auto result = palpate({"record",
                               "--dsa",
                               hand.dsaPort(),
                               "-o",
                               folder / "a.palpate",
                               "--duration",
                               "4.0",
                               "--quiet"});
  EXPECT_EQ(result.exitCode, 3) << result.err;
  EXPECT_EQ(result.err.find("palpate: no frame came in its last "), 0u) << result.err;
}

// F2 of the attack. All is in the files that are named, and the exit code says that it isn't as it
// was asked for.
TEST(RecordCommand, AFileThatIsDeletedRenamedOrReplacedIsKeptAndToldOf) {
  enum class What { kDeleted, kRenamed, kReplaced, kFolderDeleted, kFolderMoved };
  for (const What what : {What::kDeleted,
                          What::kRenamed,
                          What::kReplaced,
                          What::kFolderDeleted,
                          What::kFolderMoved}) {
    SCOPED_TRACE(static_cast<int>(what));
    const TemporaryFolder folder;
    const fs::path here = folder / "here", home = folder / "home", path = here / "a.palpate";
    fs::create_directory(here);
    fs::create_directory(home);
    const auto hand = handAt(100.0);
    BackgroundProgram program("/usr/bin/env",
                              {"HOME=" + home.string(),
                               PALPATE_PROGRAM,
                               "record",
                               "--dsa",
                               hand->dsaPort(),
                               "-o",
                               path.string(),
                               "--json"});
    ASSERT_TRUE(awaitFrames(path, 20));
    fs::path kept = path;
    if (what == What::kDeleted) fs::remove(path);
    if (what == What::kRenamed) fs::rename(path, here / "mine.palpate");
    if (what == What::kReplaced) {
      writeFile(here / "new", "somebody's");
      fs::rename(here / "new", path);
      kept = here / "a_continued.palpate";
    }
    if (what == What::kFolderDeleted) fs::remove_all(here);
    if (what == What::kFolderMoved) fs::rename(here, folder / "there");
    if (what == What::kFolderDeleted || what == What::kFolderMoved) kept = home / "a.palpate";
    ASSERT_TRUE(awaitFrames(kept, 60)) << program.err();
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 3) << program.err();
    const Json json = Json::parse(program.out());
    ASSERT_EQ(json.at("files").size(), 1u);
    EXPECT_EQ(json.at("files").at(0).asString(), kept.string());
    EXPECT_FALSE(json.at("complete").asBool());
    EXPECT_EQ(json.at("recorder_lost").asInteger(), 0);
    EXPECT_NE(json.at("message").asString().find("is gone"), std::string::npos);
    EXPECT_NE(program.err().find(kept.string()), std::string::npos) << program.err();
    EXPECT_EQ(verifyRecording(kept).state, VerifyReport::State::kSound);
    EXPECT_EQ(json.at("frames").asInteger(),
              static_cast<std::int64_t>(openRecording(kept).numFrames()));
    expectConsecutive({kept});
    if (what == What::kReplaced) {
      EXPECT_EQ(readFile(path), "somebody's");
    }
    if (what == What::kRenamed) {
      const fs::path whole = folder / "whole.palpate";
      EXPECT_EQ(palpate({"recover", here / "mine.palpate", whole}).exitCode, 0);
      expectConsecutive({whole});
    }
  }
}

TEST(RecordCommand, SplitPartsHoldEverythingOnce) {
  const TemporaryFolder folder;
  const auto hand = handAt(300.0);
  const auto result = palpate({"record",
                               "--dsa",
                               hand->dsaPort(),
                               "-o",
                               folder / "a.palpate",
                               "--duration",
                               "2.5",
                               "--split-minutes",
                               "0.0167",
                               "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<fs::path> parts{
      folder / "a.palpate", folder / "a_002.palpate", folder / "a_003.palpate"};
  EXPECT_EQ(Json::parse(result.out).at("files").size(), 3u);
  std::size_t frames = 0;
  for (const fs::path& part : parts) frames += openRecording(part).numFrames();
  EXPECT_EQ(Json::parse(result.out).at("frames").asInteger(), static_cast<std::int64_t>(frames));
  expectConsecutive(parts);
}

TEST(RecordCommand, NamesFromATemplateCountUp) {
  const TemporaryFolder folder;
  const auto hand = handAt(100.0);
  for (int i = 0; i < 2; ++i) {
    const auto result = palpate({"record",
                                 "--dsa",
                                 hand->dsaPort(),
                                 "-o",
                                 folder / "{object}_{run}.palpate",
                                 "--object",
                                 "../foam ball",
                                 "--duration",
                                 "0.2"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
  }
  EXPECT_EQ(openRecording(folder / "foam_ball_001.palpate").info().format, "palpate");
  EXPECT_EQ(openRecording(folder / "foam_ball_002.palpate").info().format, "palpate");
}

TEST(RecordCommand, WithoutAFrameItFailsAndLeavesNothing) {
  const TemporaryFolder folder;
  EmulatedHandOptions options;
  options.rate = EmulationRate::kFixed;
  EmulatedHand mute(std::make_unique<NumberedHand>(), options);
  mute.mute(true);
  expectOneLineError(
      palpate({"record", "--dsa", mute.dsaPort(), "-o", folder / "a.palpate", "--wait", "0.5"}),
      1,
      {mute.dsaPort(), "no frame"});
  expectOneLineError(
      palpate({"record", "--dsa", folder / "no_port", "-o", folder / "a.palpate", "--wait", "0.3"}),
      1,
      {"no_port", "no frame"});
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"record", "--dsa", mute.dsaPort(), "-o", folder / "a.palpate"});
  program.signal(SIGINT);  // at any moment, even before it listens
  EXPECT_NE(program.wait(), 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(RecordCommand, NeverReplacesARecording) {
  const TemporaryFolder folder;
  writeFile(folder / "a.palpate", "precious");
  expectOneLineError(
      palpate({"record", "--dsa", "/dev/null", "-o", folder / "a.palpate"}), 1, {"never replaced"});
  EXPECT_EQ(readFile(folder / "a.palpate"), "precious");
  expectOneLineError(palpate({"record", "--dsa", "/dev/null", "-o", folder / "no/a.palpate"}),
                     1,
                     {"isn't a folder"});
}

TEST(RecordCommand, RefusesWrongUsage) {
  expectOneLineError(palpate({"record", "-o", "a.palpate"}), 2, {"--dsa"});
  expectOneLineError(palpate({"record", "--dsa", "x"}), 2, {"-o"});
  expectOneLineError(palpate({"record", "--dsa", "x", "-o", "a.dsa"}), 2, {"palpate convert"});
  expectOneLineError(
      palpate({"record", "--dsa", "x", "-o", "a.palpate", "--duration", "0"}), 2, {"--duration"});
  expectOneLineError(
      palpate({"record", "--dsa", "x", "-o", "a.palpate", "--stop-without-contact", "0"}),
      2,
      {"--stop-without-contact"});
  expectOneLineError(palpate({"record", "--dsa", "x", "-o", ".", "--remote", "--start-on-contact"}),
                     2,
                     {"--remote"});
  expectOneLineError(palpate({"record", "--dsa", "x", "-o", "{foo}.palpate"}), 2, {"{foo}"});
}

}  // namespace
}  // namespace palpate::record_command_test
