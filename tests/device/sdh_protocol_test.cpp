#include "palpate/device/sdh_protocol.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "device/scripted_channel.h"

namespace palpate::sdh_protocol_test {
namespace {

using testing::Bytes;
using testing::bytesOf;

// All bytes below are those of the protocol document (section 2.2), recorded on a real line.
TEST(SdhProtocol, GetRequestsAreThePublishedBytes) {
  const std::pair<SdhCommand, const char*> expected[] = {
      {SdhCommand::kVelocityTarget, "80 03 00 3A A1"},
      {SdhCommand::kVelocity, "81 03 00 98 CB"},
      {SdhCommand::kVelocityReference, "82 03 00 7E 74"},
      {SdhCommand::kAngle, "83 03 00 DC 1E"},
      {SdhCommand::kState, "84 03 00 A3 28"},
      {SdhCommand::kAngleTarget, "85 03 00 01 42"},
      {SdhCommand::kAcceleration, "86 03 00 E7 FD"},
      {SdhCommand::kTargetGetAngle, "8B 03 00 FC 1E"},
      {SdhCommand::kTargetGetVelocity, "8C 03 00 83 28"},
      {SdhCommand::kCurrentLimit, "A3 03 00 DC C7"},
      {SdhCommand::kPower, "A4 03 00 A3 F1"}};
  for (const auto& [command, bytes] : expected) {
    EXPECT_EQ(sdhRecordRequest(command, {}, true), bytesOf(bytes)) << sdhName(command);
    EXPECT_TRUE(sdhIsBinary(command));
  }
  EXPECT_EQ(sdhRecordRequest(SdhCommand::kAngle, {}, false), bytesOf("83 01 00"));
}

TEST(SdhProtocol, SetRequestsAreThePublishedBytes) {
  const std::vector<double> targets = {0, -10, -10, 0, 0, 0, 0};
  EXPECT_EQ(
      sdhRecordRequest(SdhCommand::kAngleTarget, targets, true),
      bytesOf("85 1F 07 00000000 000020C1 000020C1 00000000 00000000 00000000 00000000 15 66"));
  const std::string zeros(56, '0');
  EXPECT_EQ(sdhRecordRequest(SdhCommand::kPower, std::vector<double>(7, 0.0), true),
            bytesOf("A4 1F 07" + zeros + "FA 6E"));
  EXPECT_EQ(
      sdhRecordRequest(SdhCommand::kPower, std::vector<double>(7, 1.0), true),
      bytesOf("A4 1F 07 0000803F 0000803F 0000803F 0000803F 0000803F 0000803F 0000803F FB 8F"));
  EXPECT_EQ(sdhRecordRequest(SdhCommand::kPower, std::vector<double>(7, 0.0), false),
            bytesOf("A4 1D 07" + zeros));
  EXPECT_THROW(sdhRecordRequest(SdhCommand::kPower, std::vector<double>(6, 0.0), true),
               std::invalid_argument);
}

TEST(SdhProtocol, DecodesThePublishedReplies) {
  const Bytes angles =
      bytesOf("83 20 07 00 0000B442 000070C1 00009041 0000B4C2 00000000 000070C1 00009041 8C 3E");
  ASSERT_EQ(angles.size(), sdhRecordBytes(true));
  const auto record = decodeSdhRecord(angles, true);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->command, SdhCommand::kAngle);
  EXPECT_EQ(record->status, 0);
  EXPECT_EQ(record->values, (std::vector<double>{90, -15, 18, -90, 0, -15, 18}));

  const auto targets = decodeSdhRecord(
      bytesOf("85 20 07 00 00000000 000020C1 000020C1 00000000 00000000 00000000 00000000 31 CF"),
      true);
  ASSERT_TRUE(targets);
  EXPECT_EQ(targets->values, (std::vector<double>{0, -10, -10, 0, 0, 0, 0}));

  const auto refused =
      decodeSdhRecord(bytesOf("83 20 07 0D" + std::string(56, '0') + "A5 74"), true);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 13);

  const auto states = decodeSdhRecord(
      bytesOf("84 20 07 00 0000803F 0000803F 0000803F 00000000 00000000 00000000 00000000 AB F3"),
      true);
  ASSERT_TRUE(states);
  EXPECT_EQ(states->values, (std::vector<double>{1, 1, 1, 0, 0, 0, 0}));
}

TEST(SdhProtocol, RefusesEveryReplyWithOneWrongByte) {
  const Bytes good =
      bytesOf("83 20 07 00 0000B442 000070C1 00009041 0000B4C2 00000000 000070C1 00009041 8C 3E");
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= std::byte{0x01};
    EXPECT_FALSE(decodeSdhRecord(bad, true)) << "byte " << i;
  }
  EXPECT_FALSE(decodeSdhRecord(std::span<const std::byte>(good).first(33), true));
  EXPECT_FALSE(decodeSdhRecord(good, false));
  Bytes network(good.begin(), good.end() - 2);
  network[1] = std::byte{0x1E};
  EXPECT_TRUE(decodeSdhRecord(network, false));
}

TEST(SdhProtocol, NamesOfAllCommandsAreTheDocuments) {
  EXPECT_EQ(sdhName(SdhCommand::kVelocityTarget), "v");
  EXPECT_EQ(sdhName(SdhCommand::kSavePosition), "pos_save");
  EXPECT_EQ(sdhName(static_cast<SdhCommand>(0x98)), "numaxis");
  EXPECT_EQ(sdhName(SdhCommand::kDuration), "get_duration");
  EXPECT_EQ(sdhName(SdhCommand::kGrip), "grip");
  EXPECT_EQ(sdhName(SdhCommand::kPower), "power");
  EXPECT_EQ(sdhName(static_cast<SdhCommand>(0xAB)), "change_channel");
  EXPECT_EQ(sdhName(static_cast<SdhCommand>(0xAC)), "");
  EXPECT_EQ(sdhName(static_cast<SdhCommand>(0x7F)), "");
  EXPECT_FALSE(sdhIsBinary(SdhCommand::kMove));
}

TEST(SdhProtocol, WritesLinesWithSixDecimals) {
  EXPECT_EQ(sdhLineRequest("pos"), "pos");
  EXPECT_EQ(sdhLineRequest("kv", 2), "kv(2)");
  EXPECT_EQ(sdhLineRequest("kv", 2, std::vector<double>{0.5}), "kv(2)=0.500000");
  EXPECT_EQ(sdhLineRequest("p", std::nullopt, std::vector<double>{0, -10.25, 1.0 / 3}),
            "p=0.000000,-10.250000,0.333333");
}

TEST(SdhProtocol, ReadsLines) {
  SdhLine line = parseSdhLine("VER=0.0.3.3");
  EXPECT_EQ(line.kind, SdhLine::Kind::kValue);
  EXPECT_EQ(line.name, "VER");
  EXPECT_EQ(line.text, "0.0.3.3");
  EXPECT_FALSE(line.axis);
  line = parseSdhLine("PID(6)=1.0, 2, 3");
  EXPECT_EQ(line.name, "PID");
  EXPECT_EQ(line.axis, 6);
  EXPECT_EQ(parseSdhNumbers(line.text), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(parseSdhLine("VER_DATE=a=b").text, "a=b");
  EXPECT_EQ(parseSdhLine("E13").kind, SdhLine::Kind::kError);
  EXPECT_EQ(parseSdhLine("E13").error, 13);
  EXPECT_EQ(parseSdhLine("@ E13").kind, SdhLine::Kind::kDebug);
  for (const char* other : {"STOP",
                            "E",
                            "EX",
                            "E-1",
                            "E123456",
                            "ver=1",
                            "KV(x)=1",
                            "KV(1=1",
                            "KV(-1)=1",
                            "KV(100)=1",
                            "=1",
                            "(1)=1",
                            "A B=1"}) {
    EXPECT_EQ(parseSdhLine(other).kind, SdhLine::Kind::kOther) << other;
    EXPECT_EQ(parseSdhLine(other).text, other);
  }
}

TEST(SdhProtocol, ReadsNumbersOrNothing) {
  EXPECT_EQ(parseSdhNumbers("4.51"), std::vector<double>{4.51});
  EXPECT_EQ(parseSdhNumbers(" 1.5,  -2 ,3e1"), (std::vector<double>{1.5, -2, 30}));
  for (const char* bad : {"", "1,", ",1", "1,,2", "1;2", "nan", "1,inf", "1 2", "0x10", "1e999"})
    EXPECT_FALSE(parseSdhNumbers(bad)) << bad;
}

TEST(SdhProtocol, SaysWhatErrorsMean) {
  EXPECT_EQ(sdhErrorText(0), "ok");
  EXPECT_EQ(sdhErrorText(13), "unknown command");
  EXPECT_EQ(sdhErrorText(24), "range error");
  // the same error has code 24 at the tactile controller
  EXPECT_EQ(sdhErrorText(26), "index out of bounds");
  EXPECT_EQ(sdhErrorText(28), "axis disabled");
  EXPECT_EQ(sdhErrorText(29), "over-temperature");
  EXPECT_EQ(sdhErrorText(33), "checksum error in a binary record");
  EXPECT_EQ(sdhErrorText(36), "unknown error");
  EXPECT_EQ(sdhErrorText(99), "unknown error 99");
  EXPECT_NE(sdhErrorAdvice(29).find("cool"), std::string::npos);
  EXPECT_NE(sdhErrorAdvice(28).find("power on again"), std::string::npos);
  EXPECT_EQ(sdhErrorAdvice(0), "");
}

TEST(SdhProtocol, ComparesReleases) {
  EXPECT_TRUE(SdhFirmware::parse("0.0.3.3").atLeast(0, 0, 2, 15));
  EXPECT_TRUE(SdhFirmware::parse("0.0.2.15").atLeast(0, 0, 2, 15));
  // compared as numbers, not as text
  EXPECT_FALSE(SdhFirmware::parse("0.0.2.9").atLeast(0, 0, 2, 15));
  EXPECT_TRUE(SdhFirmware::parse("0.0.2.15-rc1").atLeast(0, 0, 2, 15));
  EXPECT_TRUE(SdhFirmware::parse("1").atLeast(0, 9, 9, 9));
  EXPECT_FALSE(SdhFirmware::parse("").atLeast(0, 0, 0, 1));
  EXPECT_FALSE(SdhFirmware::parse("unknown").atLeast(0, 0, 0, 1));
}

}  // namespace
}  // namespace palpate::sdh_protocol_test
