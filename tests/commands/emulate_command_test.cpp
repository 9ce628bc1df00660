#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <sstream>

#include "commands/palpate_program.h"
#include "emulator/hand_session.h"
#include "testing/background_program.h"

namespace palpate::emulate_command_test {
namespace {
namespace fs = std::filesystem;

using testing::BackgroundProgram;
using testing::expectOneLineError;
using testing::kPush;
using testing::kStop;
using testing::LineClient;
using testing::palpate;
using testing::readFrames;
using testing::TemporaryFolder;

TEST(EmulateCommand, SaysWhereItIsAndServesBothPortsUntilInterrupted) {
  const TemporaryFolder folder;
  const std::string tactilePort = folder / "tactile", motionPort = folder / "motion";
  for (const int signal : {SIGINT, SIGTERM}) {
    BackgroundProgram program(PALPATE_PROGRAM,
                              {"emulate", "--dsa", tactilePort, "--sdh", motionPort});
    const auto line = program.awaitLine("dsa=");
    ASSERT_TRUE(line) << program.err();
    EXPECT_EQ(*line, "dsa=" + tactilePort + " sdh=" + motionPort);
    EXPECT_TRUE(program.awaitLine("serial=E")) << program.err();
    {
      LineClient tactile(tactilePort), motion(motionPort);
      tactile.send(kPush);
      EXPECT_EQ(readFrames(tactile, 3).size(), 3u);
      motion.send("ver\r\n");
      EXPECT_EQ(motion.receiveLine(), "VER=0.0.3.3");
    }
    program.signal(signal);
    EXPECT_EQ(program.wait(), 0);
    EXPECT_EQ(program.err(), "");
    EXPECT_FALSE(fs::is_symlink(fs::symlink_status(tactilePort)));
    EXPECT_FALSE(fs::is_symlink(fs::symlink_status(motionPort)));
  }
}

// What a window keeps for a serial number is found again by whoever gives the seed.
TEST(EmulateCommand, OnlyASeedGivesTheSameSerialNumbersAgain) {
  const auto serialsOf = [](const std::vector<std::string>& more) {
    std::vector<std::string> words{"emulate"};
    words.insert(words.end(), more.begin(), more.end());
    BackgroundProgram program(PALPATE_PROGRAM, words);
    const auto line = program.awaitLine("serial=");
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 0);
    return line.value_or(program.err());
  };
  EXPECT_EQ(serialsOf({"--seed", "7"}), serialsOf({"--seed", "7"}));
  EXPECT_NE(serialsOf({"--seed", "7"}), serialsOf({"--seed", "8"}));
  EXPECT_NE(serialsOf({}), serialsOf({}));
}

TEST(EmulateCommand, TheHelpNamesTheScenesAndBreaksNoWord) {
  const auto help = palpate({"emulate", "--help"});
  ASSERT_EQ(help.exitCode, 0) << help.err;
  std::set<std::string> words;
  std::istringstream text(help.out);
  for (std::string word; text >> word;) {
    while (!word.empty() && (word.back() == ',' || word.back() == '.')) word.pop_back();
    words.insert(word);
  }
  for (const auto& scene : fs::directory_iterator(fs::path(testing::dataFolder()) / "scenes"))
    EXPECT_TRUE(words.contains(scene.path().stem().string())) << scene.path() << help.out;
  for (const char* fault : {"crc=RATE",
                            "drop=RATE",
                            "insert=RATE",
                            "stall=S@AT",
                            "unplug=S@AT",
                            "junk_start=BYTES",
                            "boot=S"})
    EXPECT_TRUE(words.contains(fault)) << fault << help.out;
}

TEST(EmulateCommand, WritesTheTruthOfEachFrameSent) {
  const TemporaryFolder folder;
  const std::string port = folder / "d", table = folder / "truth.csv";
  BackgroundProgram program(
      PALPATE_PROGRAM,
      {"emulate", "--dsa", port, "--truth", table, "--rate", "200", "--scene", "ball"});
  ASSERT_TRUE(program.awaitLine("dsa=")) << program.err();
  std::size_t frames = 0;
  {
    LineClient client(port);
    client.send(kPush);
    frames = readFrames(client, 20).size();
    client.send(kStop);
    client.scanner().feed(client.receiveUntilSilent(std::chrono::milliseconds(200)));
    while (const auto packet = client.scanner().next()) frames += packet->id == 0 ? 1 : 0;
  }
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
  const std::string truth = testing::readFile(table);
  const std::string head =
      "time_ms,matrix,contact,force_n,x_mm,y_mm,z_mm,slip_x_taxels,slip_y_taxels,turn_deg\n";
  EXPECT_EQ(truth.substr(0, head.size()), head);
  EXPECT_EQ(std::size_t(std::count(truth.begin(), truth.end(), '\n')), 1 + 6 * frames);
  expectOneLineError(palpate({"emulate", "--truth", table}), 1, {"--force"});
  EXPECT_EQ(testing::readFile(table), truth);
}

TEST(EmulateCommand, ReplaysARecordingAsFastAsItIsRead) {
  const TemporaryFolder folder;
  const std::string recording = folder / "grasp.dsa", port = folder / "d";
  ASSERT_EQ(palpate({"synthesize", "-o", recording, "--duration", "2", "--grasps", "1"}).exitCode,
            0);
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"emulate", "--replay", recording, "--rate", "max", "--dsa", port});
  ASSERT_TRUE(program.awaitLine("dsa=")) << program.err();
  LineClient client(port);
  client.send(kPush);
  // 2 s at 31.7 frames/s, both ends included.
  EXPECT_EQ(readFrames(client, 64).size(), 64u);
  EXPECT_TRUE(client.receive(std::chrono::milliseconds(200)).empty());
}

TEST(EmulateCommand, ListensOnThisMachineOnlyWhenAsked) {
  BackgroundProgram program(
      PALPATE_PROGRAM,
      {"emulate", "--dsa", "tcp:127.0.0.1:0", "--rate", "300", "--faults", "junk_start=100"});
  const auto line = program.awaitLine("dsa=tcp:127.0.0.1:");
  ASSERT_TRUE(line) << program.err();
  EXPECT_NE(line->find(" sdh=/dev/pts/"), std::string::npos);
  LineClient client(line->substr(4, line->find(' ') - 4));
  client.send(kStop);
  EXPECT_EQ(client.receiveUntilSilent(std::chrono::milliseconds(200)).size(), 110u);
}

// Reads what a program of this machine receives at tcp:127.0.0.1:PORT until it ends with `end`.
std::string receivedUntil(const std::string& name, const std::string& end) {
  LineClient client(name);
  std::string text;
  while (text.find(end) == std::string::npos) {
    const auto bytes = client.receive(std::chrono::milliseconds(5000));
    if (bytes.empty()) break;
    text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return text;
}

TEST(EmulateCommand, StreamsAnyHandToWhoeverConnects) {
  const TemporaryFolder folder;
  const std::string table = folder / "truth.csv";
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"emulate",
                             "--hand",
                             "flat_pad_16x16",
                             "--stream",
                             "0",
                             "--format",
                             "lines",
                             "--rate",
                             "200",
                             "--truth",
                             table});
  const auto line = program.awaitLine("stream=");
  ASSERT_TRUE(line) << program.err();
  ASSERT_TRUE(line->starts_with("stream=tcp:127.0.0.1:")) << *line;
  const std::string text = receivedUntil(line->substr(7), "\nframe#300,1.500000,");
  EXPECT_TRUE(text.starts_with("# emulated hand\nframe#0,0.000000,0,0,")) << text.substr(0, 80);
  // The sphere presses from 1 s on.
  EXPECT_NE(text.find("\nframe#300,1.500000,"), std::string::npos);
  EXPECT_EQ(palpate({"record",
                     "--stream",
                     line->substr(7),
                     "--hand",
                     "flat_pad_16x16",
                     "--duration",
                     "0.2",
                     "-o",
                     folder / "a.palpate"})
                .exitCode,
            0);
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(program.err(), "");
  const std::string truth = testing::readFile(table);
  EXPECT_NE(truth.find(",0,1,"), std::string::npos) << "the pad is touched";
}

TEST(EmulateCommand, SaysWhenOtherMachinesCanConnect) {
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"emulate", "--hand", "sole", "--stream", "0.0.0.0:0"});
  ASSERT_TRUE(program.awaitLine("stream=tcp:0.0.0.0:")) << program.err();
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
  EXPECT_NE(program.err().find("any machine that reaches this address can connect"),
            std::string::npos);
}

TEST(EmulateCommand, RefusesStreamsThatMakeNoSense) {
  const TemporaryFolder folder;
  expectOneLineError(palpate({"emulate", "--stream", "0"}), 2, {"--stream needs --hand"});
  expectOneLineError(palpate({"emulate", "--hand", "sole"}), 2, {"--hand needs --stream"});
  expectOneLineError(palpate({"emulate", "--format", "lines"}), 2, {"--format needs --stream"});
  const auto refused = [](std::vector<std::string> options, int code, const std::string& word) {
    std::vector<std::string> all = {"emulate", "--hand", "parallel_gripper"};
    if (std::find(options.begin(), options.end(), "--stream") == options.end())
      all.insert(all.end(), {"--stream", "0"});
    all.insert(all.end(), options.begin(), options.end());
    expectOneLineError(palpate(all), code, {word});
  };
  refused({"--stream", "x"}, 2, "'x' is not [ADDRESS:]PORT");
  refused({"--stream", "host:1"}, 2, "ADDRESS is numeric");
  refused({"--format", "xml"}, 2, "binary, lines, json");
  refused({"--rate", "real"}, 2, "max or a number");
  refused({"--rate", "9999"}, 2, "0.1..5000");
  refused({"--dsa", "x"}, 2, "--stream and --dsa");
  refused({"--replay", "x"}, 2, "--stream and --replay");
  refused({"--sdh-firmware", "1"}, 2, "--stream and --sdh-firmware");
  refused({"--scene", "ball"}, 1, "no preshape 'centrical'; there are: parallel");
  testing::writeFile(folder / "a.json",
                     R"({"script": [{"at_s": 1, "threshold": {"matrix": 2, "counts": 9}}]})");
  refused({"--scene", folder / "a.json"}, 1, "script[0].threshold.matrix");
  BackgroundProgram program(PALPATE_PROGRAM, {"emulate", "--hand", "sole", "--stream", "0"});
  const auto line = program.awaitLine("stream=");
  ASSERT_TRUE(line) << program.err();
  refused({"--stream", line->substr(7 + 4)}, 1, "another program uses this port");
}

TEST(EmulateCommand, RefusesBadOptions) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "file", "precious");
  expectOneLineError(palpate({"emulate", "--scene", "desert"}), 1, {"desert", "ball", "empty"});
  expectOneLineError(palpate({"emulate", "--scene", folder / "none.json"}), 1, {"none.json"});
  expectOneLineError(palpate({"emulate", "--replay", folder / "none.dsa"}), 1, {"none.dsa"});
  expectOneLineError(palpate({"emulate", "--faults", "fire=1"}), 2, {"--faults", "fire"});
  expectOneLineError(palpate({"emulate", "--rate", "fast"}), 2, {"--rate", "real", "max"});
  expectOneLineError(palpate({"emulate", "--rate", "0"}), 2, {"--rate"});
  expectOneLineError(palpate({"emulate", "--dsa", "tcp:0.0.0.0:5000"}), 2, {"127.0.0.1"});
  expectOneLineError(palpate({"emulate", "--sdh-firmware", "new one"}), 2, {"new one"});
  expectOneLineError(palpate({"emulate", "--replay", "a.dsa", "--scene", "ball"}), 2, {"--scene"});
  expectOneLineError(palpate({"emulate", "--replay", "a.dsa", "--truth", "t.csv"}), 2, {"--truth"});
  expectOneLineError(palpate({"emulate", "--dsa", "x", "--sdh", "x"}), 2, {"different"});
  expectOneLineError(palpate({"emulate", "extra"}), 2, {"usage"});
  expectOneLineError(palpate({"emulate", "--dsa", folder / "file"}), 1, {"file"});
  EXPECT_EQ(testing::readFile(folder / "file"), "precious");
}

}  // namespace
}  // namespace palpate::emulate_command_test
