#include "palpate/emulator/sdh_server.h"

#include <cstring>
#include <random>
#include <stdexcept>

#include "emulator/line_client.h"
#include "emulator/still_hand.h"
#include "testing/testing.h"

namespace palpate::sdh_server_test {
namespace {

using testing::bitwiseChecksum;
using testing::hexText;
using testing::Octets;
using testing::octets;
using testing::StillHand;

// A binary record with its checksum.
Octets record(std::uint8_t command, const std::vector<float>& values = {}) {
  Octets bytes = {command,
                  static_cast<std::uint8_t>(3 + 4 * values.size()),
                  static_cast<std::uint8_t>(values.size())};
  for (const float value : values) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  const std::uint16_t crc = bitwiseChecksum(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return bytes;
}

class SdhServerTest : public ::testing::Test {
 protected:
  void send(const Octets& bytes) { server.receive(std::as_bytes(std::span(bytes)), nowUs); }
  std::string say(const std::string& text) {
    send(Octets(text.begin(), text.end()));
    return takeText();
  }
  std::string line(const std::string& text) { return say(text + "\r\n"); }
  std::string takeText() {
    std::string text;
    for (const LineMessage& message : server.take())
      for (const std::byte b : message.bytes) text += std::to_integer<char>(b);
    return text;
  }
  Octets takeOctets() {
    const std::string text = takeText();
    return {text.begin(), text.end()};
  }
  std::string sayHex(const std::string& hex) {
    send(octets(hex));
    return hexText(takeOctets());
  }
  // Status of the answer to a record; -1 when it isn't a record of 34 bytes with a correct
  // checksum.
  int status(const Octets& request) {
    send(request);
    const Octets answer = takeOctets();
    if (answer.size() != 34 || answer[0] != request[0] || answer[1] != 0x20 || answer[2] != 7)
      return -1;
    const unsigned crc = answer[32] | unsigned{answer[33]} << 8;
    return bitwiseChecksum(Octets(answer.begin(), answer.end() - 2)) == crc ? answer[3] : -1;
  }
  void pass(double seconds) {
    nowUs += static_cast<std::int64_t>(seconds * 1e6);
    server.advance(nowUs);
  }
  std::string passUntilSaid() {
    std::string all;
    for (int i = 0; i < 3000 && all.empty(); ++i) {
      pass(0.01);
      all = takeText();
    }
    return all;
  }
  static std::string hex(const std::string& text) { return hexText(octets(text)); }

  StillHand hand{{90, -15, 18, -90, 0, -15, 18}};
  SdhServer server{hand};
  std::int64_t nowUs = 0;
};

// Literal bytes of the protocol document, section 2.2.
TEST_F(SdhServerTest, AnswersBinaryRecordsByteForByte) {
  EXPECT_EQ(
      sayHex("83 03 00 DC 1E"),
      hex("83 20 07 00 | 0000B442 000070C1 00009041 0000B4C2 00000000 000070C1 00009041 | 8C 3E"));
  EXPECT_EQ(
      sayHex("85 1F 07 | 00000000 000020C1 000020C1 00000000 00000000 00000000 00000000 | 15 66"),
      hex("85 20 07 00 | 00000000 000020C1 000020C1 00000000 00000000 00000000 00000000 | 31 CF"));
  EXPECT_EQ(hand.joints().targets(), (std::vector<double>{0, -10, -10, 0, 0, 0, 0}));
  EXPECT_EQ(sayHex("A4 1F 07 | 0000803Fx7 | FB 8F").substr(0, 12), "A4 20 07 00 ");
  EXPECT_EQ(hand.joints().power(), std::vector<bool>(7, true));
  EXPECT_EQ(sayHex("A4 1F 07 | 00x28 | FA 6E").substr(0, 12), "A4 20 07 00 ");
  EXPECT_EQ(hand.joints().power(), std::vector<bool>(7, false));
  // All read requests, with computed checksums.
  const std::string requests =
      "80 03 00 3A A1 81 03 00 98 CB 82 03 00 7E 74 84 03 00 A3 28 85 03 00 01 42 86 03 00 E7 FD "
      "8B 03 00 FC 1E 8C 03 00 83 28 A3 03 00 DC C7 A4 03 00 A3 F1 ";
  for (std::size_t at = 0; at < requests.size(); at += 15)
    EXPECT_EQ(status(octets(requests.substr(at, 15))), 0) << requests.substr(at, 15);
}

TEST_F(SdhServerTest, ErrorsOfRecordsHaveTheirFullLength) {
  EXPECT_EQ(status(record(0x87)), 13);  // m: unknown as a record
  EXPECT_EQ(status(record(0xFE)), 13);
  Octets spoilt = record(0x83);
  spoilt.back() ^= 1;
  EXPECT_EQ(status(spoilt), 33);
  EXPECT_EQ(status(record(0x83, std::vector<float>(7, 0.0F))), 12);   // pos can't be set
  EXPECT_EQ(status(record(0x85, std::vector<float>(7, 91.0F))), 24);  // range
  EXPECT_EQ(status(record(0x85, std::vector<float>(7, std::nanf("")))), 23);
  EXPECT_EQ(status(record(0x80, std::vector<float>(7, 84.0F))), 24);  // axis 0 goes to 83 deg/s
  EXPECT_EQ(status(record(0x80, std::vector<float>(7, -1.0F))), 24);  // pose: not backwards
  EXPECT_EQ(status(record(0xA4, std::vector<float>(7, 2.0F))), 24);
  EXPECT_EQ(status(record(0xA3, std::vector<float>(7, 1.5F))), 24);
  EXPECT_EQ(hand.joints().targets(), (std::vector<double>{90, -15, 18, -90, 0, -15, 18}));
  // A record of another form is answered once; the following bytes are skipped up to a line end.
  send(octets("83 05 02 83 03 00 DC 1E"));
  EXPECT_EQ(hexText(takeOctets()).substr(0, 12), "83 20 07 0E ");
  EXPECT_EQ(say("abc"), "");
  EXPECT_EQ(say("\r\nver\r\n"), "VER=0.0.3.3\r\n");
}

TEST_F(SdhServerTest, RecordsOverTcpHaveNoChecksum) {
  SdhServerOptions options;
  options.checksum = false;
  SdhServer network(hand, options);
  const auto ask = [&](const std::string& request) {
    const Octets bytes = octets(request);
    network.receive(std::as_bytes(std::span(bytes)), 0);
    Octets all;
    for (const LineMessage& message : network.take()) {
      EXPECT_FALSE(message.checksummed);
      for (const std::byte b : message.bytes) all.push_back(std::to_integer<std::uint8_t>(b));
    }
    return hexText(all);
  };
  EXPECT_EQ(ask("83 01 00"),
            hex("83 1E 07 00 | 0000B442 000070C1 00009041 0000B4C2 00000000 000070C1 00009041"));
  EXPECT_EQ(ask("87 01 00"), hex("87 1E 07 0D | 00x28"));
  EXPECT_EQ(ask("A4 1D 07 | 0000803Fx7"), hex("A4 1E 07 00 | 0000803Fx7"));
}

TEST_F(SdhServerTest, VectorCommandsHaveFourForms) {
  EXPECT_EQ(line("pos"), "POS=90.0000,-15.0000,18.0000,-90.0000,0.0000,-15.0000,18.0000\r\n");
  EXPECT_EQ(line("pos(3)"), "POS(3)=-90.0000\r\n");
  // In the formats of the vendor's library: %f and %12.3f.
  EXPECT_EQ(line("p=10.000000,20.000000,30.000000,-40.000000,50.000000,60.000000,-70.000000"),
            "P=10.0000,20.0000,30.0000,-40.0000,50.0000,60.0000,-70.0000\r\n");
  EXPECT_EQ(line("p(2)=      12.500"), "P(2)=12.5000\r\n");
  EXPECT_EQ(hand.joints().targets(), (std::vector<double>{10, 20, 12.5, -40, 50, 60, -70}));
  EXPECT_EQ(line("igrip(2)=       0.500"), "IGRIP(2)=0.5000\r\n");
  EXPECT_EQ(line("ihold"), "IHOLD=0.1000,0.2000,0.2000,0.2000,0.2000,0.2000,0.2000\r\n");
  EXPECT_EQ(line("igrip"), "IGRIP=1.0000,0.5000,0.5000,0.5000,0.5000,0.5000,0.5000\r\n");
  EXPECT_EQ(line("v = 1, 2, 3, 4, 5, 6, 7"),
            "V=1.0000,2.0000,3.0000,4.0000,5.0000,6.0000,7.0000\r\n");
  EXPECT_EQ(line("power=1,0,1,0,1,0,1"), "POWER=1,0,1,0,1,0,1\r\n");
  EXPECT_EQ(line("power(1)=1"), "POWER(1)=1\r\n");
  EXPECT_EQ(hand.joints().power(), (std::vector<bool>{true, true, true, false, true, false, true}));
  EXPECT_EQ(line("state").substr(0, 6), "STATE=");
  // One round trip that sets the target and returns the actual angle.
  EXPECT_EQ(line("tpap(0)=45"), "TPAP(0)=90.0000\r\n");
  EXPECT_DOUBLE_EQ(hand.joints().targets()[0], 45.0);
  EXPECT_DOUBLE_EQ(hand.joints().targets()[6], -70.0);
  EXPECT_EQ(line("kv(1)=2.5"), "KV(1)=2.5000\r\n");
  EXPECT_EQ(line("pid(6)=1,2,3"), "PID(6)=1.0000,2.0000,3.0000\r\n");
  EXPECT_EQ(line("pid(6)"), "PID(6)=1.0000,2.0000,3.0000\r\n");
}

TEST_F(SdhServerTest, AnswersAboutItself) {
  EXPECT_EQ(line("ver"), "VER=0.0.3.3\r\n");
  EXPECT_EQ(line("ver_date"), "VER_DATE=2013-09-19\r\n");
  EXPECT_EQ(line("numaxis"), "NUMAXIS=7\r\n");
  for (const char* name : {"soc", "soc_date", "id"})
    EXPECT_GT(line(name).size(), std::string(name).size() + 3) << name;
  EXPECT_EQ(line("con"), "CON=0\r\n");
  EXPECT_EQ(line("con=2"), "CON=2\r\n");
  EXPECT_EQ(line("vp=1"), "VP=1\r\n");
  EXPECT_EQ(line("vp"), "VP=1\r\n");
  EXPECT_EQ(line("demo=1"), "DEMO=1\r\n");
  // 45.7, 37.1 and 48.6 (FPGA) in steps of 0.25 and 0.125.
  EXPECT_EQ(line("temp"), "TEMP=40.50,45.75,37.00,41.75,34.00,44.00,36.75,48.625,48.25\r\n");
}

TEST_F(SdhServerTest, ReadsLinesHoweverTheyCome) {
  EXPECT_EQ(say(" \r\n"), "");
  EXPECT_EQ(say("\r\n\n\r"), "");
  EXPECT_EQ(say(" "), "");
  EXPECT_EQ(say("ver\r\n"), "VER=0.0.3.3\r\n");  // the hand sees " ver"
  EXPECT_EQ(say("ver"), "");
  EXPECT_EQ(say("\r\n"), "VER=0.0.3.3\r\n");
  EXPECT_EQ(say("VER\n"), "VER=0.0.3.3\r\n");
  EXPECT_EQ(say("ver\rsn\r"), "VER=0.0.3.3\r\nSN=48\r\n");
  // Records between lines, and a line whose end was lost.
  send(octets("76 65 72 0D 0A 84 03 00 A3 28 73 6E 0D 0A"));
  const std::string mixed = takeText();
  EXPECT_EQ(mixed.substr(0, 13), "VER=0.0.3.3\r\n");
  EXPECT_EQ(mixed.substr(13 + 34), "SN=48\r\n");
  send(octets("76 65 72 84 03 00 A3 28"));
  EXPECT_EQ(takeOctets().size(), 34u);
}

TEST_F(SdhServerTest, RefusesWithTheDocumentsErrorNumbers) {
  EXPECT_EQ(line("hello"), "E13\r\n");
  EXPECT_EQ(line("hello(1)=x,y"), "E13\r\n");
  EXPECT_EQ(line("=5"), "E13\r\n");
  EXPECT_EQ(line("p=1,2,3"), "E11\r\n");
  EXPECT_EQ(line("p=1,2,3,4,5,6,7,8"), "E14\r\n");
  EXPECT_EQ(line("p=1,2,x,4,5,6,7"), "E14\r\n");
  EXPECT_EQ(line("p(2=1"), "E14\r\n");
  EXPECT_EQ(line("p="), "E14\r\n");
  EXPECT_EQ(line("p(7)=1"), "E26\r\n");
  EXPECT_EQ(line("p(-1)"), "E26\r\n");
  EXPECT_EQ(line("p(0)=91"), "E24\r\n");
  EXPECT_EQ(line("p(0)=-1"), "E24\r\n");
  EXPECT_EQ(line("pos=1,2,3,4,5,6,7"), "E12\r\n");
  EXPECT_EQ(line("vlim(0)=1"), "E12\r\n");
  EXPECT_EQ(line("ver=1"), "E12\r\n");
  EXPECT_EQ(line("con=3"), "E24\r\n");
  EXPECT_EQ(line("vp=0.5"), "E23\r\n");
  EXPECT_EQ(line("kv"), "E11\r\n");
  EXPECT_EQ(line("terminal=1"), "E4\r\n");
  EXPECT_EQ(line("grip=0.5"), "E11\r\n");
  EXPECT_EQ(line("grip=1.5,40"), "E24\r\n");
  EXPECT_EQ(line("grip=0.5,101"), "E24\r\n");
  EXPECT_EQ(line("selgrip=4"), "E24\r\n");
  EXPECT_EQ(line(std::string(255, 'p')), "E32\r\n");
  EXPECT_EQ(line(std::string(10'000, 'p')), "E32\r\n");
  // A soft limit that excludes the present angle.
  EXPECT_EQ(line("p_max(0)=80"), "E24\r\n");
  EXPECT_EQ(line("p_min(0)=30"), "P_MIN(0)=30.0000\r\n");
  EXPECT_EQ(line("p(0)=20"), "E24\r\n");
}

TEST_F(SdhServerTest, MotionsAnswerAtOnceAndRun) {
  line("p=45,0,0,0,0,0,0");
  line("v=40,40,40,40,40,40,40");
  const std::string duration = line("get_duration");
  EXPECT_EQ(duration.substr(0, 13), "GET_DURATION=");
  EXPECT_EQ(line("state"), "STATE=6,6,6,6,6,6,6\r\n");  // no power yet
  const std::string answer = line("m");
  EXPECT_EQ(answer.substr(0, 2), "M=");
  EXPECT_EQ(answer.substr(2), duration.substr(13));
  pass(0.1);
  EXPECT_EQ(line("state").find("STATE=1"), 0u);
  pass(std::stod(answer.substr(2)) + 0.5);
  EXPECT_EQ(line("state"), "STATE=0,0,0,0,0,0,0\r\n");
  EXPECT_EQ(line("pos(0)"), "POS(0)=45.0000\r\n");
}

TEST_F(SdhServerTest, StopEndsAMotionAndLeavesThePowerOn) {
  line("p=0,0,0,0,0,0,0");
  line("m");
  pass(0.5);
  EXPECT_EQ(line("stop"), "STOP\r\n");
  const std::vector<double> at = hand.joints().angles();
  pass(2.0);
  EXPECT_EQ(hand.joints().power(), std::vector<bool>(7, true));
  EXPECT_NEAR(hand.joints().angles()[0], at[0], 5.0);
  EXPECT_GT(hand.joints().angles()[0], 10.0);
}

TEST_F(SdhServerTest, GripBlocksAndIsDeafToStop) {
  EXPECT_EQ(line("grip=1.0,40"), "");
  pass(0.3);
  EXPECT_EQ(line("stop\r\npower=0,0,0,0,0,0,0"), "");
  EXPECT_TRUE(hand.joints().moving());
  const std::string all = passUntilSaid();
  // Its answer (duration, ratio), then those to the commands that waited.
  EXPECT_EQ(all.substr(0, 5), "GRIP=");
  EXPECT_NE(all.find(",1\r\nSTOP\r\nPOWER=0,0,0,0,0,0,0\r\n"), std::string::npos) << all;
  // The parallel preshape, closed: 7 and -7 deg.
  EXPECT_NEAR(hand.joints().angles()[1], 7.0, 1e-6);
  EXPECT_NEAR(hand.joints().angles()[2], -7.0, 1e-6);
}

TEST_F(SdhServerTest, PreshapesBlockToo) {
  EXPECT_EQ(line("selgrip=3"), "");
  const std::string all = passUntilSaid();
  EXPECT_EQ(all.substr(0, 8), "SELGRIP=");
  EXPECT_EQ(all.substr(all.size() - 4), ",3\r\n");
  EXPECT_NEAR(hand.joints().angles()[0], 60.0, 1e-6);  // spherical
}

TEST_F(SdhServerTest, VelocityControllersNeedPowerAndMoveAtOnce) {
  line("con=1");
  EXPECT_EQ(line("v(1)=20"), "E28\r\n");
  line("power=1,1,1,1,1,1,1");
  EXPECT_EQ(line("v(1)=20"), "V(1)=20.0000\r\n");
  EXPECT_EQ(line("m"), "E5\r\n");
  pass(1.0);
  EXPECT_EQ(line("state(1)"), "STATE(1)=2\r\n");
  EXPECT_NEAR(hand.joints().angles()[1], 5.0, 1.0);
  EXPECT_EQ(line("v(1)=-20"), "V(1)=-20.0000\r\n");
}

TEST_F(SdhServerTest, ThinksForAWhilePerCommand) {
  SdhServerOptions options;
  options.minResponseDelayUs = 2000.0;
  options.maxResponseDelayUs = 3000.0;
  options.requestByteUs = 100.0;
  SdhServer slow(hand, options);
  const std::string twice = "ver\r\nver\r\n";
  slow.receive(std::as_bytes(std::span(twice)), 0);
  const auto first = slow.nextUs();
  ASSERT_TRUE(first && *first >= 2500 && *first <= 3500);
  slow.advance(*first - 1);
  EXPECT_TRUE(slow.take().empty());
  slow.advance(*first);
  EXPECT_EQ(slow.take().size(), 1u);
  EXPECT_GE(*slow.nextUs(), *first + 2500);
  slow.advance(*slow.nextUs());
  EXPECT_EQ(slow.take().size(), 1u);
  EXPECT_FALSE(slow.nextUs());
}

TEST_F(SdhServerTest, LosesWhatItCantHold) {
  say("grip=1.0,0.5\r");  // ignores input for minutes
  EXPECT_EQ(server.lostBytes(), 0u);
  say(std::string(5000, ' '));
  EXPECT_EQ(server.lostBytes(), 904u);
}

TEST_F(SdhServerTest, SurvivesAMillionRandomBytes) {
  std::mt19937 random(11);
  Octets noise(1000);
  std::size_t said = 0;
  for (int i = 0; i < 1000; ++i) {
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    send(noise);
    said += takeText().size();
  }
  EXPECT_GT(said, 0u);
  server.onReceiveTimeout();
  say(" \r\n");
  EXPECT_EQ(line("ver"), "VER=0.0.3.3\r\n");
  EXPECT_EQ(status(octets("84 03 00 A3 28")), 0);
}

TEST_F(SdhServerTest, GivesUpHalfARecordWhenItIsQuietButNotHalfALine) {
  send(octets("83 03 00"));
  EXPECT_TRUE(server.hasPartialRequest());
  server.onReceiveTimeout();
  EXPECT_FALSE(server.hasPartialRequest());
  EXPECT_EQ(line("ver"), "VER=0.0.3.3\r\n");
  say("ve");
  server.onReceiveTimeout();
  EXPECT_EQ(line("r"), "VER=0.0.3.3\r\n");
}

TEST_F(SdhServerTest, PowerCycleLeavesAxesWithoutPowerAndIsDeafForAWhile) {
  line("con=1");
  line("power=1,1,1,1,1,1,1");
  line("v(1)=20");
  server.powerCycle(nowUs, 2.0);
  EXPECT_EQ(line("ver"), "");
  pass(2.1);
  EXPECT_EQ(line("power"), "POWER=0,0,0,0,0,0,0\r\n");
  EXPECT_EQ(line("con"), "CON=0\r\n");
  EXPECT_EQ(line("vel(1)"), "VEL(1)=0.0000\r\n");
}

TEST_F(SdhServerTest, BehavesAsOldFirmwareDid) {
  SdhServerOptions options;
  options.firmware = "0.0.2.4";
  SdhServer old(hand, options);
  const auto ask = [&](const std::string& text) {
    old.receive(std::as_bytes(std::span(text)), 0);
    std::string all;
    for (const LineMessage& message : old.take())
      for (const std::byte b : message.bytes) all += std::to_integer<char>(b);
    return all;
  };
  EXPECT_EQ(ask("ver\r\n"), "VER=0.0.2.4\r\n");
  EXPECT_EQ(ask("vlim(0)\r\n"), "VLIM(0)=83.0000\r\n");
  EXPECT_EQ(ask("alim\r\n"), "E13\r\n");
  EXPECT_EQ(ask("con\r\n"), "E13\r\n");
  const std::string moved = ask("m\r\n");
  EXPECT_EQ(moved[0], '@');
  EXPECT_NE(moved.find("\r\nM=0.00\r\n"), std::string::npos);
}

TEST_F(SdhServerTest, RefusesOptionsThatNoControllerHas) {
  SdhServerOptions options;
  for (const char* firmware : {"0.0.3 3", "three", "0.0.3"}) {
    options.firmware = firmware;
    EXPECT_THROW(SdhServer(hand, options), std::invalid_argument);
  }
  options = {};
  options.minResponseDelayUs = 10.0;
  EXPECT_THROW(SdhServer(hand, options), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sdh_server_test
