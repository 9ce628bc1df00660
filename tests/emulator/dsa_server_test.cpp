#include "palpate/emulator/dsa_server.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include "palpate/device/sdh2.h"

#include "emulator/line_client.h"
#include "emulator/still_hand.h"
#include "testing/testing.h"

namespace palpate::dsa_server_test {
namespace {

using testing::DecodedFrame;
using testing::decodeFramePayload;
using testing::hexText;
using testing::Octets;
using testing::octets;
using testing::PacketScanner;
using testing::StillHand;
using testing::tactilePacket;

std::span<const std::byte> bytesOf(const Octets& octets) {
  return std::as_bytes(std::span(octets));
}

Octets octetsOf(const LineMessage& message) {
  Octets bytes;
  for (const std::byte b : message.bytes) bytes.push_back(std::to_integer<std::uint8_t>(b));
  return bytes;
}

class DsaServerTest : public ::testing::Test {
 protected:
  // The server's answer to these bytes, as hexadecimal text.
  std::string say(const Octets& request, std::int64_t nowUs = 0) {
    server.receive(bytesOf(request), nowUs);
    return taken();
  }
  std::string say(const std::string& hex) { return say(octets(hex)); }
  std::string taken() {
    Octets all;
    for (const LineMessage& message : server.take()) {
      const Octets bytes = octetsOf(message);
      all.insert(all.end(), bytes.begin(), bytes.end());
    }
    return hexText(all);
  }
  // The same text, written as in a document: with "00x28" for repeats.
  static std::string hex(const std::string& text) { return hexText(octets(text)); }
  // An answer that contains only an error code or an acknowledgement.
  static std::string bare(std::uint8_t id, std::uint8_t code) {
    return hexText(tactilePacket(id, {code, 0}));
  }
  // Runs a stream of `count` frames; the line is free when all bytes have left it at 115200 baud.
  std::vector<DecodedFrame> stream(std::size_t count, bool paced = true) {
    std::vector<DecodedFrame> frames;
    double freeUs = 0.0;
    while (frames.size() < count) {
      const auto free = static_cast<std::int64_t>(std::ceil(freeUs));
      const auto next = server.nextFrameUs(free);
      if (!next) break;
      server.advance(*next, free);
      for (const LineMessage& message : server.take()) {
        if (paced) freeUs = static_cast<double>(*next) + 86.8056 * double(message.bytes.size());
        const Octets packet = octetsOf(message);
        const auto frame = decodeFramePayload(Octets(packet.begin() + 6, packet.end() - 2));
        if (frame) frames.push_back(*frame);
      }
    }
    return frames;
  }
  // Frames per second by the controller's clock.
  static double rate(const std::vector<DecodedFrame>& frames) {
    return 1000.0 * double(frames.size() - 1) / (frames.back().deviceMs - frames.front().deviceMs);
  }

  StillHand hand;
  DsaServer server{hand};
};

const std::string kPush = "AA AA AA 03 03 00 81 01 00 7C 5C";
const std::string kStop = "AA AA AA 03 03 00 01 00 00 2F 6A";
const std::string kAcknowledge = "AA AA AA 03 02 00 00 00 4B B9";

// Literal bytes of the protocol document, sections 1.3 to 1.7 and 4.1.
TEST_F(DsaServerTest, AnswersTheOpenSequenceByteForByte) {
  EXPECT_EQ(say(kStop), kAcknowledge);
  EXPECT_EQ(say("AA AA AA 01 00 00"),
            "AA AA AA 01 12 00 00 00 57 00 9B 1D 10 00 29 80 70 00 00 00 00 00 00 00 2F 36");
  EXPECT_EQ(say("AA AA AA 02 00 00"),
            "AA AA AA 02 0C 00 00 00 06 00 69 00 01 57 00 9B 1D 00 6F E1");
  EXPECT_EQ(say("AA AA AA 0B 01 00 00 CB FB"),
            "AA AA AA 0B 34 00 00 00 9A 99 59 40 9A 99 59 40 06 00 0E 00 10 22 33 44 55 66 00 00 "
            "01 00 00 48 C2 00 00 00 C2 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 FF 0F 00 "
            "00 00 9A 91");
  EXPECT_EQ(say("AA AA AA 0B 01 00 01 EA EB"),
            "AA AA AA 0B 34 00 00 00 9A 99 59 40 9A 99 59 40 06 00 0D 00 11 22 33 44 55 66 00 00 "
            "01 00 00 48 C2 00 00 00 42 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 FF 0F 00 "
            "00 00 79 44");
  for (const char* request : {"02 89 DB", "03 A8 CB", "04 4F BB", "05 6E AB"})
    EXPECT_EQ(say(std::string("AA AA AA 0B 01 00 ") + request).substr(0, 23),
              "AA AA AA 0B 34 00 00 00");
}

TEST_F(DsaServerTest, ReadsAndWritesMasksByteForByte) {
  EXPECT_EQ(say("AA AA AA 04 02 00 00 01 EF 00"),
            "AA AA AA 04 0C 00 00 00 9E E7 79 DE FF FF FF FF FF 3F 58 8B");
  EXPECT_EQ(say("AA AA AA 04 02 00 01 00 9D 24"), hex("AA AA AA 04 0D 00 00 00 FFx10 0F A9 A3"));
  EXPECT_EQ(say("AA AA AA AB 0D 00 01 00 6A A5 56 6A A5 56 6A A5 56 6A 05 F5 26"),
            "AA AA AA AB 02 00 00 00 9D 8F");
  // 6A = 0110 1010: of the first eight taxels, 1, 3, 5 and 6 are on.
  const Mask& mask = hand.settings()[0].dynamicMask;
  EXPECT_EQ(Mask(mask.begin(), mask.begin() + 8), (Mask{0, 1, 0, 1, 0, 1, 1, 0}));
  EXPECT_EQ(say(tactilePacket(0x04, {1, 0})),
            hexText(tactilePacket(0x04, octets("00 00 6A A5 56 6A A5 56 6A A5 56 6A 05"))));
  EXPECT_EQ(say(tactilePacket(0x04, {0, 0})),
            hexText(tactilePacket(0x04, octets("00 00 FFx10 0F"))));
  EXPECT_EQ(say(tactilePacket(0x04, {1, 1})),
            hexText(tactilePacket(0x04, octets("00 00 FFx9 3F"))));
}

TEST_F(DsaServerTest, KnowsSensitivitiesAndThresholds) {
  hand.settings()[1].sensitivity = 0.75;
  hand.settings()[1].thresholdCounts = 33;
  EXPECT_EQ(say(tactilePacket(0x12, {1})),
            "AA AA AA 12 0B 00 00 00 02 00 00 40 3F 00 00 00 3F 61 ED");
  EXPECT_EQ(say(tactilePacket(0x14, {1})), "AA AA AA 14 04 00 00 00 21 00 55 E9");
  // Sets 0.25 for matrix 3, then resets all matrices to the factory value.
  EXPECT_EQ(say(tactilePacket(0x0F, {0, 3, 0, 0, 0x80, 0x3E})), bare(0x0F, 0));
  EXPECT_DOUBLE_EQ(hand.settings()[3].sensitivity, 0.25);
  EXPECT_DOUBLE_EQ(hand.settings()[2].sensitivity, 0.5);
  EXPECT_EQ(say(tactilePacket(0x0F, {0x03, 0, 0, 0, 0, 0})), bare(0x0F, 0));
  for (const MatrixSetting& setting : hand.settings()) EXPECT_DOUBLE_EQ(setting.sensitivity, 0.5);
  EXPECT_EQ(say(tactilePacket(0x13, {0x02, 0, 0x90, 0x01})), bare(0x13, 0));
  for (const MatrixSetting& setting : hand.settings()) EXPECT_EQ(setting.thresholdCounts, 400);
  EXPECT_EQ(say(tactilePacket(0x13, {0x01, 5, 0, 0})), bare(0x13, 0));
  EXPECT_EQ(hand.settings()[5].thresholdCounts, 300);
}

TEST_F(DsaServerTest, StoresPersistentSettingsWithoutAnAnswerAndForgetsTheOthers) {
  EXPECT_EQ(say(tactilePacket(0x0F, {0x80, 2, 0, 0, 0x80, 0x3F})), "");
  EXPECT_EQ(say(tactilePacket(0x13, {0x82, 0, 77, 0})), "");
  EXPECT_EQ(say(tactilePacket(0x13, {0x00, 4, 5, 0})), bare(0x13, 0));
  EXPECT_DOUBLE_EQ(hand.settings()[2].sensitivity, 1.0);
  server.powerCycle(1000, 0.0);
  EXPECT_DOUBLE_EQ(hand.settings()[2].sensitivity, 1.0);
  EXPECT_EQ(hand.settings()[4].thresholdCounts, 77);
}

TEST_F(DsaServerTest, RefusesWithTheDocumentsErrorCodes) {
  EXPECT_EQ(say(tactilePacket(0x0B, {6})), "AA AA AA 0B 02 00 18 00 62 52");  // index out of bounds
  EXPECT_EQ(say("AA AA AA 03 03 00 81 01 00 7C 5D"), "AA AA AA 03 02 00 0B 00 37 64");  // checksum
  EXPECT_EQ(say(tactilePacket(0x77, {1})), bare(0x77, 13));  // unknown command
  EXPECT_EQ(say("AA AA AA 77 00 00"), bare(0x77, 13));
  EXPECT_EQ(say("AA AA AA 0B 00 00"), bare(0x0B, 12));          // not enough parameters
  EXPECT_EQ(say(tactilePacket(0x0B, {0, 0})), bare(0x0B, 14));  // format
  EXPECT_EQ(say(tactilePacket(0x01, {0})), bare(0x01, 14));
  EXPECT_EQ(say(tactilePacket(0x03, {0x81, 0})), bare(0x03, 12));
  EXPECT_EQ(say(tactilePacket(0x04, {2, 0})), bare(0x04, 23));  // invalid parameter
  EXPECT_EQ(say(tactilePacket(0x04, {0, 9})), bare(0x04, 24));
  EXPECT_EQ(say(tactilePacket(0xAB, {0, 0, 1})), bare(0xAB, 15));  // access denied
  EXPECT_EQ(say(tactilePacket(0xAB, {1, 0, 1})), bare(0xAB, 12));
  EXPECT_EQ(say(tactilePacket(0xAB, {1, 200, 1})), bare(0xAB, 24));
  EXPECT_EQ(say(tactilePacket(0x0F, {0, 0, 0, 0, 0xC0, 0x7F})), bare(0x0F, 27));  // NaN
  EXPECT_EQ(say(tactilePacket(0x0F, {0, 0, 0, 0, 0, 0x40})), bare(0x0F, 27));     // 2.0
  EXPECT_EQ(say(tactilePacket(0x0F, {0, 6, 0, 0, 0, 0x3F})), bare(0x0F, 24));
  EXPECT_EQ(say(tactilePacket(0x13, {0, 0, 0x00, 0x10})), bare(0x13, 27));  // 4096
  EXPECT_EQ(say(tactilePacket(0x13, {0, 0, 1})), bare(0x13, 12));
  EXPECT_EQ(say(tactilePacket(0x12, {6})), bare(0x12, 24));
  for (const std::uint8_t id : {0x0C, 0x0D, 0x0E, 0x10})
    EXPECT_EQ(say(tactilePacket(id, {1, 0})), bare(id, 5)) << int{id};  // not supported
  // An error must not look like a frame.
  EXPECT_EQ(say("AA AA AA 00 00 00"), "");
}

TEST_F(DsaServerTest, AnswersWhatOtherClientsAsk) {
  EXPECT_EQ(say("AA AA AA 0A 00 00"), bare(0x0A, 0));
  EXPECT_EQ(say("AA AA AA 06 00 00"), bare(0x06, 0));
  const std::string text = std::string(2, '\0') + sdh2().matrixName(4);
  EXPECT_EQ(say(tactilePacket(0x05, {1, 4})),
            hexText(tactilePacket(0x05, Octets(text.begin(), text.end()))));
  EXPECT_EQ(say(tactilePacket(0x05, {1, 6})), bare(0x05, 24));
  EXPECT_EQ(say(tactilePacket(0x05, {2, 0})), bare(0x05, 23));
  EXPECT_GT(say(tactilePacket(0x05, {0, 0})).size(), bare(0x05, 0).size());
}

TEST_F(DsaServerTest, SendsTheDocumentsFrames) {
  // An empty frame at 1024 ms.
  DsaServerOptions options;
  options.startMs = 1024;
  options.frameHz = 1000.0;
  DsaServer early(hand, options);
  early.receive(bytesOf(octets("AA AA AA 03 03 00 81 00 00 2F 68")), 0);
  early.advance(0, 0);
  early.advance(999, 0);
  auto messages = early.take();
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(hexText(octetsOf(messages[0])), kAcknowledge);
  EXPECT_EQ(hexText(octetsOf(messages[1])),
            hex("AA AA AA 00 47 00 00 04 00 00 01 00F0x32 00 60 40 FB"));
  EXPECT_EQ(messages[1].frame, 0u);
  // The same frame, raw.
  DsaServer raw(hand, options);
  raw.receive(bytesOf(octets("AA AA AA 03 03 00 80 00 00 8D 02")), 0);
  raw.advance(999, 0);
  messages = raw.take();
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(hexText(octetsOf(messages[1])), hex("AA AA AA 00 D1 03 00 04 00 00 00 00x972 96 62"));
  // A frame with two taxels of matrix 1.
  hand.values[121] = hand.values[122] = 1200;
  options.startMs = 0x12345;
  DsaServer touched(hand, options);
  touched.receive(bytesOf(octets("AA AA AA 03 03 00 81 00 00 2F 68")), 0);
  touched.advance(999, 0);
  messages = touched.take();
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(hexText(octetsOf(messages[1])),
            hex("AA AA AA 00 4B 00 45 23 01 00 01 00F0x8 00 10 B0 24 00F0x24 00 30 AB 2C"));
}

TEST_F(DsaServerTest, StreamsUntilStopped) {
  EXPECT_EQ(say(kPush), kAcknowledge);
  EXPECT_TRUE(server.streaming());
  EXPECT_EQ(stream(20).size(), 20u);
  EXPECT_EQ(say(kStop), kAcknowledge);
  EXPECT_FALSE(server.nextUs(0));
  server.advance(1'000'000'000, 0);
  EXPECT_TRUE(server.take().empty());
}

TEST_F(DsaServerTest, SendsOneFramePerSingleCommand) {
  const std::string single = "AA AA AA 03 03 00 81 00 00 2F 68";
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(say(single), kAcknowledge);
    EXPECT_EQ(stream(5).size(), 1u);
  }
  say(single);
  say(single);
  EXPECT_EQ(stream(5).size(), 2u);
}

TEST_F(DsaServerTest, TakesFlagsOfAnyClientForAStream) {
  // As RobWork: internal trigger, rate 5. The controller acknowledges that it runs.
  EXPECT_EQ(say(tactilePacket(0x03, {0xA1, 5, 0})), kAcknowledge);
  EXPECT_TRUE(stream(2).at(1).runLength);
  EXPECT_EQ(say("AA AA AA 01 00 00").substr(45, 2), "C0");
  EXPECT_EQ(say(tactilePacket(0x03, {0xA0, 5, 0})), kAcknowledge);
  EXPECT_FALSE(stream(2).at(1).runLength);
  EXPECT_EQ(say("AA AA AA 03 03 00 00 00 00 8D 00"), kAcknowledge);
  EXPECT_FALSE(server.streaming());
}

// Section 3.1 and 1.6.1 of the document.
TEST_F(DsaServerTest, HasTheFrameRatesOfTheRealHand) {
  say(kPush);
  EXPECT_NEAR(rate(stream(300)), 31.7, 0.1);  // nothing touched: limited by the scan
  hand.noisy = true;                          // all 486 units: limited by the line
  EXPECT_NEAR(rate(stream(300)), 11.7, 0.05);
  hand.noisy = false;
  say("AA AA AA 03 03 00 80 01 00 DE 36");
  EXPECT_NEAR(rate(stream(300)), 11.7, 0.05);  // raw
  say(kPush);
  for (std::uint8_t m = 0; m < 6; ++m) {
    Octets mask(m % 2 == 0 ? 13 : 12, m == 1 ? 0xFF : 0);
    mask[0] = 1;
    mask[1] = m;
    EXPECT_EQ(say(tactilePacket(0xAB, mask)), bare(0xAB, 0));
  }
  const double oneMatrix = rate(stream(300));
  EXPECT_GT(oneMatrix, 55.0);
  EXPECT_LT(oneMatrix, 58.0);
  EXPECT_EQ(say(tactilePacket(0xAB, octets("01 01 03 00x9"))), bare(0xAB, 0));
  EXPECT_NEAR(rate(stream(300)), 76.0, 0.5);  // two taxels
}

TEST_F(DsaServerTest, ScanTimeIsMeasuredAtThreePointsAndStraightBetween) {
  EXPECT_DOUBLE_EQ(dsaScanUs(0), 13'200.0);
  EXPECT_DOUBLE_EQ(dsaScanUs(2), 13'200.0);
  EXPECT_DOUBLE_EQ(dsaScanUs(40), 13'200.0 + 4'500.0 * 38 / 76);
  EXPECT_DOUBLE_EQ(dsaScanUs(78), 17'700.0);
  EXPECT_DOUBLE_EQ(dsaScanUs(267), 24'600.0);
  EXPECT_DOUBLE_EQ(dsaScanUs(456), 31'500.0);
  EXPECT_DOUBLE_EQ(dsaScanUs(486), 31'500.0);
}

TEST_F(DsaServerTest, ClockWrapsAndNeverStandsStill) {
  DsaServerOptions options;
  options.startMs = 0xFFFFFFF0u;
  options.frameHz = 1000.0;
  DsaServer wrapping(hand, options);
  wrapping.receive(bytesOf(octets(kPush)), 0);
  std::optional<std::uint32_t> last;
  for (std::int64_t t = 0; t < 40'000; t += 1000) {
    wrapping.advance(t, 0);
    if (!wrapping.scanned()) continue;
    if (last) {
      EXPECT_EQ(wrapping.scanned()->deviceMs, *last + 1);  // modulo 2^32
    }
    last = wrapping.scanned()->deviceMs;
  }
  ASSERT_TRUE(last);
  EXPECT_LT(*last, 100u);
}

TEST_F(DsaServerTest, IsDeafWhileItBootsAndAsksForATerminal) {
  server.powerCycle(0, 8.0);
  std::vector<std::int64_t> queries;
  for (std::int64_t t = 0; t <= 8'500'000; t += 10'000) {
    server.advance(t, 0);
    for (const LineMessage& message : server.take()) {
      EXPECT_EQ(hexText(octetsOf(message)), "1B 5B 35 6E");
      queries.push_back(t);
    }
    if (t == 7'990'000) {
      EXPECT_EQ(say(octets(kStop), t), "");
    }
  }
  ASSERT_EQ(queries.size(), 3u);
  EXPECT_NEAR(double(queries[0]), 7e6, 2e4);
  EXPECT_LE(queries[2] - queries[0], 840'000);
  EXPECT_EQ(say(octets(kStop), 8'000'000), kAcknowledge);
}

TEST_F(DsaServerTest, FindsRequestsAmongNoise) {
  const std::string query = "AA AA AA 01 00 00";
  const std::string answer = say(query);
  EXPECT_EQ(say("00 AA 17 AA AA 55 " + query), answer);
  EXPECT_EQ(say("AA AA AA AA " + query), answer);  // the packet begins with the last three
  EXPECT_EQ(say("AA AA AA 03 FF FF " + query), bare(0x03, 14) + " " + answer);
  // An incomplete request is discarded when nothing follows, and hides no complete one behind it.
  EXPECT_EQ(say("AA AA AA 03 10 00 81 " + query), "");
  EXPECT_TRUE(server.hasPartialRequest());
  server.onReceiveTimeout();
  EXPECT_EQ(taken(), answer);
  EXPECT_FALSE(server.hasPartialRequest());
  // The request arrives byte by byte.
  std::string said;
  for (const std::uint8_t byte : octets(query)) said += say(Octets{byte});
  EXPECT_EQ(said, answer);
}

TEST_F(DsaServerTest, SurvivesAMillionRandomBytes) {
  std::mt19937 random(7);
  Octets noise(1000);
  for (int i = 0; i < 1000; ++i) {
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xAA : random());
    server.receive(bytesOf(noise), i);
    server.take();
  }
  server.onReceiveTimeout();
  server.take();
  say(kStop);
  EXPECT_EQ(say(kStop), kAcknowledge);
}

TEST_F(DsaServerTest, BehavesAsOldFirmwareDid) {
  DsaServerOptions options;
  options.firmware = 288;
  DsaServer old(hand, options);
  old.receive(bytesOf(octets("AA AA AA 03 03 00 81 00 00 2F 68")), 0);
  EXPECT_TRUE(old.streaming());  // a request for one frame starts a stream
  options.firmware = 218;
  DsaServer older(hand, options);
  hand.settings()[0].sensitivity = 0.75;
  older.receive(bytesOf(tactilePacket(0x12, {0})), 0);
  older.receive(bytesOf(tactilePacket(0x14, {0})), 0);
  const auto messages = older.take();
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(hexText(octetsOf(messages[0])),
            hexText(tactilePacket(0x12, octets("00 00 02 00 00 00 3F 00 00 00 3F"))));
  EXPECT_EQ(hexText(octetsOf(messages[1])), bare(0x14, 13));
}

TEST_F(DsaServerTest, RefusesRatesOutOfRange) {
  DsaServerOptions options;
  for (const double hz : {0.0, -1.0, 1001.0, std::nan("")}) {
    options.frameHz = hz;
    EXPECT_THROW(DsaServer(hand, options), std::invalid_argument) << hz;
  }
}

}  // namespace
}  // namespace palpate::dsa_server_test
