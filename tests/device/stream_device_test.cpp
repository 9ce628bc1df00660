// Streams as a device: over a pty, TCP, UDP and a channel of the test; what is lost, refused and
// silent.
#include "palpate/device/stream_device.h"

#include <atomic>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/device/stream_packets.h"
#include "palpate/interop/datagram_sender.h"
#include "palpate/recording/tactile_sensor_json.h"

#include "device/collecting_sink.h"
#include "device/pty_pair.h"
#include "device/scripted_channel.h"
#include "device/stream_hands.h"
#include "device/stream_link.h"
#include "testing/awaited.h"
#include "testing/testing.h"

namespace palpate::testing::stream_device_test {
namespace {

// --- The rounds of the port's thread, on a clock of the test.

struct Bench {
  explicit Bench(StreamDeviceOptions given = {}) : device(std::move(given)) {
    device.source = "port";
    if (!device.hand.layout) device.hand = padHand({{1, 3}});
    link = std::make_unique<StreamLink>(
        device,
        [this](const std::string& port) { return open(port); },
        StreamLinkOptions{.startsInside = startsInside},
        time,
        clock);
    link->begin(sink);
    link->step();
  }
  std::unique_ptr<ByteChannel> open(const std::string& port) {
    if (!plugged) throw DeviceError(DeviceFault::kNotFound, port, "no such port");
    auto channel = std::make_unique<ScriptedChannel>(clock, nullptr);
    line = channel.get();
    return channel;
  }
  void send(const Bytes& bytes, std::int64_t afterUs = 10'000) {
    clock.nowUs += afterUs;
    line->arrive(bytes);
    link->step();
  }
  void send(std::string_view text, std::int64_t afterUs = 10'000) {
    send(textBytes(text), afterUs);
  }
  void frame(std::uint32_t sequence, std::int64_t afterUs = 10'000) {
    Bytes bytes;
    appendStreamFrame(bytes,
                      sequence,
                      static_cast<std::uint64_t>(clock.nowUs + afterUs),
                      std::vector<float>{1, 2, static_cast<float>(sequence % 4096)});
    send(bytes, afterUs);
  }
  // Frames of all gaps that are told.
  std::int64_t lostByEvents() const {
    std::int64_t lost = 0;
    for (const Event& event : sink.events)
      if (event.kind == "gap" && Json::parse(event.json).contains("lost"))
        lost += Json::parse(event.json).at("lost").asInteger();
    return lost;
  }
  void silence(std::int64_t us) {
    for (const std::int64_t endUs = clock.nowUs + us; clock.nowUs < endUs;) link->step();
  }
  void replug() {
    line->pullThePlug();
    link->step();
    clock.nowUs += 200'000;
    link->step();
  }
  PortStatus status() const { return link->status(); }
  std::size_t numEvents(const std::string& kind) const {
    return static_cast<std::size_t>(std::count_if(
        sink.events.begin(), sink.events.end(), [&](const auto& e) { return e.kind == kind; }));
  }
  const Event& lastEvent(const std::string& kind) const {
    for (auto event = sink.events.rbegin(); event != sink.events.rend(); ++event)
      if (event->kind == kind) return *event;
    throw std::logic_error("no event " + kind);
  }

  bool startsInside = false;
  bool plugged = true;
  ManualClock clock;
  HostTime time{clock};
  CollectingSink sink;
  StreamDeviceOptions device;
  ScriptedChannel* line = nullptr;
  std::unique_ptr<StreamLink> link;
};

TEST(StreamDevice, DeliversLinesAndPacketsWithBothTimes) {
  Bench lines;
  lines.send("frame#1,250,1,2,3\n");
  ASSERT_EQ(lines.sink.frames.size(), 1u);
  EXPECT_EQ(lines.sink.frames[0].values, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(lines.sink.frames[0].deviceUs, 250'000);
  EXPECT_EQ(lines.sink.frames[0].hostUs, lines.time.nowUs());
  Bench packets;
  packets.frame(7);
  ASSERT_EQ(packets.sink.frames.size(), 1u);
  EXPECT_EQ(packets.sink.frames[0].values, (std::vector<float>{1, 2, 7}));
  EXPECT_EQ(packets.sink.frames[0].deviceUs, packets.clock.nowUs);
  EXPECT_EQ(packets.status().items, 1u);
  EXPECT_EQ(packets.status().bytes, 24u + 6u);
  EXPECT_EQ(packets.status().skippedBytes, 0u);
  EXPECT_EQ(packets.status().suspect, 0u);
}

TEST(StreamDevice, AnglesAndTemperaturesAreSeriesOfTheirOwn) {
  Bench bench({.hand = smallHand()});
  bench.send("angles,1.5,-2\ntemperatures,36.5\nframe,1,2,3\nangles,2,3\n");
  ASSERT_EQ(bench.sink.angles.size(), 2u);
  EXPECT_EQ(bench.sink.angles[0].values, (std::vector<double>{1.5, -2}));
  EXPECT_GT(bench.sink.angles[1].hostUs, bench.sink.angles[0].hostUs);
  ASSERT_EQ(bench.sink.temperatures.size(), 1u);
  EXPECT_EQ(bench.sink.temperatures[0].values, (std::vector<double>{36.5}));
  EXPECT_EQ(bench.status().items, 1u);
}

TEST(StreamDevice, FramesThatArriveTogetherHaveAscendingStamps) {
  Bench bench;
  bench.send("1,2,3\n4,5,6\n7,8,9\n");
  ASSERT_EQ(bench.sink.frames.size(), 3u);
  EXPECT_LT(bench.sink.frames[0].hostUs, bench.sink.frames[1].hostUs);
  EXPECT_LT(bench.sink.frames[1].hostUs, bench.sink.frames[2].hostUs);
}

TEST(StreamDevice, LossIsCountedBySequenceNumbers) {
  Bench bench;
  for (const std::uint32_t n : {4'294'967'294U, 4'294'967'295U, 0U, 1U, 5U, 6U}) bench.frame(n);
  EXPECT_EQ(bench.status().lost, 3u);
  EXPECT_EQ(bench.status().estimatedLost, 0u);
  EXPECT_EQ(bench.status().items, 6u);
}

TEST(StreamDevice, ASenderWithoutNumbersLosesNothing) {
  Bench bench;
  for (int i = 0; i < 5; ++i) bench.frame(0);
  bench.send("", 0);
  EXPECT_EQ(bench.status().lost, 0u);
  EXPECT_EQ(bench.status().items, 5u);
}

TEST(StreamDevice, ARestartedSenderLosesNothing) {
  Bench bench;
  for (std::uint32_t n = 500; n < 520; ++n) bench.frame(n);
  bench.frame(0);
  bench.frame(1);
  bench.frame(3'000'000'000U);  // forward by more than was possible
  EXPECT_EQ(bench.status().lost, 0u);
  EXPECT_EQ(bench.status().items, 23u);
  EXPECT_NE(bench.lastEvent("link").text.find("restarted"), std::string::npos);
}

// F10: the frames of two senders are no loss of either, and one event says what is wrong.
TEST(StreamDevice, TwoSendersAreOneEventAndNoLoss) {
  Bench bench;
  for (std::uint32_t n = 0; n < 1000; ++n) {
    bench.frame(5'000 + n, 5'000);
    bench.frame(17'000 + n, 5'000);
  }
  EXPECT_EQ(bench.status().items, 2000u);
  EXPECT_EQ(bench.status().lost, 0u);
  std::vector<std::string> told;
  for (const Event& event : bench.sink.events) told.push_back(event.kind + ": " + event.text);
  EXPECT_EQ(
      told,
      (std::vector<std::string>{
          "link: the stream is connected",
          "link: frame numbering restarted: the sender was restarted, or a second one sends"}));
}

// What is lost is in the file, with the figure that is counted, and not one event per frame.
TEST(StreamDevice, EachLossIsAGapOverItsFrames) {
  Bench bench;
  for (std::uint32_t n = 0; n < 10; ++n) bench.frame(n);
  const std::int64_t fromUs = bench.time.nowUs();
  bench.frame(15);
  const Event first = bench.lastEvent("gap");
  EXPECT_EQ(first.text, "5 frames are missing");
  EXPECT_EQ(first.tUs, fromUs);
  EXPECT_EQ(first.t1Us, bench.time.nowUs());
  EXPECT_FALSE(Json::parse(first.json).at("estimated").asBool());
  for (std::uint32_t n = 17; n < 1017; n += 2) bench.frame(n, 20'000);
  bench.link->finish();
  EXPECT_EQ(bench.status().lost, 505u);
  EXPECT_EQ(bench.lostByEvents(), 505);
  EXPECT_LT(bench.numEvents("gap"), 105u) << "ten per second";
}

TEST(StreamDevice, ASilenceUntilTheEndIsAGap) {
  Bench bench;
  for (int i = 0; i < 100; ++i) bench.send("1,2,3\n", 10'000);
  EXPECT_FALSE(bench.link->openGap(bench.time.nowUs()));
  const std::int64_t fromUs = bench.time.nowUs();
  bench.silence(4'000'000);
  const auto open = bench.link->openGap(fromUs + 2'000'000);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->tUs, fromUs);
  EXPECT_EQ(open->t1Us, fromUs + 2'000'000);
  EXPECT_EQ(Json::parse(open->json).at("lost").asInteger(), 200);
  EXPECT_EQ(bench.numEvents("gap"), 0u);
  bench.link->finish();
  EXPECT_EQ(bench.numEvents("gap"), 1u);
  EXPECT_EQ(bench.lostByEvents(), static_cast<std::int64_t>(bench.status().lost));
  EXPECT_FALSE(bench.link->openGap(bench.time.nowUs()));
}

TEST(StreamDevice, TheEndOfAConnectionIsNoLoss) {
  for (const bool comesBack : {false, true}) {
    Bench bench;
    bench.line->network = true;
    for (int i = 0; i < 100; ++i) bench.send("1,2,3\n", 10'000);
    bench.line->endStream();
    bench.link->step();
    bench.clock.nowUs += 3'000'000;
    EXPECT_FALSE(bench.link->openGap(bench.time.nowUs()));
    if (comesBack) {
      bench.link->step();
      bench.send("1,2,3\n");
      EXPECT_EQ(bench.lastEvent("gap").text, "no frames for 3.01 s, none is missing");
    }
    bench.link->finish();
    EXPECT_EQ(bench.status().lost, 0u);
    EXPECT_EQ(bench.numEvents("gap"), comesBack ? 1u : 0u);
  }
}

// The machine of the sender crashed, or the socket of the datagrams failed.
TEST(StreamDevice, AConnectionThatBreaksIsLoss) {
  for (const bool datagrams : {false, true}) {
    Bench bench;
    bench.line->network = true;
    bench.line->datagrams = datagrams;
    for (int i = 0; i < 100; ++i) bench.send("1,2,3\n", 10'000);
    bench.line->pullThePlug();
    bench.link->step();
    bench.clock.nowUs += 3'000'000;
    const auto open = bench.link->openGap(bench.time.nowUs());
    ASSERT_TRUE(open);
    EXPECT_EQ(Json::parse(open->json).at("lost").asInteger(), 300);
    bench.link->step();
    bench.send("1,2,3\n");
    EXPECT_EQ(bench.lastEvent("gap").text, "no frames for 3.01 s, about 300 frames are missing");
    EXPECT_EQ(bench.status().lost, 300u);
    EXPECT_EQ(bench.status().estimatedLost, 300u);
  }
}

// The sender closed its connection, came back 3 s later and sent nothing for 10 minutes.
TEST(StreamDevice, ASenderThatComesBackMuteLosesSinceThen) {
  for (const bool counts : {false, true}) {
    Bench bench;
    bench.line->network = true;
    std::uint32_t next = 0;
    const auto send = [&] { counts ? bench.frame(next++) : bench.send("1,2,3\n"); };
    for (int i = 0; i < 100; ++i) send();
    bench.line->endStream();
    bench.link->step();
    bench.clock.nowUs += 3'000'000;
    bench.link->step();
    const std::int64_t backUs = bench.time.nowUs();
    bench.silence(600'000'000);
    EXPECT_EQ(bench.lastEvent("gap").text, "no frames for 3 s, none is missing");
    EXPECT_EQ(bench.lastEvent("gap").t1Us, backUs);
    const auto open = bench.link->openGap(bench.time.nowUs());
    ASSERT_TRUE(open);
    EXPECT_EQ(open->tUs, backUs);
    EXPECT_EQ(Json::parse(open->json).at("lost").asInteger(), 60'000);
    send();
    EXPECT_EQ(bench.lastEvent("gap").tUs, backUs);
    EXPECT_EQ(bench.lostByEvents(), counts ? 0 : 60'000);
    EXPECT_EQ(bench.status().lost, counts ? 0u : 60'000u);
  }
}

TEST(StreamDevice, OvertakenDatagramsWithTimesGoOn) {
  Bench bench;
  bench.line->network = bench.line->datagrams = true;
  for (int n = 0; n < 400; n += 4)
    for (const int k : {1, 0, 3, 2})
      bench.send("f#" + std::to_string(n + k) + "," + std::to_string(10 * (n + k)) + ",1,2,3\n");
  EXPECT_EQ(bench.status().items, 200u);
  EXPECT_EQ(bench.status().suspect, 200u);
  EXPECT_EQ(bench.link->lastFault(), "frame 398 arrived after later ones: it was left out");
}

TEST(StreamDevice, AStallWithoutLossSaysSo) {
  Bench bench;
  for (std::uint32_t n = 0; n < 100; ++n) bench.frame(n);
  bench.silence(700'000);
  bench.frame(100);
  EXPECT_NE(bench.lastEvent("gap").text.find("none is missing"), std::string::npos);
  EXPECT_EQ(bench.status().lost, 0u);
}

TEST(StreamDevice, AFrameThatArrivesAgainIsLeftOutAndCounted) {
  Bench bench;
  for (std::uint32_t n = 0; n < 50; ++n) {
    bench.frame(n);
    if (n > 0 && n % 3 == 0) bench.frame(n, 0);
  }
  EXPECT_EQ(bench.status().items, 50u);
  EXPECT_EQ(bench.status().suspect, 16u);
  EXPECT_EQ(bench.link->lastFault(), "frame 48 arrived again: the second one was left out");
}

TEST(StreamDevice, ASenderThatStopsCountingIsRead) {
  Bench bench;
  for (std::uint32_t n = 0; n < 10; ++n) bench.frame(n);
  for (int i = 0; i < 20; ++i) bench.frame(9);
  EXPECT_EQ(bench.status().items, 28u);
  EXPECT_EQ(bench.status().suspect, 2u);
}

TEST(StreamDevice, ValuesOutOfRangeAreDeliveredAndTold) {
  Bench bench;
  for (int i = 0; i < 3; ++i) bench.send("1,5000,3\n");
  EXPECT_EQ(bench.status().items, 3u);
  EXPECT_EQ(bench.sink.frames[0].values, (std::vector<float>{1, 5000, 3}));
  EXPECT_EQ(bench.status().suspect, 0u);
  EXPECT_EQ(bench.status().outOfRange, 3u);
  EXPECT_EQ(bench.link->lastOutOfRange(), "line 3: value 2 is 5000, not in 0..4095 counts");
  EXPECT_EQ(bench.link->remarks().size(), 1u);
  EXPECT_EQ(bench.numEvents("alarm"), 1u);
}

TEST(StreamDevice, WhatTheFirstNumberWasTakenForIsSaidOnce) {
  Bench bench;
  for (int i = 0; i < 5; ++i) bench.send(std::to_string(10 * i) + ",1,2,3\n");
  ASSERT_EQ(bench.link->remarks().size(), 1u);
  EXPECT_NE(bench.link->remarks()[0].find("is taken for its time in milliseconds"),
            std::string::npos);
  EXPECT_EQ(bench.lastEvent("link").text, bench.link->remarks()[0]);
}

// Without numbers in them the labels say no order: after a reconnection they keep what they stood
// for.
TEST(StreamDevice, LabelsKeepTheirTaxelsOverAReconnection) {
  Bench bench;
  bench.send("a:1,b:2,c:3\n");
  bench.replug();
  bench.send("c:30,b:20,a:10\n");
  ASSERT_EQ(bench.sink.frames.size(), 2u);
  EXPECT_EQ(bench.sink.frames[1].values, (std::vector<float>{10, 20, 30}));
}

TEST(StreamDevice, LinesThatAreTakenForFramesAreSaidOnce) {
  Bench bench;
  bench.send("raw:1,2,3\nimu:7,8,9\nraw:4,5,6\n");
  EXPECT_EQ(bench.sink.frames.size(), 2u);
  EXPECT_EQ(bench.status().suspect, 1u);
  bench.replug();
  bench.send("raw:1,2,3\nraw:4,5,6\n");
  EXPECT_EQ(bench.sink.frames.size(), 4u);
  ASSERT_EQ(bench.link->remarks().size(), 1u);
  EXPECT_EQ(bench.link->remarks()[0],
            "lines with \"raw\" are taken for the frames: it is not one of the hand's names, but "
            "no other lines are frames");
}

TEST(StreamDevice, BytesWithoutTheEndOfALineAreNamed) {
  Bench bench;
  for (int i = 0; i < 20; ++i) bench.send("1;2;3;", 50'000);
  EXPECT_EQ(bench.status().message,
            "port: no frames for 0.5 s; 60 bytes came without the end of a line");
}

TEST(StreamDevice, LossOverABrokenConnectionIsCountedByTheNumbers) {
  Bench bench;
  for (std::uint32_t n = 0; n < 10; ++n) bench.frame(n);
  bench.replug();
  bench.frame(30);
  EXPECT_EQ(bench.status().lost, 20u);
  EXPECT_EQ(bench.status().estimatedLost, 0u);
  EXPECT_EQ(bench.status().reconnects, 1u);
  const Json gap = Json::parse(bench.lastEvent("gap").json);
  EXPECT_EQ(gap.at("lost").asInteger(), 20);
  EXPECT_FALSE(gap.at("estimated").asBool());
}

TEST(StreamDevice, WithoutNumbersLossInAGapIsEstimated) {
  Bench bench;
  for (int i = 0; i < 50; ++i) bench.send("1,2,3\n", 10'000);
  bench.silence(1'990'000);
  EXPECT_EQ(bench.status().state, PortState::kSilent);
  bench.send("1,2,3\n", 10'000);
  const Json gap = Json::parse(bench.lastEvent("gap").json);
  EXPECT_TRUE(gap.at("estimated").asBool());
  EXPECT_NEAR(static_cast<double>(gap.at("lost").asInteger()), 199.0, 5.0);
  EXPECT_EQ(bench.status().estimatedLost, bench.status().lost);
  EXPECT_EQ(bench.status().state, PortState::kStreaming);
}

TEST(StreamDevice, SilenceIsNoticedAfterHalfASecond) {
  Bench bench;
  for (std::uint32_t n = 0; n < 10; ++n) bench.frame(n);
  bench.silence(450'000);
  EXPECT_EQ(bench.status().state, PortState::kStreaming);
  bench.silence(100'000);
  EXPECT_EQ(bench.status().state, PortState::kSilent);
  EXPECT_NE(bench.status().message.find("is the sender running?"), std::string::npos);
  EXPECT_EQ(bench.numEvents("alarm"), 1u);
  bench.silence(5'000'000);
  EXPECT_EQ(bench.numEvents("alarm"), 1u);
}

TEST(StreamDevice, ARefusedLineIsNamedAndCounted) {
  Bench bench;
  bench.send("1,2,3\n");
  bench.send("1,2\n1,2,3\n");
  EXPECT_EQ(bench.status().suspect, 1u);
  EXPECT_EQ(bench.status().items, 2u);
  EXPECT_EQ(bench.status().message, "port: line 2: 2 numbers instead of 3");
  EXPECT_EQ(bench.link->lastFault(), "line 2: 2 numbers instead of 3");
  EXPECT_EQ(bench.lastEvent("alarm").text, "line 2: 2 numbers instead of 3");
  for (int i = 0; i < 100; ++i) bench.send("1,2\n1,2,3\n");
  EXPECT_EQ(bench.numEvents("alarm"), 1u);  // one in ten seconds
  EXPECT_EQ(bench.status().suspect, 101u);
  for (int i = 0; i < 300; ++i) bench.send("1,2,3\n");
  EXPECT_EQ(bench.status().message, "");
}

TEST(StreamDevice, AStreamOfTheWrongSizeSaysSoWhileNoFrameComes) {
  Bench bench;
  for (int i = 0; i < 100; ++i) bench.send("1,2,3,4,5\n");
  EXPECT_EQ(bench.status().items, 0u);
  EXPECT_NE(bench.status().message.find("5 numbers instead of 3"), std::string::npos);
  Bench packets;
  for (int i = 0; i < 100; ++i) {
    Bytes bytes;
    appendStreamFrame(bytes, 1, 0, std::vector<float>(5));
    packets.send(bytes);
  }
  EXPECT_EQ(packets.status().items, 0u);
  EXPECT_NE(packets.link->lastFault().find("10 bytes of u16 values (5) instead of 3"),
            std::string::npos)
      << packets.link->lastFault();
}

TEST(StreamDevice, TheFirstItemDecidesTheFormAnewForEachConnection) {
  Bench bench;
  bench.send("\x01\xA5\x5A noise\n");
  bench.frame(0);
  bench.frame(1);
  EXPECT_EQ(bench.status().items, 2u);
  EXPECT_EQ(bench.status().suspect, 0u);
  bench.send("1,2,3\n");  // packets by now
  EXPECT_EQ(bench.status().items, 2u);
  EXPECT_EQ(bench.status().skippedBytes, 16u);
  bench.replug();
  bench.send("1,2,3\n");
  EXPECT_EQ(bench.status().items, 3u);
}

TEST(StreamDevice, ANamedFormTakesNoOther) {
  Bench lines({.format = StreamFormat::kLines});
  lines.frame(1);
  lines.send("\n{\"tactile_matrix\":[]}\n1,2,3\n");
  EXPECT_EQ(lines.status().items, 1u);
  Bench binary({.format = StreamFormat::kBinary});
  binary.send("1,2,3\n");
  EXPECT_EQ(binary.status().items, 0u);
  EXPECT_EQ(binary.status().skippedBytes, 6u);
  Bench json({.format = StreamFormat::kJson});
  json.send("1,2,3\n");
  EXPECT_EQ(json.status().items, 0u);
  EXPECT_NE(json.link->lastFault().find("not a JSON object"), std::string::npos);
}

TEST(StreamDevice, ADescriptionThatDisagreesKeepsFramesOut) {
  Bench bench({.hand = padHand({{2, 2}})});
  bench.send("{\"description\":{\"matrices\":[{\"rows\":1,\"columns\":4}]}}\n1,2,3,4\n");
  EXPECT_EQ(bench.status().items, 0u);
  EXPECT_EQ(bench.status().suspect, 2u);
  EXPECT_NE(bench.status().message.find("1 x 4 places"), std::string::npos);
  bench.send(
      "{\"description\":{\"serial\":\"P7\",\"matrices\":[{\"rows\":2,\"columns\":2}]}}\n"
      "1,2,3,4\n");
  EXPECT_EQ(bench.status().items, 1u);
  EXPECT_EQ(bench.link->description().serial, "P7");
}

TEST(StreamDevice, AWrongUnitOfTimeIsReportedOnce) {
  Bench bench;
  // Microseconds, taken as milliseconds.
  for (int i = 0; i < 1000; ++i)
    bench.send(std::to_string(3'000'000 + 5'000 * i) + ",1,2,3\n", 5'000);
  std::size_t told = 0;
  for (const Event& event : bench.sink.events)
    told += event.text.find("is the unit of its times right?") != std::string::npos;
  EXPECT_EQ(told, 1u);
  EXPECT_EQ(bench.status().items, 1000u);
}

TEST(StreamDevice, TheAgeIsThatOfTheFastestFrame) {
  Bench bench;
  for (int i = 1; i <= 20; ++i) bench.send(std::to_string(10 * i) + ",1,2,3\n", 10'000);
  EXPECT_NEAR(bench.status().ageMs, 0.0, 1e-9);
  bench.send("210,1,2,3\n", 35'000);
  EXPECT_NEAR(bench.status().ageMs, 25.0, 1e-9);
}

TEST(StreamDevice, RandomBytesAreNoFrames) {
  Bench bench;
  std::uint32_t state = 1;
  for (int i = 0; i < 200; ++i) {
    Bytes bytes(1000);
    for (std::byte& byte : bytes)
      byte = static_cast<std::byte>((state = state * 1'664'525 + 1'013'904'223) >> 24);
    bench.send(bytes);
  }
  EXPECT_EQ(bench.sink.frames.size(), 0u);
  EXPECT_GT(bench.status().suspect, 100u);
  bench.frame(1);
  EXPECT_EQ(bench.sink.frames.size(), 1u);
}

// --- The device with its thread, on real channels.

StreamDeviceOptions optionsOf(const std::string& source) {
  StreamDeviceOptions options;
  options.source = source;
  options.hand = padHand({{1, 3}});
  return options;
}

int connectedSocket(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  return fd;
}

void sendTo(int fd, std::string_view text) {
  ASSERT_EQ(::send(fd, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
}

TEST(StreamDevice, ReadsAPtyAndFollowsItsLink) {
  const TemporaryFolder folder;
  const std::filesystem::path link = folder / "port";
  auto pty = std::make_unique<PtyPair>();
  std::filesystem::create_symlink(pty->path(), link);
  CollectingSink sink;
  StreamDevice device(optionsOf(link.string()));
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.status().tactile.state == PortState::kStreaming; }));
  // The first line may lack its beginning.
  pty->send(textBytes("9,9,9\n1,2,3\n4,5,6\n"));
  ASSERT_TRUE(sink.awaitFrames(2));
  EXPECT_EQ(sink.takeFrames()[0].values, (std::vector<float>{1, 2, 3}));
  pty->unplug();
  ASSERT_TRUE(awaited([&] { return device.status().tactile.state == PortState::kLost; }));
  std::filesystem::remove(link);
  pty = std::make_unique<PtyPair>();
  std::filesystem::create_symlink(pty->path(), link);
  ASSERT_TRUE(awaited([&] { return device.status().tactile.reconnects == 1; }));
  pty->send(textBytes("8,9\n7,8,9\n"));
  ASSERT_TRUE(sink.awaitFrames(3));
  device.stop();
  EXPECT_EQ(device.status().tactile.state, PortState::kClosed);
}

TEST(StreamDevice, SendersConnectOneAfterTheOther) {
  CollectingSink sink;
  StreamDevice device(optionsOf("listen:0"));
  EXPECT_EQ(device.notice(), "");
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  const std::uint16_t port = *device.localPort();
  EXPECT_EQ(
      device.notice(),
      "listening at 127.0.0.1:" + std::to_string(port) + ", for programs of this machine only");
  EXPECT_FALSE(device.isOpenToOthers());
  EXPECT_TRUE(awaited([&] {
    return device.status().tactile.message ==
           "listen:0: no sender is connected; waiting at 127.0.0.1:" + std::to_string(port);
  })) << device.status().tactile.message;
  for (std::size_t sender = 1; sender <= 3; ++sender) {
    const int fd = connectedSocket(port);
    sendTo(fd, "1,2,3\n4,5,6");  // the line without its end goes with its connection
    ASSERT_TRUE(sink.awaitFrames(sender));
    ::close(fd);
  }
  EXPECT_TRUE(awaited([&] { return device.status().tactile.state == PortState::kLost; }));
  EXPECT_EQ(device.status().tactile.suspect, 3u) << "stranger S9";
  EXPECT_EQ(device.status().tactile.items, 3u);
  device.stop();
  EXPECT_FALSE(device.localPort());
}

// A stranger at the port: a megabyte of random bytes, a part of them like the beginnings of packets
// and lines. Nothing becomes a frame, memory is bounded, and the next sender is understood.
TEST(StreamDevice, RandomBytesOnThePortAreNoFrames) {
  for (const StreamFormat format :
       {StreamFormat::kAuto, StreamFormat::kLines, StreamFormat::kBinary}) {
    CollectingSink sink;
    StreamDeviceOptions options = optionsOf("listen:0");
    options.format = format;
    StreamDevice device(options);
    device.start(sink);
    ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
    std::uint32_t state = 7;
    const auto next = [&] { return (state = state * 1'664'525 + 1'013'904'223) >> 24; };
    std::string junk;
    while (junk.size() < 1'000'000) {
      junk += static_cast<char>(next());
      if (next() == 0) junk += "\xA5\x5A\x01\x01";
      if (next() == 1) junk += "\n{\"tactile_matrix\":";
    }
    {
      const int fd = connectedSocket(*device.localPort());
      for (std::size_t at = 0; at < junk.size(); at += 10'000)
        sendTo(fd, std::string_view(junk).substr(at, 10'000));
      ::close(fd);
    }
    ASSERT_TRUE(awaited([&] { return device.status().tactile.bytes >= junk.size(); }));
    EXPECT_EQ(sink.numFrames(), 0u);
    EXPECT_EQ(device.status().tactile.items, 0u);
    EXPECT_GT(device.status().tactile.suspect + device.status().tactile.skippedBytes, 100u);
    EXPECT_NE(device.lastFault(), "");
    const int fd = connectedSocket(*device.localPort());
    if (format == StreamFormat::kBinary) {
      Bytes bytes;
      appendStreamFrame(bytes, 1, 0, std::vector<float>{1, 2, 3});
      sendTo(fd, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } else {
      sendTo(fd, "1,2,3\n");
    }
    EXPECT_TRUE(sink.awaitFrames(1));
    device.stop();
    ::close(fd);
  }
}

TEST(StreamDevice, ConnectsToASenderThatListens) {
  CollectingSink sink;
  const int listening = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  ASSERT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&place), size), 0);
  ASSERT_EQ(::listen(listening, 1), 0);
  ASSERT_EQ(::getsockname(listening, reinterpret_cast<sockaddr*>(&place), &size), 0);
  StreamDevice device(optionsOf("tcp:127.0.0.1:" + std::to_string(ntohs(place.sin_port))));
  device.start(sink);
  const int fd = ::accept(listening, nullptr, nullptr);
  sendTo(fd, "half\n1,2,3\n");
  EXPECT_TRUE(sink.awaitFrames(1));
  device.stop();
  ::close(fd);
  ::close(listening);
}

TEST(StreamDevice, ADatagramIsALineOrPackets) {
  const HandDescription hand = padHand({{1, 3}});
  CollectingSink sink;
  StreamDevice device(optionsOf("udp:0"));
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  DatagramSender sender(*device.localPort());
  // As palpate stream --to tactile sends a frame: without a line end.
  TactileFrame frame(hand.layout);
  frame.values = {5, 6, 7};
  for (std::uint64_t n = 0; n < 3; ++n) {
    std::string message;
    appendTactileSensorJson(message, frame, 10 * n);
    ASSERT_TRUE(sender.send(message));
  }
  ASSERT_TRUE(sink.awaitFrames(3));
  EXPECT_EQ(sink.takeFrames()[2].values, frame.values);
  EXPECT_EQ(device.status().tactile.lost, 18u);
  device.stop();
}

TEST(StreamDevice, ADatagramThatWasOvertakenIsLeftOut) {
  CollectingSink sink;
  StreamDevice device(optionsOf("udp:0"));
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  DatagramSender sender(*device.localPort());
  for (const int n : {100, 101, 103, 102, 104})
    ASSERT_TRUE(sender.send("f#" + std::to_string(n) + ",1,2," + std::to_string(n)));
  ASSERT_TRUE(sink.awaitFrames(4));
  EXPECT_EQ(sink.takeFrames()[3].values[2], 104.0F);
  EXPECT_EQ(device.status().tactile.lost, 1u);
  ASSERT_TRUE(awaited([&] { return device.status().tactile.suspect == 1; }));
  // Two numbers that are not missing and follow each other are a sender that was restarted.
  for (const int n : {90, 91, 92})
    ASSERT_TRUE(sender.send("f#" + std::to_string(n) + ",1,2," + std::to_string(n)));
  ASSERT_TRUE(sink.awaitFrames(6));
  EXPECT_EQ(device.status().tactile.lost, 1u);
  device.stop();
}

TEST(StreamDevice, LateDatagramsInSuccessionAreNoRestart) {
  CollectingSink sink;
  StreamDevice device(optionsOf("udp:0"));
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  DatagramSender sender(*device.localPort());
  for (const int n : {100, 101, 104, 102, 103, 105})
    ASSERT_TRUE(sender.send("f#" + std::to_string(n) + ",1,2," + std::to_string(n)));
  ASSERT_TRUE(sink.awaitFrames(4));
  EXPECT_EQ(sink.takeFrames()[3].values[2], 105.0F);
  EXPECT_EQ(device.status().tactile.lost, 2u);
  ASSERT_TRUE(awaited([&] { return device.status().tactile.suspect == 2; }));
  device.stop();
}

TEST(StreamDevice, TwoSendersOfDatagramsAreNamed) {
  CollectingSink sink;
  StreamDevice device(optionsOf("udp:0"));
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  DatagramSender one(*device.localPort()), two(*device.localPort());
  for (int n = 0; n < 5; ++n) {
    ASSERT_TRUE(one.send("1,2,3"));
    ASSERT_TRUE(two.send("4,5,6"));
  }
  ASSERT_TRUE(sink.awaitFrames(10));
  ASSERT_TRUE(awaited([&] { return !device.remarks().empty(); }));
  EXPECT_NE(device.remarks()[0].find("two senders use the port, 127.0.0.1:"), std::string::npos)
      << device.remarks()[0];
  device.stop();
  EXPECT_EQ(device.remarks().size(), 1u);
}

// Read by the device's thread while the test sets it.
struct SharedClock : Clock {
  std::int64_t monotonicUs() const override { return nowUs; }
  std::int64_t wallUs() const override { return 1'500'000'000'000'000 + nowUs; }
  std::atomic<std::int64_t> nowUs = 0;
};

// The first client holds the port and is silent; its other end may be dead.
TEST(StreamDevice, ASenderThatCameBackIsReadInsteadOfADeadConnection) {
  SharedClock clock;
  CollectingSink sink;
  StreamDevice device(optionsOf("listen:0"), clock);
  device.start(sink);
  const auto advanced = [&](const std::function<bool()>& condition) {
    return awaited([&] {
      clock.nowUs += 50'000;
      return condition();
    });
  };
  ASSERT_TRUE(advanced([&] { return device.localPort().has_value(); }));
  const int dead = connectedSocket(*device.localPort());
  sendTo(dead, "1,2,3\n");
  ASSERT_TRUE(advanced([&] { return sink.numFrames() == 1; }));
  ASSERT_TRUE(advanced([&] {
    return device.status().tactile.message.find("holds the port") != std::string::npos;
  })) << device.status().tactile.message;
  const int back = connectedSocket(*device.localPort());
  sendTo(back, "4,5,6\n4,5,7\n4,5,8\n");
  ASSERT_TRUE(advanced([&] { return sink.numFrames() == 4; }));
  EXPECT_EQ(sink.takeFrames()[3].values, (std::vector<float>{4, 5, 8}));
  device.stop();
  ::close(dead);
  ::close(back);
  bool gap = false;
  for (const Event& event : sink.takeEvents()) gap = gap || event.kind == "gap";
  EXPECT_TRUE(gap);
}

TEST(StreamDevice, APortThatIsInUseIsNamed) {
  CollectingSink sink;
  StreamDevice first(optionsOf("udp:0"));
  first.start(sink);
  ASSERT_TRUE(awaited([&] { return first.localPort().has_value(); }));
  StreamDevice second(optionsOf("udp:" + std::to_string(*first.localPort())));
  second.start(sink);
  EXPECT_TRUE(awaited([&] {
    return second.status().tactile.message.find("another program uses this port") !=
           std::string::npos;
  })) << second.status().tactile.message;
}

TEST(StreamDevice, SaysWhenOtherMachinesCanSend) {
  CollectingSink sink;
  StreamDevice device(optionsOf("udp:0.0.0.0:0"));
  EXPECT_TRUE(device.isOpenToOthers());
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  EXPECT_NE(device.notice().find("any machine that reaches this address"), std::string::npos);
  EXPECT_FALSE(StreamDevice(optionsOf("udp:[::1]:0")).isOpenToOthers());
}

TEST(StreamDevice, TakesNoCommand) {
  StreamDevice device(optionsOf("udp:0"));
  for (const DeviceCommand& command :
       {DeviceCommand{SetThreshold{}}, DeviceCommand{MoveJoints{}}, DeviceCommand{StopMotion{}}}) {
    try {
      device.submit(command).get();
      ADD_FAILURE() << "it was executed";
    } catch (const DeviceError& error) {
      EXPECT_EQ(error.fault(), DeviceFault::kUnsupported);
      EXPECT_STREQ(error.what(), "udp:0: a stream only sends: it can't be moved or set from here");
    }
  }
}

TEST(StreamDevice, RefusesOptionsThatMakeNoSense) {
  for (const char* source :
       {"", "udp:", "udp:x", "udp:70000", "listen:nohost:1", "listen:1:", "udp:-1"})
    EXPECT_THROW(StreamDevice{optionsOf(source)}, std::invalid_argument) << source;
  StreamDeviceOptions options = optionsOf("udp:0");
  options.baud = 10;
  EXPECT_THROW(StreamDevice{options}, std::invalid_argument);
  options.baud = 9600;
  options.hand = {};
  EXPECT_THROW(StreamDevice{options}, std::invalid_argument);
}

}  // namespace
}  // namespace palpate::testing::stream_device_test
