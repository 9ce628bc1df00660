#include "palpate/emulator/emulated_hand.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/emulator/replayed_hand.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/profile_builder.h"

#include "emulator/hand_session.h"
#include "emulator/still_hand.h"
#include "testing/punctuality.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::emulated_hand_test {
namespace {

using namespace std::chrono_literals;
using testing::DecodedFrame;
using testing::eventually;
using testing::fastHand;
using testing::hexText;
using testing::kPush;
using testing::kPushRaw;
using testing::kSingle;
using testing::kStop;
using testing::LineClient;
using testing::Octets;
using testing::octets;
using testing::Punctuality;
using testing::readFrames;
using testing::StillHand;
using testing::tactilePacket;
using testing::TemporaryFolder;

std::string exchange(LineClient& client, const std::string& request, std::size_t answerBytes) {
  client.send(octets(request));
  return hexText(client.receiveExactly(answerBytes));
}

// The vendor's sequence of section 4.1, byte by byte, over a pty at the real speed of the line.
TEST(EmulatedHand, OpensAsTheVendorsTactileLibraryDoes) {
  const TemporaryFolder folder;
  EmulatedHand hand(std::make_unique<StillHand>(),
                    {.dsaPort = folder / "tactile", .serial = 0x1D9B0057});
  EXPECT_EQ(hand.dsaPort(), folder / "tactile");
  LineClient client(folder / "tactile");
  EXPECT_EQ(exchange(client, "AA AA AA 03 03 00 01 00 00 2F 6A", 10),
            "AA AA AA 03 02 00 00 00 4B B9");
  EXPECT_TRUE(client.receive(1000ms).empty());
  EXPECT_EQ(exchange(client, "AA AA AA 01 00 00", 26),
            "AA AA AA 01 12 00 00 00 57 00 9B 1D 10 00 29 80 70 00 00 00 00 00 00 00 2F 36");
  EXPECT_EQ(exchange(client, "AA AA AA 02 00 00", 20),
            "AA AA AA 02 0C 00 00 00 06 00 69 00 01 57 00 9B 1D 00 6F E1");
  for (const char* matrix :
       {"00 CB FB", "01 EA EB", "02 89 DB", "03 A8 CB", "04 4F BB", "05 6E AB"})
    EXPECT_EQ(exchange(client, std::string("AA AA AA 0B 01 00 ") + matrix, 60).substr(0, 23),
              "AA AA AA 0B 34 00 00 00");
  EXPECT_EQ(exchange(client, "AA AA AA 03 03 00 81 01 00 7C 5C", 10),
            "AA AA AA 03 02 00 00 00 4B B9");
  for (int i = 0; i < 5; ++i) {
    const auto packet = client.packet();
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->id, 0);
    EXPECT_TRUE(testing::decodeFramePayload(packet->payload));
  }
  client.send(octets("AA AA AA 03 03 00 01 00 00 2F 6A"));
  EXPECT_TRUE(client.answer(0x03));
  EXPECT_TRUE(client.receive(1000ms).empty());
}

// Section 4.2.
TEST(EmulatedHand, OpensAsTheVendorsMotionLibraryDoes) {
  EmulatedHand hand(std::make_unique<StillHand>());
  LineClient client(hand.sdhPort());
  client.send(" \r\n");
  EXPECT_TRUE(client.receive(100ms).empty());
  for (int i = 0; i < 2; ++i) {
    client.send("ver");
    client.send("\r\n");
    EXPECT_EQ(client.receiveLine(), "VER=0.0.3.3");
  }
  client.send("vlim\r\n");
  EXPECT_EQ(client.receiveLine(),
            "VLIM=83.0000,140.0000,200.0000,140.0000,200.0000,140.0000,200.0000");
  client.send("alim\r\n");
  EXPECT_EQ(client.receiveLine(),
            "ALIM=5000.0000,400.0000,1500.0000,400.0000,1500.0000,400.0000,1500.0000");
  client.send("con\r\n");
  EXPECT_EQ(client.receiveLine(), "CON=0");
  EXPECT_EQ(exchange(client, "83 03 00 DC 1E", 34).substr(0, 12), "83 20 07 00 ");
  EXPECT_EQ(exchange(client, "A4 1F 07 00x28 FA 6E", 34).substr(0, 12), "A4 20 07 00 ");
  EXPECT_TRUE(client.receive(100ms).empty());
}

// Frame rate by the controller's clock and by the bytes (section 3.1), at the real speed of the
// line.
TEST(EmulatedHand, StreamsAtTheRatesOfTheRealLine) {
  auto still = std::make_unique<StillHand>();
  StillHand& model = *still;
  EmulatedHand hand(std::move(still));
  LineClient client(hand.dsaPort());
  const auto measure = [&](const Octets& start, std::size_t count) {
    client.send(start);
    if (!client.answer(0x03)) return 0.0;
    const auto frames = readFrames(client, count);
    client.send(kStop);
    client.receiveUntilSilent(200ms);
    if (frames.size() < count) return 0.0;
    return 1000.0 * double(count - 1) / (frames.back().deviceMs - frames.front().deviceMs);
  };
  EXPECT_NEAR(measure(kPush, 33), 31.7, 0.2);
  EXPECT_NEAR(measure(kPushRaw, 9), 11.7, 0.2);
  hand.withModel([&](HandModel&) { model.noisy = true; });
  EXPECT_NEAR(measure(kPush, 9), 11.7, 0.2);
}

// Seven raw frames of 985 bytes can't arrive faster than 115200 baud allow, and on an idle machine
// arrive not much later.
TEST(EmulatedHand, PacesBytesInRealTime) {
  EmulatedHand hand(std::make_unique<StillHand>());
  LineClient client(hand.dsaPort());
  const auto begin = std::chrono::steady_clock::now();
  client.send(kPushRaw);
  ASSERT_EQ(readFrames(client, 7).size(), 7u);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(seconds, 7 * 985 * 10 / 115200.0);
  EXPECT_LT(seconds, 7 * 985 * 10 / 115200.0 + testing::timeLimit(1.0));
}

TEST(EmulatedHand, StopReallyStops) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient client(hand.dsaPort());
  client.send(kPush);
  ASSERT_EQ(readFrames(client, 30).size(), 30u);
  client.send(kStop);
  ASSERT_TRUE(client.answer(0x03));
  EXPECT_TRUE(client.receive(1000ms).empty());
}

TEST(EmulatedHand, PullsOneFrameAtATime) {
  EmulatedHand hand(std::make_unique<StillHand>());
  LineClient client(hand.dsaPort());
  std::uint32_t lastMs = 0;
  for (int i = 0; i < 5; ++i) {
    client.send(kSingle);
    const auto acknowledge = client.packet();
    ASSERT_TRUE(acknowledge);
    EXPECT_EQ(acknowledge->id, 0x03);
    const auto frames = readFrames(client, 1);
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_GT(frames[0].deviceMs, lastMs);
    lastMs = frames[0].deviceMs;
  }
  EXPECT_TRUE(client.receive(100ms).empty());
}

// The serial numbers that the controllers of a hand report.
std::pair<std::string, std::string> serialsOf(const EmulatedHand& hand) {
  LineClient motion(hand.sdhPort()), tactile(hand.dsaPort());
  motion.send("sn\r\n");
  tactile.send(octets("AA AA AA 01 00 00"));
  const Octets info = tactile.receiveExactly(26);
  std::string serial;
  for (std::size_t i = 0; i < 4; ++i) serial += hexText({info.at(11 - i)});
  return {serial, motion.receiveLine().value_or("")};
}

TEST(EmulatedHand, HasASerialNumberOfItsSeed) {
  const auto hand = [](std::uint64_t seed) {
    return std::make_unique<EmulatedHand>(std::make_unique<StillHand>(),
                                          EmulatedHandOptions{.seed = seed});
  };
  const auto one = hand(1), again = hand(1), two = hand(2);
  EXPECT_EQ(serialsOf(*one), serialsOf(*again));
  EXPECT_NE(serialsOf(*one).first, serialsOf(*two).first);
  EXPECT_NE(serialsOf(*one).second, serialsOf(*two).second);
  EXPECT_EQ(serialsOf(*one), std::pair(one->dsaSerial(), "SN=" + one->sdhSerial()));
  EXPECT_EQ(one->dsaSerial().size(), 8u);
  EXPECT_EQ(one->dsaSerial().front(), 'E');
  std::set<std::uint32_t> serials;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) serials.insert(emulatedSerial(seed));
  EXPECT_EQ(serials.size(), 1000u);
}

TEST(EmulatedHand, KeepsItsSerialNumberWhenItIsUnpluggedOrSwitchedOff) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  const auto before = serialsOf(hand);
  hand.unplug();
  hand.replug();
  EXPECT_EQ(serialsOf(hand), before);
  hand.powerCycle(0.0);
  EXPECT_EQ(serialsOf(hand), before);
}

TEST(EmulatedHand, ReplaysTheSerialNumberOfTheRecording) {
  const auto serialOf = [](const std::string& recorded, std::optional<std::uint32_t> given = {}) {
    const Profile sample = synthesize({.durationS = 2.0, .grasps = 1});
    ProfileInfo info = sample.info();
    info.serial = recorded;
    ProfileBuilder builder(sample.hand());
    builder.addFrame(sample.frame(0));
    EmulatedHandOptions options;
    options.serial = given;
    return EmulatedHand(std::make_unique<ReplayedHand>(builder.finish(info)), options).dsaSerial();
  };
  EXPECT_EQ(serialOf("12AB34CD"), "12AB34CD");
  EXPECT_EQ(serialOf("12AB34CD", 0xE5), "000000E5");
  // That of a stream, of a .dsa of an unknown hand, and none.
  for (const char* unusable : {"pad 7", "00000000", ""})
    EXPECT_EQ(serialOf(unusable), hexDigits(emulatedSerial(1), 8)) << unusable;
}

// Section 3.4: the probe of DSA-Konqueror sends text and line end separately, and reads with 10 ms
// between two bytes.
TEST(EmulatedHand, AnswersTheProbeOfOtherPrograms) {
  EmulatedHand hand(std::make_unique<StillHand>(), {.serial = 0x1D9B0057});
  LineClient motion(hand.sdhPort()), tactile(hand.dsaPort());
  Punctuality answers("probe_of_another_program");
  for (int i = 0; i < 10; ++i) {
    const std::int64_t askedUs = systemClock().monotonicUs();
    motion.send("sn");
    motion.send("\r\n");
    EXPECT_EQ(motion.receiveLine(), "SN=" + hand.sdhSerial());
    tactile.send(octets("AA AA AA 01 00 00"));
    const Octets answer = tactile.receive(1000ms);
    ASSERT_EQ(answer.size(), 26u);  // in one piece
    EXPECT_EQ(hexText(Octets(answer.begin() + 8, answer.begin() + 12)), "57 00 9B 1D");
    answers.took(askedUs, systemClock().monotonicUs());
  }
  answers.judge();
}

// RobWork sends stop with flags 00, 01, 02, then 0B, 05, 04 for each matrix, rate 5 with internal
// trigger.
TEST(EmulatedHand, ServesRobWork) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient client(hand.dsaPort());
  client.send(octets("AA AA AA 03 03 00 00 00 00 8D 00"));
  ASSERT_TRUE(client.answer(0x03));
  EXPECT_EQ(client.ask(0x01)->size(), 18u);
  EXPECT_EQ(client.ask(0x02)->size(), 12u);
  for (std::uint8_t m = 0; m < 6; ++m) {
    EXPECT_EQ(client.ask(0x0B, {m})->size(), 52u);
    EXPECT_GT(client.ask(0x05, {1, m})->size(), 2u);
    EXPECT_EQ(client.ask(0x04, {0, m})->size(), m % 2 == 0 ? 13u : 12u);
  }
  client.send(tactilePacket(0x03, {0xA1, 5, 0}));
  const auto frames = readFrames(client, 10);
  ASSERT_EQ(frames.size(), 10u);
  for (std::size_t i = 1; i < frames.size(); ++i)
    EXPECT_NE(frames[i].deviceMs, frames[i - 1].deviceMs);
}

// DSA-Konqueror reads both masks of all matrices, sensitivity and threshold of each; it stops and
// waits 200 ms before it changes masks; it starts with rate 1.
TEST(EmulatedHand, ServesKonqueror) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient client(hand.dsaPort());
  for (std::uint8_t m = 0; m < 6; ++m) {
    const std::size_t octetsOfMask = m % 2 == 0 ? 11 : 10;
    for (const std::uint8_t type : {0, 1})
      EXPECT_EQ(client.ask(0x04, {type, m})->size(), 2 + octetsOfMask);
    EXPECT_EQ(client.ask(0x12, {m})->size(), 11u);
    EXPECT_EQ(client.ask(0x14, {m})->size(), 4u);
  }
  client.send(kPush);
  EXPECT_EQ(readFrames(client, 10).size(), 10u);
  client.send(kStop);
  ASSERT_TRUE(client.answer(0x03));
  EXPECT_TRUE(client.receive(200ms).empty());
  EXPECT_EQ(client.ask(0xAB, octets("01 00 FFx10 0F")), (Octets{0, 0}));
  client.send(kSingle);
  EXPECT_EQ(readFrames(client, 1).size(), 1u);
}

// The ROS node requests rate 30, and detects new data by a changed time stamp.
TEST(EmulatedHand, ServesTheRosNode) {
  EmulatedHand hand(std::make_unique<StillHand>());
  LineClient client(hand.dsaPort());
  client.send(octets("AA AA AA 03 03 00 81 1E 00 2C 76"));
  const auto frames = readFrames(client, 20);
  ASSERT_EQ(frames.size(), 20u);
  for (std::size_t i = 1; i < frames.size(); ++i)
    EXPECT_GT(frames[i].deviceMs, frames[i - 1].deviceMs);
}

TEST(EmulatedHand, SendsWhatTheModelScans) {
  auto still = std::make_unique<StillHand>();
  for (std::size_t i = 0; i < still->values.size(); i += 5)
    still->values[i] = static_cast<std::uint16_t>(i * 8);
  const std::vector<std::uint16_t> expected = still->values;
  std::vector<std::uint64_t> observed;
  std::atomic<bool> same = true;
  EmulatedHand hand(std::move(still), fastHand(), [&](const EmulatedFrame& frame) {
    observed.push_back(frame.scanned.number);
    same = same && std::equal(expected.begin(), expected.end(), frame.counts.begin());
    same = same && frame.model.truth().at(1).contact;
  });
  LineClient client(hand.dsaPort());
  client.send(kPush);
  const auto frames = readFrames(client, 50);
  client.send(kStop);
  client.receiveUntilSilent(100ms);
  ASSERT_EQ(frames.size(), 50u);
  for (const DecodedFrame& frame : frames) EXPECT_EQ(frame.values, expected);
  hand.withModel([&](HandModel&) {
    EXPECT_GE(observed.size(), 50u);
    for (std::size_t i = 0; i < observed.size(); ++i) EXPECT_EQ(observed[i], i);
  });
  EXPECT_TRUE(same);
}

TEST(EmulatedHand, CountsFramesAndRemembersWhenTheyLeft) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand());
  LineClient client(hand.dsaPort());
  client.send(kPush);
  const auto frames = readFrames(client, 60);
  client.send(kStop);
  client.receiveUntilSilent(100ms);
  const EmulatedHandCounts counts = hand.counts();
  EXPECT_GE(counts.framesWhole, 60u);
  EXPECT_EQ(counts.framesScanned, counts.framesSent);
  EXPECT_EQ(counts.framesSent, counts.framesWhole);
  EXPECT_EQ(counts.framesLost, 0u);
  EXPECT_EQ(counts.dsa.bytesSent, 20 + 79 * counts.framesSent);  // plus two acknowledgements
  EXPECT_EQ(counts.dsa.bytesReceived, kPush.size() + kStop.size());
  EXPECT_EQ(counts.sdh.bytesSent, 0u);
  EXPECT_TRUE(counts.failure.empty());
  const auto sent = hand.sentFrames();
  ASSERT_EQ(sent.size(), counts.framesSent);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(sent[i].number, i);
    EXPECT_EQ(sent[i].deviceMs, frames[i].deviceMs);
    EXPECT_TRUE(sent[i].whole);
    EXPECT_GE(sent[i].hostUs, sent[i > 0 ? i - 1 : 0].hostUs);
  }
}

// At 300 frames/s the device's clock shows the period, the host's clock the rate.
TEST(EmulatedHand, KeepsAGivenRate) {
  EmulatedHand hand(std::make_unique<StillHand>(), fastHand(300.0));
  LineClient client(hand.dsaPort());
  client.send(kPush);
  const auto frames = readFrames(client, 301);
  ASSERT_EQ(frames.size(), 301u);
  EXPECT_EQ(frames.back().deviceMs - frames.front().deviceMs, 1000u);
  // The counters may lag behind the client for a moment.
  ASSERT_TRUE(eventually(hand, [](const auto& counts) { return counts.framesSent >= 301; }));
  const auto sent = hand.sentFrames();
  EXPECT_NEAR(double(sent[300].hostUs - sent[0].hostUs) * 1e-6, 1.0, 0.05);
}

// Simulates an hour in a short time: the hand's time advances with the frames.
TEST(EmulatedHand, RunsAsFastAsTheClientReads) {
  EmulatedHand hand(std::make_unique<StillHand>(), {.rate = EmulationRate::kMax});
  LineClient client(hand.dsaPort());
  client.send(kPush);
  constexpr std::size_t kFrames = 20'000;  // 630 s
  const auto begin = std::chrono::steady_clock::now();
  const auto frames = readFrames(client, kFrames);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_EQ(frames.size(), kFrames);
  EXPECT_LT(seconds, 60.0);
  EXPECT_NEAR((frames.back().deviceMs - frames.front().deviceMs) / double(kFrames - 1), 31.5, 0.01);
  for (std::size_t i = 1; i < kFrames; ++i) {
    const std::uint32_t interval = frames[i].deviceMs - frames[i - 1].deviceMs;
    ASSERT_TRUE(interval == 31 || interval == 32) << interval;
  }
  EXPECT_EQ(hand.counts().framesLost, 0u);
  EXPECT_GT(hand.counts().handTimeS, 600.0);
  // When no client reads, the hand waits: it neither loses nor accumulates bytes.
  ASSERT_TRUE(eventually(hand, [](const auto& counts) { return counts.dsa.pending > 0; }));
  EXPECT_EQ(hand.counts().framesLost, 0u);
  EXPECT_LT(hand.counts().dsa.pending, 10'000u);
  client.send(kStop);
  client.receiveUntilSilent(200ms);
  EXPECT_EQ(hand.counts().framesScanned, hand.counts().framesWhole);
}

// A serial line does not wait for a reader.
TEST(EmulatedHand, LosesBytesThatNobodyReadsAtTheRealRate) {
  auto still = std::make_unique<StillHand>();
  EmulatedHand hand(std::move(still));
  LineClient client(hand.dsaPort());
  client.send(kPushRaw);
  ASSERT_TRUE(eventually(hand, [](const auto& counts) { return counts.framesLost > 0; }));
  EXPECT_LT(hand.counts().dsa.pending, 10'000u);
  client.send(kStop);
  client.receiveUntilSilent(200ms);
  // The connection works as before.
  client.scanner() = {};
  EXPECT_EQ(client.ask(0x01)->size(), 18u);
}

TEST(EmulatedHand, ServesTcpWithShortRecords) {
  EmulatedHandOptions options = fastHand();
  options.dsaPort = options.sdhPort = "tcp:127.0.0.1:0";
  EmulatedHand hand(std::make_unique<StillHand>(), options);
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  EXPECT_EQ(tactile.ask(0x01)->size(), 18u);
  tactile.send(kPush);
  EXPECT_EQ(readFrames(tactile, 30).size(), 30u);
  EXPECT_EQ(exchange(motion, "83 01 00", 32), hexText(octets("83 1E 07 00 00x28")));
  motion.send("ver\r\n");
  EXPECT_EQ(motion.receiveLine(), "VER=0.0.3.3");
}

TEST(EmulatedHand, MovesWhileItStreams) {
  EmulatedHand hand(std::make_unique<StillHand>());
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  tactile.send(kPush);
  ASSERT_EQ(readFrames(tactile, 2).size(), 2u);
  motion.send("p=8,0,0,0,0,0,0\r\n");
  ASSERT_TRUE(motion.receiveLine());
  motion.send("m\r\n");
  const auto answer = motion.receiveLine();
  ASSERT_TRUE(answer);
  EXPECT_GT(std::stod(answer->substr(2)), 0.1);
  EXPECT_LT(std::stod(answer->substr(2)), 1.0);
  std::optional<std::string> position;
  for (int i = 0; i < 300 && position != "POS(0)=8.0000"; ++i) {
    motion.send("pos(0)\r\n");
    position = motion.receiveLine();
  }
  EXPECT_EQ(position, "POS(0)=8.0000");
}

}  // namespace
}  // namespace palpate::emulated_hand_test
