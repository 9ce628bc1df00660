// Tests of an emulated hand with disconnections, power failures, noise and wrong clients, each as a
// client experiences it.
#include <algorithm>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/replayed_hand.h"
#include "palpate/emulator/synthetic_profile.h"

#include "emulator/hand_session.h"
#include "emulator/still_hand.h"
#include "testing/awaited.h"
#include "testing/testing.h"

namespace palpate::emulated_accidents_test {
namespace {
namespace fs = std::filesystem;

using namespace std::chrono_literals;
using testing::DecodedFrame;
using testing::eventually;
using testing::fastHand;
using testing::kPush;
using testing::kStop;
using testing::LineClient;
using testing::Octets;
using testing::octets;
using testing::readFrames;
using testing::StillHand;
using testing::TemporaryFolder;

EmulatedHandOptions faulty(const std::string& faults) {
  EmulatedHandOptions options = fastHand();
  options.faults = parseFaults(faults);
  return options;
}

std::size_t numDescriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

std::size_t numThreads() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/task")) ++count;
  return count;
}

TEST(EmulatedAccidents, UnpluggedAndPluggedAgainAHundredTimes) {
  const TemporaryFolder folder;
  EmulatedHandOptions options = fastHand();
  options.dsaPort = folder / "tactile";
  options.sdhPort = folder / "motion";
  EmulatedHand hand(std::make_unique<StillHand>(), options);
  const std::size_t descriptors = numDescriptors();
  const std::size_t threads = numThreads();
  for (int i = 0; i < 100; ++i) {
    LineClient client(folder / "tactile");
    client.send(kPush);
    ASSERT_FALSE(readFrames(client, 2).empty()) << i;
    hand.unplug();
    EXPECT_FALSE(fs::is_symlink(fs::symlink_status(folder / "tactile")));
    EXPECT_FALSE(fs::is_symlink(fs::symlink_status(folder / "motion")));
    for (int wait = 0; wait < 100 && !client.hungUp(); ++wait) client.receive(20ms);
    ASSERT_TRUE(client.hungUp()) << i;
    hand.replug();
  }
  EXPECT_EQ(numDescriptors(), descriptors);
  EXPECT_EQ(numThreads(), threads);
  // The controller does not notice: it continues to stream while the port is unplugged.
  hand.unplug();
  EXPECT_TRUE(eventually(hand, [](const auto& counts) { return counts.framesLost > 0; }));
  hand.replug();
  LineClient client(folder / "tactile");
  EXPECT_EQ(readFrames(client, 3).size(), 3u);
}

TEST(EmulatedAccidents, ThePlugIsPulledAtAGivenByte) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  for (const std::size_t bytes : {0u, 1u, 9u, 10u, 11u, 50u, 89u, 500u}) {
    LineClient client(hand.dsaPort());
    client.send(kStop);
    client.receiveUntilSilent(20ms);
    hand.unplugAfter(bytes);
    client.send(kPush);
    Octets all;
    while (!client.hungUp() && all.size() <= 500) {
      const Octets more = client.receive(1000ms);
      if (more.empty() && !client.hungUp()) break;
      all.insert(all.end(), more.begin(), more.end());
    }
    EXPECT_TRUE(client.hungUp()) << bytes;
    EXPECT_EQ(all.size(), bytes);
    hand.replug();
  }
}

TEST(EmulatedAccidents, OnePlugAlone) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  hand.unplug(true, false);
  for (int wait = 0; wait < 100 && !tactile.hungUp(); ++wait) tactile.receive(20ms);
  EXPECT_TRUE(tactile.hungUp());
  motion.send("ver\r\n");
  EXPECT_EQ(motion.receiveLine(), "VER=0.0.3.3");
}

TEST(EmulatedAccidents, APowerCycleForgetsWhatWasNotStored) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient client(hand.dsaPort());
  ASSERT_TRUE(client.ask(0x13, {0x00, 0, 99, 0}));
  client.send(kPush);
  ASSERT_EQ(readFrames(client, 2).size(), 2u);
  hand.powerCycle(0.5);
  client.send(octets("AA AA AA 01 00 00"));  // the controller ignores this
  // While booting it sends a terminal query three times, then it is ready.
  const std::string said = testing::hexText(client.receiveUntilSilent(400ms));
  client.scanner() = {};
  std::size_t queries = 0;
  for (std::size_t at = said.find("1B 5B 35 6E"); at != std::string::npos;
       at = said.find("1B 5B 35 6E", at + 1))
    ++queries;
  EXPECT_EQ(queries, 3u);
  EXPECT_EQ(said.substr(said.size() - 11), "1B 5B 35 6E");
  std::optional<Octets> threshold;
  for (int i = 0; i < 5 && !threshold; ++i) threshold = client.ask(0x14, {0});
  ASSERT_TRUE(threshold);
  EXPECT_EQ(*threshold, (Octets{0, 0, 150, 0}));
  client.send(octets("AA AA AA 03 03 00 81 00 00 2F 68"));
  const auto frames = readFrames(client, 1);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_LT(frames[0].deviceMs, 10'000u);  // counted from the second power-up
}

TEST(EmulatedAccidents, BootingTakesItsTimeAtTheStart) {
  EmulatedHand hand(std::make_unique<StillHand>(), faulty("boot=0.4"));
  LineClient client(hand.dsaPort());
  client.send(octets("AA AA AA 01 00 00"));
  EXPECT_EQ(client.receiveExactly(12).size(), 12u);
  EXPECT_TRUE(client.receive(150ms).empty());  // the request was not received
  for (int i = 0; i < 4; ++i)
    if (client.ask(0x01)) return;
  FAIL() << "it never came up";
}

TEST(EmulatedAccidents, MutedItListensAndSaysNothing) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  tactile.send(kPush);
  ASSERT_EQ(readFrames(tactile, 2).size(), 2u);
  hand.mute(true);
  tactile.receiveUntilSilent(100ms);
  motion.send("p(0)=30\r\n");
  EXPECT_TRUE(tactile.receive(300ms).empty());
  EXPECT_TRUE(motion.receive(10ms).empty());
  hand.mute(false);
  EXPECT_EQ(readFrames(tactile, 2).size(), 2u);
  motion.send("p(0)\r\n");
  EXPECT_EQ(motion.receiveLine(), "P(0)=30.0000");
}

TEST(EmulatedAccidents, BabblesAsMuchAsAsked) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  hand.sendRandomBytes(100'000, true, false);
  EXPECT_EQ(tactile.receiveExactly(100'000, 20s).size(), 100'000u);
  EXPECT_TRUE(tactile.receive(50ms).empty());
  EXPECT_TRUE(motion.receive(0ms).empty());
  EXPECT_EQ(tactile.ask(0x01)->size(), 18u);
}

TEST(EmulatedAccidents, SpoiltChecksumsAreSeenByTheClientAndCounted) {
  EmulatedHand hand(std::make_unique<StillHand>(), faulty("crc=0.2"));
  LineClient client(hand.dsaPort());
  client.send(kPush);
  const auto frames = readFrames(client, 200);
  hand.setFaults({});
  client.send(kStop);
  const Octets rest = client.receiveUntilSilent(200ms);
  client.scanner().feed(rest);
  std::size_t good = frames.size();
  while (const auto packet = client.scanner().next()) good += packet->id == 0 ? 1 : 0;
  const EmulatedHandCounts counts = hand.counts();
  EXPECT_EQ(counts.framesWhole, good);
  EXPECT_EQ(counts.framesSent - counts.framesWhole, counts.faults.damagedFrames);
  // Expected until 200 good frames, with a fifth damaged: 50 damaged, standard deviation 8.
  EXPECT_NEAR(double(counts.faults.damagedFrames), 50.0, 32.0);
  std::size_t damaged = 0;
  for (const SentFrame& sent : hand.sentFrames()) damaged += sent.whole ? 0 : 1;
  EXPECT_EQ(damaged, counts.faults.damagedFrames);
}

TEST(EmulatedAccidents, BytesVanishAndAppear) {
  EmulatedHand hand(std::make_unique<StillHand>(), faulty("drop=1e-3,insert=1e-3"));
  LineClient client(hand.dsaPort());
  client.send(kPush);
  const auto frames = readFrames(client, 200);
  EXPECT_EQ(frames.size(), 200u);
  hand.setFaults({});
  client.send(kStop);
  client.receiveUntilSilent(200ms);
  const EmulatedHandCounts counts = hand.counts();
  EXPECT_GT(counts.faults.droppedBytes, 0u);
  EXPECT_GT(counts.faults.insertedBytes, 0u);
  EXPECT_GT(counts.faults.damagedFrames, 0u);
  EXPECT_EQ(
      counts.dsa.bytesSent,
      20 + 79 * counts.framesScanned + counts.faults.insertedBytes - counts.faults.droppedBytes);
}

TEST(EmulatedAccidents, StallsAtTheGivenTime) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  tactile.send(kPush);
  ASSERT_EQ(readFrames(tactile, 2).size(), 2u);
  hand.setFaults(parseFaults("stall=0.5@0.05"));
  ASSERT_TRUE(eventually(hand, [](const auto& counts) { return counts.faults.stalls == 1; }));
  tactile.receiveUntilSilent(50ms);
  EXPECT_TRUE(tactile.receive(200ms).empty());
  motion.send("ver\r\n");
  EXPECT_EQ(motion.receiveLine(), "VER=0.0.3.3");  // late
  EXPECT_EQ(readFrames(tactile, 2).size(), 2u);
  EXPECT_EQ(hand.counts().faults.stalls, 1u);
}

TEST(EmulatedAccidents, PullsItsPlugsAtTheGivenTime) {
  const TemporaryFolder folder;
  EmulatedHandOptions options = faulty("unplug=0.2@0.1,unplug=0.2@0.6");
  options.dsaPort = folder / "tactile";
  EmulatedHand hand(std::make_unique<StillHand>(), options);
  for (std::uint64_t time = 1; time <= 2; ++time) {
    ASSERT_TRUE(
        eventually(hand, [&](const auto& counts) { return counts.faults.unplugs >= time; }));
    ASSERT_TRUE(testing::awaited([&] { return fs::exists(folder / "tactile"); }));
    LineClient client(folder / "tactile");
    EXPECT_EQ(client.ask(0x01)->size(), 18u);
  }
}

TEST(EmulatedAccidents, JunkPrecedesTheFirstAnswer) {
  EmulatedHand hand(std::make_unique<StillHand>(), faulty("junk_start=700"));
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  EXPECT_TRUE(tactile.receive(50ms).empty());
  tactile.send(kStop);
  const Octets said = tactile.receiveUntilSilent(200ms);
  ASSERT_EQ(said.size(), 710u);
  EXPECT_EQ(testing::hexText(Octets(said.begin() + 700, said.end())),
            "AA AA AA 03 02 00 00 00 4B B9");
  motion.send("ver\r\n");
  EXPECT_EQ(motion.receiveUntilSilent(200ms).size(), 713u);
  tactile.send(kStop);
  EXPECT_EQ(tactile.receiveUntilSilent(200ms).size(), 10u);
  EXPECT_EQ(hand.counts().faults.junkBytes, 1400u);
}

// Sends half a million random bytes to each port at once, then a correct request.
TEST(EmulatedAccidents, SurvivesABabblingClient) {
  for (const EmulationRate rate : {EmulationRate::kMax, EmulationRate::kReal}) {
    EmulatedHand hand(std::make_unique<StillHand>(), {.rate = rate});
    LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
    std::mt19937 random(3);
    Octets noise(5000);
    for (int i = 0; i < 100; ++i) {
      for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
      tactile.send(noise);
      motion.send(noise);
      tactile.receive(0ms);
      motion.receive(0ms);
    }
    ASSERT_TRUE(eventually(hand, [](const auto& counts) {
      return counts.dsa.bytesReceived == 500'000 && counts.sdh.bytesReceived == 500'000;
    }));
    tactile.send(Octets(16, 0));
    tactile.receiveUntilSilent(300ms);
    motion.receiveUntilSilent(300ms);
    tactile.scanner() = {};
    tactile.send(kStop);
    EXPECT_TRUE(tactile.answer(0x03));
    EXPECT_EQ(tactile.ask(0x01)->size(), 18u);
    motion.send(" \r\n");
    motion.receiveUntilSilent(300ms);
    motion.send("ver\r\n");
    EXPECT_EQ(motion.receiveLine(), "VER=0.0.3.3");
    EXPECT_TRUE(hand.counts().failure.empty());
  }
}

TEST(EmulatedAccidents, ReplaysEachFrameOnceAcrossPausesThenFallsSilent) {
  const Profile profile = synthesize({.durationS = 3.0, .grasps = 1, .noiseCounts = 5.0});
  EmulatedHand hand(std::make_unique<ReplayedHand>(profile), {.rate = EmulationRate::kMax});
  LineClient client(hand.dsaPort());
  std::vector<DecodedFrame> frames;
  client.send(kPush);
  for (DecodedFrame& frame : readFrames(client, 30)) frames.push_back(std::move(frame));
  client.send(kStop);
  client.scanner().feed(client.receiveUntilSilent(200ms));
  client.send(kPush);
  for (DecodedFrame& frame : readFrames(client, profile.numFrames() - frames.size()))
    frames.push_back(std::move(frame));
  // No frame follows. All may have been on their way before the pause: then the answer to the
  // second request still comes.
  while (const auto packet = client.packet(200ms)) EXPECT_NE(packet->id, 0);
  ASSERT_EQ(frames.size(), profile.numFrames());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TactileFrame recorded = profile.frame(i);
    ASSERT_TRUE(std::equal(frames[i].values.begin(),
                           frames[i].values.end(),
                           recorded.values.begin(),
                           [](std::uint16_t a, float b) { return float(a) == b; }))
        << "frame " << i;
  }
  // The recorded intervals, in whole milliseconds of the controller.
  for (std::size_t i = 1; i < 30; ++i)
    EXPECT_NEAR(frames[i].deviceMs - frames[i - 1].deviceMs,
                double(profile.frameTimeUs(i) - profile.frameTimeUs(i - 1)) * 1e-3,
                1.0);
}

TEST(EmulatedAccidents, RefusesWhatItCantBe) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "file", "precious");
  EXPECT_THROW(EmulatedHand(nullptr), std::invalid_argument);
  EXPECT_THROW(EmulatedHand(std::make_unique<StillHand>(), {.dsaPort = folder / "file"}),
               FileError);
  // The first port is closed again when the second one can't be opened.
  EXPECT_THROW(EmulatedHand(std::make_unique<StillHand>(),
                            {.dsaPort = folder / "link", .sdhPort = folder / "file"}),
               FileError);
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(folder / "link")));
  EXPECT_THROW(EmulatedHand(std::make_unique<StillHand>(), fastHand(0.0)), std::invalid_argument);
  EXPECT_THROW(EmulatedHand(std::make_unique<StillHand>(), {.sdhPort = "tcp:10.0.0.1:5"}),
               std::invalid_argument);
}

TEST(EmulatedAccidents, AModelThatFailsStopsTheHandNotTheProgram) {
  class Broken final : public HandModel {
   public:
    const HandDescription& hand() const override { return still.hand(); }
    void advanceTo(double timeS) override { still.advanceTo(timeS); }
    double timeS() const override { return still.timeS(); }
    JointMotion& joints() override { return still.joints(); }
    std::vector<MatrixSetting>& settings() override { return still.settings(); }
    void scan(std::span<std::uint16_t>) override { throw std::runtime_error("broken"); }
    std::vector<double> temperatures() override { return {}; }
    std::vector<MatrixTruth> truth() const override { return {}; }
    StillHand still;
  };
  EmulatedHand hand(std::make_unique<Broken>(), fastHand());
  LineClient client(hand.dsaPort());
  client.send(kPush);
  EXPECT_TRUE(eventually(hand, [](const auto& counts) { return counts.failure == "broken"; }));
  EXPECT_THROW(hand.replug(), DeviceError);
}

// For the thread sanitizer: calls all functions from many threads while frames are sent.
TEST(EmulatedAccidents, TakesControlsFromManyThreads) {
  EmulatedHand hand(std::make_unique<StillHand>(), {.rate = EmulationRate::kMax});
  LineClient client(hand.dsaPort());
  client.send(kPush);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 3; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 50; ++i) {
          hand.counts();
          hand.sentFrames();
          if (t == 0) hand.setFaults(parseFaults("crc=0.1"));
          if (t == 1) hand.mute(i % 2 == 0);
          if (t == 2)
            hand.withModel([](HandModel& model) { model.settings()[0].sensitivity = 1.0; });
          EXPECT_FALSE(hand.dsaPort().empty());
        }
      });
    for (int i = 0; i < 20; ++i) client.receive(5ms);
  }
  hand.mute(false);
  EXPECT_FALSE(client.receive(1000ms).empty());
}

}  // namespace
}  // namespace palpate::emulated_accidents_test
