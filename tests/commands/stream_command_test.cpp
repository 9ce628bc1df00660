// The real program: datagrams of an emulated hand, lines of a recording.
#include <csignal>
#include <sstream>

#include "palpate/core/json.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"
#include "emulator/numbered_hand.h"
#include "interop/raw_client.h"
#include "interop/udp_receiver.h"
#include "recording/palpate_damage.h"
#include "testing/background_program.h"

namespace palpate::stream_command_test {
namespace {
using namespace testing;

std::string demoFile() { return testing::dataFolder() / "demo_grasps.dsa"; }

std::unique_ptr<EmulatedHand> hand() {
  EmulatedHandOptions options;
  options.rate = EmulationRate::kFixed;
  options.hz = 100.0;
  return std::make_unique<EmulatedHand>(std::make_unique<NumberedHand>(), options);
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(StreamCommand, DatagramsOfAHand) {
  const auto emulated = hand();
  UdpReceiver signalReceiver, tactileReceiver;
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"stream",
                             "--dsa",
                             emulated->dsaPort(),
                             "--sdh",
                             emulated->sdhPort(),
                             "--to",
                             "signals:" + std::to_string(signalReceiver.port()),
                             "--to",
                             "tactile:" + std::to_string(tactileReceiver.port())});
  // Until the angles and temperatures are there, too: another port, another moment.
  Json json;
  ASSERT_TRUE(soon([&] {
    json = Json::parse(signalReceiver.receive(20'000).value());
    return json.contains("temperatures_degc") && json.contains("angles_deg");
  }));
  EXPECT_EQ(json.at("angles_deg").size(), 7u);
  EXPECT_EQ(json.at("temperatures_degc").at(std::size_t{0}).asDouble(), 37.25);
  EXPECT_GE(json.at("link").at("rate_hz").asDouble(), 0.0);
  // The counts are those of a frame that the hand sent, in messages of whole matrices. The first
  // message may belong to a frame that began before.
  std::vector<float> values;
  std::size_t matrices = 0;
  while (matrices < 6) {
    const auto datagram = tactileReceiver.receive();
    ASSERT_TRUE(datagram);
    EXPECT_LE(datagram->size(), 1400u);
    const Json parts = Json::parse(*datagram).at("tactile_matrix");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts.at(i).at("matrix_id").asInteger() != static_cast<std::int64_t>(matrices)) continue;
      ++matrices;
      const Json taxels = parts.at(i).at("tactile_array");
      for (std::size_t k = 0; k < taxels.size(); ++k)
        values.push_back(static_cast<float>(taxels.at(k).asInteger()));
    }
  }
  EXPECT_TRUE(NumberedHand::numberOf(values));
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0) << program.err();
  EXPECT_NE(program.out().find("signals to 127.0.0.1:" + std::to_string(signalReceiver.port())),
            std::string::npos)
      << program.out();
}

// What one Palpate sends as datagrams another one shows.
TEST(StreamCommand, DatagramsAreReadByAnotherPalpate) {
  const TemporaryFolder folder;
  UdpReceiver free;
  const std::string port = std::to_string(free.port());
  free.close();
  BackgroundProgram sender(
      PALPATE_PROGRAM,
      {"stream", demoFile(), "--to", "tactile:" + port, "--to", "signals:" + port});
  const auto result = palpate({"record",
                               "--stream",
                               "udp:" + port,
                               "--hand",
                               "sdh2",
                               "-o",
                               folder / "a.palpate",
                               "--duration",
                               "1",
                               "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Profile recorded = openRecording(folder / "a.palpate");
  const Profile sent = openRecording(demoFile());
  ASSERT_GT(recorded.numFrames(), 20u);
  EXPECT_GT(recorded.numAngles(), 0u);
  // At most the frame that had begun before: its first matrices were not received.
  EXPECT_LE(Json::parse(result.out).at("suspect").asInteger(), 1) << result.out;
  std::size_t at = 0;
  while (at < sent.numFrames() && sent.frame(at).values != recorded.frame(5).values) ++at;
  EXPECT_LT(at, sent.numFrames());
  sender.signal(SIGINT);
  EXPECT_EQ(sender.wait(), 0) << sender.err();
}

TEST(StreamCommand, ARecordingIsPlayedInItsOwnTime) {
  UdpReceiver receiver;
  BackgroundProgram program(PALPATE_PROGRAM,
                            {"stream",
                             demoFile(),
                             "--to",
                             "signals:" + std::to_string(receiver.port()),
                             "--duration",
                             "1"});
  const Json first = Json::parse(receiver.receive(20'000).value());
  EXPECT_EQ(first.at("sequence").asInteger(), 0);
  EXPECT_DOUBLE_EQ(first.at("t").asDouble(),
                   static_cast<double>(openRecording(demoFile()).frame(0).hostUs) / 1e6);
  EXPECT_EQ(program.wait(), 0) << program.err();
}

// It said "45 sent, 44 dropped" for nothing at all received.
TEST(StreamCommand, SaysThatNobodyListened) {
  UdpReceiver free;
  const std::string port = std::to_string(free.port());
  free.close();
  const auto result =
      palpate({"stream", demoFile(), "--to", "signals:" + port, "--duration", "0.5"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("signals to 127.0.0.1:" + port + ": nobody listened"))
      << result.out;
  EXPECT_EQ(result.out.find(" sent"), std::string::npos) << result.out;
}

TEST(StreamCommand, RecordingAndStreamingAtOnce) {
  const TemporaryFolder folder;
  const auto emulated = hand();
  UdpReceiver receiver;
  const auto result = palpate({"record",
                               "--dsa",
                               emulated->dsaPort(),
                               "-o",
                               folder / "a.palpate",
                               "--duration",
                               "0.5",
                               "--to",
                               "signals:" + std::to_string(receiver.port())});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(Json::parse(receiver.receive().value()).at("m0").isObject());
  EXPECT_GT(openRecording(folder / "a.palpate").numFrames(), 40u);
}

TEST(StreamCommand, LinesOfARecordingSayWhatSignalsSays) {
  const auto result = palpate({"stream", demoFile(), "--lines"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), openRecording(demoFile()).numFrames());
  // frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2
  const auto rows = linesOf(palpate({"signals", demoFile()}).out);
  std::size_t compared = 0;
  for (std::size_t i = 1; i < rows.size(); i += 97) {
    std::istringstream row(rows[i]);
    std::vector<double> numbers;
    for (std::string cell; std::getline(row, cell, ',');) numbers.push_back(std::stod(cell));
    const Json matrix = Json::parse(lines.at(static_cast<std::size_t>(numbers[0])))
                            .at("m" + std::to_string(static_cast<int>(numbers[2])));
    ASSERT_EQ(matrix.at("mean").asDouble(), numbers[3]) << rows[i];
    ASSERT_EQ(matrix.at("sum").asDouble(), numbers[7]) << rows[i];
    ++compared;
  }
  EXPECT_GT(compared, 20u);
  const auto tactile = palpate({"stream", demoFile(), "--lines", "--to", "tactile"});
  EXPECT_EQ(linesOf(tactile.out).size(), lines.size());
}

TEST(StreamCommand, LinesOfAHandAreThereAtOnce) {
  const auto emulated = hand();
  BackgroundProgram program(PALPATE_PROGRAM, {"stream", "--dsa", emulated->dsaPort(), "--lines"});
  const auto line = program.awaitLine("\"sequence\":3,");
  ASSERT_TRUE(line) << program.err();
  EXPECT_TRUE(Json::parse(*line).at("link").isObject());
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 0) << program.err();
}

TEST(StreamCommand, WithoutAFrameItFails) {
  const TemporaryFolder folder;
  expectOneLineError(
      palpate({"stream", "--dsa", folder / "no", "--duration", "0.2"}), 1, {"no frame"});
  BackgroundProgram program(
      "/bin/sh",
      {"-c",
       std::string(PALPATE_PROGRAM) + " stream " + demoFile() + " --lines > /dev/full; exit $?"});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_NE(program.err().find("standard output"), std::string::npos) << program.err();
}

TEST(StreamCommand, RefusesWrongUsage) {
  expectOneLineError(palpate({"stream"}), 2, {"--dsa"});
  expectOneLineError(palpate({"stream", demoFile(), "--dsa", "x"}), 2, {"not two of them"});
  expectOneLineError(palpate({"stream", demoFile(), "--to", "pictures"}), 2, {"--to", "pictures"});
  expectOneLineError(palpate({"stream", demoFile(), "--to", "signals:0"}), 2, {"signals:0"});
  expectOneLineError(palpate({"stream", demoFile(), "--to", "signals:x"}), 2, {"signals:x"});
  expectOneLineError(
      palpate({"stream", demoFile(), "--to", "signals", "--to", "signals:1"}), 2, {"twice"});
  expectOneLineError(palpate({"stream", demoFile(), "--lines", "--to", "signals:1"}), 2, {"port"});
  expectOneLineError(palpate({"stream", "no.dsa", "--lines"}), 1, {"no.dsa"});
}

// C-A1: of a damaged recording what can be read is sent, and the rest told.
TEST(StreamCommand, ADamagedRecordingIsReadAsFarAsVerifyReadsIt) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "damaged.palpate";
  ASSERT_EQ(palpate({"convert", demoFile(), path}).exitCode, 0);
  std::string bytes = readFile(path);
  // The data of a block in the middle: whichever it is.
  for (std::size_t at = bytes.size() / 2; at < bytes.size() / 2 + 4096; at += 64)
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
  writeFile(path, bytes);
  const ProgramResult verified = palpate({"verify", path});
  ASSERT_EQ(verified.exitCode, 3) << verified.out;
  const ProgramResult lines = palpate({"stream", path, "--lines"});
  EXPECT_EQ(lines.exitCode, 3) << lines.err;
  const ProgramResult info = palpate({"info", path, "--json"});
  EXPECT_EQ(info.exitCode, 3) << info.err;
  const auto frames = Json::parse(info.out).at("frames").asInteger();
  EXPECT_EQ(static_cast<std::int64_t>(linesOf(lines.out).size()), frames);
  EXPECT_NE(verified.out.find("readable: " + std::to_string(frames) + " frames"), std::string::npos)
      << verified.out;
}

// It is played at once: nobody waits until all of it was read, and what is missing is told where it
// is missed.
TEST(StreamCommand, ADamagedRecordingIsPlayedWithoutWhatIsMissing) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "damaged.palpate";
  writeSamples(path, 120);
  const std::string sound = readFile(path);
  const std::vector<BlockBytes> blocks = blockBytes(path);
  ASSERT_GT(blocks.size(), 2u);
  // Until the first datagram is there.
  const auto play = [&](const BlockBytes& block) {
    std::string bytes = sound;
    bytes[block.end - 1] = static_cast<char>(bytes[block.end - 1] ^ 1);
    writeFile(path, bytes);
    UdpReceiver receiver;
    BackgroundProgram program(
        PALPATE_PROGRAM, {"stream", path, "--to", "signals:" + std::to_string(receiver.port())});
    EXPECT_TRUE(receiver.receive(20'000)) << program.err();
    program.signal(SIGINT);
    const int exitCode = program.wait();
    return std::pair(exitCode, program.err());
  };
  const auto [code, said] = play(blocks.front());
  EXPECT_EQ(code, 3) << said;
  EXPECT_NE(said.find(std::to_string(blocks.front().n) + " of the samples"), std::string::npos)
      << said;
  EXPECT_EQ(play(blocks.back()).first, 0);
}

}  // namespace
}  // namespace palpate::stream_command_test
