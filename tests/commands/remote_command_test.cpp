// The real program at both ends: `palpate record --remote` (and the window) there, `palpate remote`
// here.
#include <csignal>

#include "palpate/core/json.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "emulator/numbered_hand.h"
#include "interop/listening_sockets.h"
#include "interop/raw_client.h"
#include "testing/background_program.h"

namespace palpate::remote_command_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

class RemoteCommandTest : public ::testing::Test {
 protected:
  RemoteCommandTest() {
    EmulatedHandOptions options;
    options.rate = EmulationRate::kFixed;
    options.hz = 100.0;
    hand_ = std::make_unique<EmulatedHand>(std::make_unique<NumberedHand>(), options);
    fs::create_directory(folder_ / "runs");
  }

  void record(std::vector<std::string> more = {}) {
    std::vector<std::string> words{"record",
                                   "--dsa",
                                   hand_->dsaPort(),
                                   "-o",
                                   folder_ / "runs",
                                   "--remote",
                                   "--socket",
                                   socket()};
    words.insert(words.end(), more.begin(), more.end());
    program_ = std::make_unique<BackgroundProgram>(PALPATE_PROGRAM, words);
    ASSERT_TRUE(program_->awaitLine("remote=" + socket())) << program_->err();
  }
  // The window, drawn nowhere.
  void openWindow(std::vector<std::string> more) {
    std::vector<std::string> words{"QT_QPA_PLATFORM=offscreen"};
    for (const char* variable : {"XDG_CONFIG_HOME",
                                 "XDG_DATA_HOME",
                                 "XDG_STATE_HOME",
                                 "XDG_CACHE_HOME",
                                 "XDG_RUNTIME_DIR",
                                 "HOME"})
      words.push_back(variable + std::string("=") + folder_.path().string());
    words.insert(words.end(), {PALPATE_PROGRAM, "--demo", "--no-gl"});
    words.insert(words.end(), more.begin(), more.end());
    program_ = std::make_unique<BackgroundProgram>("/usr/bin/env", words);
  }
  ProgramResult remote(std::vector<std::string> words) {
    words.insert(words.begin(), {"remote", "--socket", socket()});
    return palpate(words);
  }
  Json answerTo(const std::vector<std::string>& words) {
    const ProgramResult result = remote(words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return result.out.empty() ? Json() : Json::parse(result.out);
  }
  bool framesCome() {
    return soon([&] {
      const ProgramResult result = remote({"status"});
      return result.exitCode == 0 && Json::parse(result.out).at("rate_hz").isNumber();
    });
  }
  std::string socket() const { return folder_ / "s"; }

  const TemporaryFolder folder_;
  std::unique_ptr<EmulatedHand> hand_;
  std::unique_ptr<BackgroundProgram> program_;
};

TEST_F(RemoteCommandTest, RecordsAsItIsAsked) {
  record({"--operator", "Ada"});
  ASSERT_TRUE(framesCome());
  EXPECT_TRUE(fs::is_empty(folder_ / "runs"));  // nothing is recorded that nobody asked for
  answerTo({"set", "object", "foam ball"});
  const fs::path path = folder_ / "runs/run 7.palpate";
  EXPECT_EQ(answerTo({"start", "run", "7"}).at("file").asString(), path.string());
  EXPECT_TRUE(fs::exists(path));
  EXPECT_TRUE(answerTo({"label", "contact"}).at("time_ms").isNumber());
  EXPECT_EQ(answerTo({"status"}).at("state").asString(), "recording");
  ASSERT_TRUE(soon([&] { return answerTo({"status"}).at("frames").asInteger() > 20; }));
  const Json stopped = answerTo({"stop"});
  const Profile profile = openRecording(path);
  EXPECT_EQ(stopped.at("frames").asInteger(), static_cast<std::int64_t>(profile.numFrames()));
  EXPECT_GT(profile.numFrames(), 20u);
  EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  auto meta = readRecordingMeta(path);
  EXPECT_EQ(meta["operator"], "Ada");
  EXPECT_EQ(meta["object"], "foam ball");
  int labels = 0;
  for (const Event& event : readEvents(path).events)
    labels += event.kind == "label" && event.text == "contact" ? 1 : 0;
  EXPECT_EQ(labels, 1);

  expectOneLineError(remote({"stop"}), 1, {"not_recording"});
  expectOneLineError(remote({"start", "run", "7"}), 1, {"file_exists"});
  expectOneLineError(remote({"start", "../../x"}), 1, {"file_name"});
  expectOneLineError(palpate({"record",
                              "--dsa",
                              hand_->dsaPort(),
                              "-o",
                              folder_ / "runs",
                              "--remote",
                              "--socket",
                              socket()}),
                     1,
                     {socket(), "another program"});
  program_->signal(SIGTERM);
  EXPECT_EQ(program_->wait(), 0) << program_->err();
  EXPECT_NE(program_->out().find("run 7.palpate: "), std::string::npos) << program_->out();
  EXPECT_FALSE(fs::exists(socket()));
  expectOneLineError(remote({"status"}), 1, {"--remote"});
}

TEST_F(RemoteCommandTest, ASignalFinishesWhatRuns) {
  record({"--json"});
  ASSERT_TRUE(framesCome());
  answerTo({"start", "a"});
  program_->signal(SIGINT);
  EXPECT_EQ(program_->wait(), 0) << program_->err();
  const std::string out = program_->out();
  const Json line = Json::parse(out.substr(out.find('\n') + 1));
  const Profile profile = openRecording(folder_ / "runs/a.palpate");
  EXPECT_EQ(line.at("frames").asInteger(), static_cast<std::int64_t>(profile.numFrames()));
  EXPECT_EQ(verifyRecording(folder_ / "runs/a.palpate").state, VerifyReport::State::kSound);
}

TEST_F(RemoteCommandTest, WithoutAHandTheStartIsRefused) {
  hand_->mute(true);
  record();
  expectOneLineError(remote({"start"}), 1, {"no_hand"});
  EXPECT_TRUE(fs::is_empty(folder_ / "runs"));
}

// A stranger finds no door in a run that wasn't asked to have one, and no other door in one that
// was.
TEST_F(RemoteCommandTest, NothingListensUnlessItIsAskedFor) {
  {
    const BackgroundProgram plain(
        PALPATE_PROGRAM, {"record", "--dsa", hand_->dsaPort(), "-o", folder_ / "plain.palpate"});
    ASSERT_TRUE(soon([&] { return fs::exists(folder_ / "plain.palpate"); }));
    EXPECT_EQ(listeningSocketsOf(plain.pid()), std::vector<std::string>());
  }
  record({"--to", "signals:9", "--to", "tactile:9"});
  ASSERT_TRUE(framesCome());
  EXPECT_EQ(listeningSocketsOf(program_->pid()), (std::vector<std::string>{"unix " + socket()}));
}

TEST_F(RemoteCommandTest, TheWindowHasNoDoorByDefault) {
  openWindow({});
  // It has connected the emulated hand: its pseudo-terminals are open.
  ASSERT_TRUE(soon([&] {
    std::error_code gone;
    const fs::path process = "/proc/" + std::to_string(program_->pid());
    // Until then it has the files of this test.
    if (fs::read_symlink(process / "exe", gone).filename() != "palpate_window") return false;
    for (fs::directory_iterator entry(process / "fd", gone), end; !gone && entry != end;
         entry.increment(gone)) {
      std::error_code failure;
      if (fs::read_symlink(entry->path(), failure).string().starts_with("/dev/pts/")) return true;
    }
    return false;
  })) << program_->err();
  EXPECT_EQ(listeningSocketsOf(program_->pid()), std::vector<std::string>());
  program_->signal(SIGTERM);
  EXPECT_EQ(program_->wait(), 0) << program_->err();
}

TEST_F(RemoteCommandTest, TheWindowRecordsAsItIsAsked) {
  openWindow({"--remote", "--socket", socket()});
  ASSERT_TRUE(soon([&] { return fs::exists(socket()); })) << program_->err();
  ASSERT_TRUE(framesCome());
  EXPECT_EQ(listeningSocketsOf(program_->pid()), (std::vector<std::string>{"unix " + socket()}));
  const Json started = answerTo({"start", "from outside"});
  const fs::path path = started.at("file").asString();
  EXPECT_EQ(path.filename(), "from outside.palpate");
  EXPECT_TRUE(answerTo({"label", "contact"}).at("time_ms").isNumber());
  const Json stopped = answerTo({"stop"});
  const Profile profile = openRecording(path);
  EXPECT_EQ(stopped.at("frames").asInteger(), static_cast<std::int64_t>(profile.numFrames()));
  int labels = 0;
  for (const Event& event : readEvents(path).events) labels += event.text == "contact";
  EXPECT_EQ(labels, 1);
  program_->signal(SIGTERM);
  EXPECT_EQ(program_->wait(), 0) << program_->err();
  EXPECT_FALSE(fs::exists(socket()));
}

TEST(RemoteCommand, RefusesWrongUsage) {
  const TemporaryFolder folder;
  expectOneLineError(palpate({"remote"}), 2, {"usage"});
  expectOneLineError(palpate({"remote", "dance"}), 2, {"dance"});
  expectOneLineError(palpate({"remote", "label"}), 2, {"label TEXT"});
  expectOneLineError(palpate({"remote", "status", "--wait", "no"}), 2, {"--wait"});
  expectOneLineError(palpate({"remote", "status"}), 1, {"palpate-remote", "--remote"});
  expectOneLineError(palpate({"remote", "status"}, {{"XDG_RUNTIME_DIR", ""}}), 1, {"--socket"});
  expectOneLineError(palpate({"record", "--dsa", "x", "-o", folder / "a.palpate", "--socket", "s"}),
                     2,
                     {"--remote"});
  expectOneLineError(palpate({"--socket", "s"}), 2, {"--remote"});
  expectOneLineError(
      palpate({"record", "--dsa", "x", "-o", folder / "{foo}", "--remote"}), 2, {"{foo}"});
}

}  // namespace
}  // namespace palpate::remote_command_test
