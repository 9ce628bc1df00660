#include "palpate/emulator/faults.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "emulator/line_client.h"

namespace palpate::faults_test {
namespace {

std::string refusalOf(const std::string& text) {
  try {
    parseFaults(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Faults, AreReadAsDocumented) {
  EXPECT_EQ(parseFaults(""), Faults{});
  const Faults all = parseFaults(
      "crc=0.01,drop=1e-4,insert=0.5,stall=2@10,unplug=0.5@20,stall=1@30,junk_start=500,boot=8");
  Faults expected;
  expected.crcRate = 0.01;
  expected.dropRate = 1e-4;
  expected.insertRate = 0.5;
  expected.stalls = {{.atS = 10.0, .durationS = 2.0}, {.atS = 30.0, .durationS = 1.0}};
  expected.unplugs = {{.atS = 20.0, .durationS = 0.5}};
  expected.junkStartBytes = 500;
  expected.bootS = 8.0;
  EXPECT_EQ(all, expected);
}

TEST(Faults, RefusalsNameTheWordAndWhatItShouldBe) {
  for (const char* text : {"crc",
                           "crc=",
                           "crc=2",
                           "crc=-1",
                           "drop=x",
                           "insert=nan",
                           "stall=2",
                           "stall=@1",
                           "stall=1@",
                           "unplug=1@-2",
                           "unplug=1@1@1",
                           "junk_start=1.5",
                           "junk_start=-1",
                           "boot=",
                           "boot=1e9",
                           "fire=1",
                           "=1",
                           "crc=0.1,,drop=0",
                           "crc=0.1,"}) {
    const std::string refusal = refusalOf(text);
    EXPECT_EQ(refusal.rfind("fault '", 0), 0u) << text;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << text;
  }
  EXPECT_NE(refusalOf("crc=0.1,fire=1").find("'fire=1'"), std::string::npos);
  EXPECT_NE(refusalOf("fire=1").find("junk_start"), std::string::npos);
  EXPECT_NE(refusalOf("stall=2").find("SECONDS@AT"), std::string::npos);
}

LineMessage tactile(std::size_t payloadBytes) {
  LineMessage message;
  for (const std::uint8_t byte : testing::tactilePacket(0, testing::Octets(payloadBytes, 0x55)))
    message.bytes.push_back(static_cast<std::byte>(byte));
  message.checksummed = true;
  message.frame = 1;
  return message;
}

bool checksumHolds(const LineMessage& message) {
  testing::Octets body;
  for (std::size_t i = 3; i + 2 < message.bytes.size(); ++i)
    body.push_back(std::to_integer<std::uint8_t>(message.bytes[i]));
  const auto low = std::to_integer<unsigned>(message.bytes[message.bytes.size() - 2]);
  const auto high = std::to_integer<unsigned>(message.bytes.back());
  return testing::bitwiseChecksum(body) == (low | high << 8);
}

TEST(Faults, SpoilsTheShareOfChecksumsThatWasAsked) {
  ByteFaults faults(parseFaults("crc=0.1"), 1);
  FaultCounts counts;
  int bad = 0;
  for (int i = 0; i < 20'000; ++i) {
    LineMessage message = tactile(10);
    faults.apply(message, counts);
    EXPECT_EQ(message.bytes.size(), 18u);
    EXPECT_EQ(message.damaged, !checksumHolds(message));
    bad += message.damaged ? 1 : 0;
  }
  EXPECT_EQ(counts.spoiltChecksums, std::uint64_t(bad));
  EXPECT_EQ(counts.damagedFrames, std::uint64_t(bad));
  EXPECT_NEAR(bad, 2000, 4 * 42);  // four standard deviations of the binomial
  // A text line has no checksum to change.
  ByteFaults all(parseFaults("crc=1"), 1);
  LineMessage text{.bytes = std::vector<std::byte>(5)};
  all.apply(text, counts);
  EXPECT_FALSE(text.damaged);
}

TEST(Faults, DropsAndInsertsTheShareOfBytesThatWasAsked) {
  ByteFaults dropping(parseFaults("drop=0.01"), 2);
  ByteFaults inserting(parseFaults("insert=0.01"), 3);
  FaultCounts dropped, inserted;
  std::size_t shorter = 0, longer = 0;
  for (int i = 0; i < 2000; ++i) {
    LineMessage message = tactile(92);
    dropping.apply(message, dropped);
    shorter += 100 - message.bytes.size();
    EXPECT_EQ(message.damaged, message.bytes.size() != 100);
    message = tactile(92);
    inserting.apply(message, inserted);
    longer += message.bytes.size() - 100;
  }
  EXPECT_EQ(dropped.droppedBytes, shorter);
  EXPECT_EQ(inserted.insertedBytes, longer);
  EXPECT_NEAR(double(shorter), 2000.0, 4 * 45.0);
  EXPECT_NEAR(double(longer), 2000.0, 4 * 45.0);
  EXPECT_EQ(dropped.insertedBytes, 0u);
  // A byte inserted behind the last one does not damage the message.
  ByteFaults always(parseFaults("insert=1"), 4);
  LineMessage single{.bytes = std::vector<std::byte>(1)};
  always.apply(single, inserted);
  EXPECT_EQ(single.bytes.size(), 2u);
  EXPECT_FALSE(single.damaged);
}

TEST(Faults, RateOneHitsEverything) {
  ByteFaults faults(parseFaults("drop=1"), 1);
  FaultCounts counts;
  LineMessage message = tactile(10);
  faults.apply(message, counts);
  EXPECT_TRUE(message.bytes.empty());
  EXPECT_EQ(counts.droppedBytes, 18u);
}

TEST(Faults, TheSameSeedMakesTheSameFaults) {
  const Faults spec = parseFaults("crc=0.2,drop=0.02,insert=0.02");
  ByteFaults one(spec, 9), two(spec, 9), other(spec, 10);
  FaultCounts counts;
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    LineMessage a = tactile(40), b = tactile(40), c = tactile(40);
    one.apply(a, counts);
    two.apply(b, counts);
    other.apply(c, counts);
    ASSERT_EQ(a.bytes, b.bytes);
    differs = differs || a.bytes != c.bytes;
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(one.junk(50), two.junk(50));
}

TEST(Faults, RefusesRatesOutOfRange) {
  Faults faults;
  faults.dropRate = 1.5;
  EXPECT_THROW(ByteFaults(faults, 1), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::faults_test
