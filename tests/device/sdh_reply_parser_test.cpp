#include "palpate/device/sdh_reply_parser.h"

#include <random>

#include <gtest/gtest.h>

#include "device/fake_sdh_hand.h"
#include "device/scripted_channel.h"

namespace palpate::sdh_reply_parser_test {
namespace {

using testing::Bytes;
using testing::bytesOf;

Bytes text(const std::string& line) {
  Bytes bytes;
  for (const char c : line) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// The published answer to `pos`: (90 -15 18 -90 0 -15 18).
const Bytes kAngles =
    bytesOf("83 20 07 00 0000B442 000070C1 00009041 0000B4C2 00000000 000070C1 00009041 8C 3E");

// The replies found, as text; bytes are pushed in pieces of `chunk` bytes.
std::vector<std::string> found(SdhReplyParser& parser, const Bytes& bytes, std::size_t chunk) {
  std::vector<std::string> all;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    const std::size_t count = std::min(chunk, bytes.size() - at);
    parser.push(std::span<const std::byte>(bytes).subspan(at, count), [&](SdhReply&& reply) {
      if (const auto* line = std::get_if<SdhLine>(&reply))
        all.push_back(line->name + "|" + line->text);
      else
        all.push_back("#" + std::to_string(static_cast<int>(std::get<SdhRecord>(reply).command)));
    });
  }
  return all;
}

void expectAccounted(const SdhReplyParser& parser, std::size_t pushed) {
  const SdhReplyStats& stats = parser.stats();
  EXPECT_EQ(stats.lineBytes + stats.recordBytes + stats.skippedBytes + parser.pendingBytes(),
            pushed);
}

TEST(SdhReplyParser, FindsLinesAndRecordsInPiecesOfAnySize) {
  const Bytes stream = joined(
      {text("VER=0.0.3.3\r\n"), kAngles, text("M=4.51\r\n"), kAngles, kAngles, text("STOP\r\n")});
  for (std::size_t chunk = 1; chunk <= 64; ++chunk) {
    SdhReplyParser parser(true);
    EXPECT_EQ(found(parser, stream, chunk),
              (std::vector<std::string>{"VER|0.0.3.3", "#131", "M|4.51", "#131", "#131", "|STOP"}))
        << "chunk " << chunk;
    EXPECT_EQ(parser.stats().skippedBytes, 0u);
    EXPECT_EQ(parser.pendingBytes(), 0u);
    expectAccounted(parser, stream.size());
  }
}

TEST(SdhReplyParser, RecordsOfANetworkHaveNoChecksum) {
  Bytes record(kAngles.begin(), kAngles.end() - 2);
  record[1] = std::byte{0x1E};
  SdhReplyParser parser(false);
  EXPECT_EQ(found(parser, joined({record, record, text("M=1\r\n")}), 5),
            (std::vector<std::string>{"#131", "#131", "M|1"}));
}

TEST(SdhReplyParser, FindsWhatFollowsADamagedRecord) {
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    Bytes bad = kAngles;
    bad[i] ^= std::byte{0x5A};
    SdhReplyParser parser(true);
    const Bytes stream = joined({bad, text("\r\n"), kAngles, text("\r\nVER=1\r\n")});
    const auto all = found(parser, stream, 7);
    ASSERT_GE(all.size(), 2u) << "byte " << i;
    EXPECT_EQ(all[all.size() - 2], "#131") << "byte " << i;
    EXPECT_EQ(all.back(), "VER|1") << "byte " << i;
    expectAccounted(parser, stream.size());
  }
}

TEST(SdhReplyParser, CountsWrongChecksums) {
  Bytes bad = kAngles;
  bad.back() ^= std::byte{1};
  SdhReplyParser parser(true);
  found(parser, joined({bad, text("\r\n")}), 99);
  EXPECT_EQ(parser.stats().badChecksums, 1u);
  EXPECT_EQ(parser.stats().records, 0u);
}

TEST(SdhReplyParser, SkipsBlankLinesNoiseAndEndlessText) {
  SdhReplyParser parser(true);
  Bytes stream = joined({text("\r\n  \r\n\n"),
                         bytesOf("00 01 1B"),
                         text("x\r\n"),
                         bytesOf("FF FE AA"),
                         text(std::string(1000, 'a')),
                         text("\r\n"),
                         text("SN=48\r\n")});
  EXPECT_EQ(found(parser, stream, 11), std::vector<std::string>{"SN|48"});
  expectAccounted(parser, stream.size());
}

TEST(SdhReplyParser, ResetGivesUpWhatIsIncomplete) {
  SdhReplyParser parser(true);
  found(parser, Bytes(kAngles.begin(), kAngles.end() - 1), 99);
  EXPECT_EQ(parser.pendingBytes(), 33u);
  parser.reset();
  EXPECT_EQ(parser.pendingBytes(), 0u);
  EXPECT_EQ(found(parser, kAngles, 99), std::vector<std::string>{"#131"});
  EXPECT_EQ(parser.stats().skippedBytes, 33u);
}

TEST(SdhReplyParser, RandomBytesKeepItSmallAndEveryByteIsAccountedFor) {
  std::mt19937 random(1);
  SdhReplyParser parser(true);
  std::size_t pushed = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes(random() % 60);
    for (std::byte& b : bytes) b = static_cast<std::byte>(random());
    if (i % 50 == 0) bytes = kAngles;
    parser.push(bytes, [](SdhReply&&) {});
    pushed += bytes.size();
    ASSERT_LE(parser.pendingBytes(), 254u);
  }
  expectAccounted(parser, pushed);
}

// The fake hand of these tests and the decoder were written independently of each other.
TEST(SdhReplyParser, UnderstandsTheIndependentHand) {
  testing::FakeSdhHand hand;
  SdhReplyParser parser(true);
  EXPECT_EQ(found(parser, hand.receive(bytesOf("83 03 00 DC 1E")), 99),
            std::vector<std::string>{"#131"});
  EXPECT_EQ(hand.log, std::vector<std::string>{"pos?"});
}

}  // namespace
}  // namespace palpate::sdh_reply_parser_test
