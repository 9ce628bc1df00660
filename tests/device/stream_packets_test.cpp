// Packets of a binary stream as docs/manual/stream_protocol.md specifies them. The expected bytes
// were made with Python's struct and zlib.
#include "palpate/device/stream_packets.h"

#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "device/scripted_channel.h"
#include "device/stream_hands.h"

namespace palpate::testing::stream_packets_test {
namespace {

struct Received {
  StreamItemKind kind;
  std::vector<double> numbers;
  std::int64_t deviceUs;
  std::uint32_t sequence;
  std::string text;
  bool operator==(const Received&) const = default;
};

struct Reading {
  std::vector<Received> items;
  StreamPacketStats stats;
  std::string fault, outOfRange;
};

Reading readBytes(const Bytes& bytes,
                  const HandDescription& hand,
                  std::size_t chunk = SIZE_MAX,
                  bool flush = true) {
  StreamPacketParser parser{StreamShape(hand)};
  Reading reading;
  const auto sink = [&](const StreamItem& item) {
    Received received{
        item.kind, {}, item.deviceUs.value(), item.sequence.value(), std::string(item.text)};
    if (item.kind == StreamItemKind::kFrame)
      received.numbers.assign(item.values.begin(), item.values.end());
    else
      received.numbers.assign(item.numbers.begin(), item.numbers.end());
    reading.items.push_back(std::move(received));
  };
  for (std::size_t at = 0; at < bytes.size(); at += std::min(chunk, bytes.size() - at)) {
    parser.push(std::span(bytes).subspan(at, std::min(chunk, bytes.size() - at)), sink);
    const std::size_t pushed = at + std::min(chunk, bytes.size() - at);
    EXPECT_EQ(parser.stats().packetBytes + parser.stats().skippedBytes + parser.pendingBytes(),
              pushed);
  }
  if (flush) parser.flush(sink);
  reading.stats = parser.stats();
  reading.fault = parser.lastFault();
  reading.outOfRange = parser.lastOutOfRange();
  return reading;
}

Bytes frameBytes(std::uint32_t sequence, const std::vector<float>& values) {
  Bytes bytes;
  appendStreamFrame(bytes, sequence, 1000 * std::uint64_t{sequence}, values);
  return bytes;
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// body = struct.pack("<BBIIQ", 1, 1, 6, 7, 123456) + struct.pack("<3H", 1, 513, 4095)
// b"\xa5\x5a" + body + struct.pack("<I", zlib.crc32(body))
const char* const kFrameU16Hex =
    "a55a 01 01 06000000 07000000 40e2010000000000 0100 0102 ff0f e6646e4d";
// struct.pack("<BBIIQ", 1, 2, 12, 8, 2**40) + struct.pack("<3f", 0.5, 1.25, 4095)
const char* const kFrameF32Hex =
    "a55a 01 02 0c000000 08000000 0000000000010000 0000003f 0000a03f 00f07f45 7306d54a";

TEST(StreamPackets, ReadsWhatPythonMade) {
  const Reading u16 = readBytes(bytesOf(kFrameU16Hex), padHand({{1, 3}}));
  ASSERT_EQ(u16.items.size(), 1u) << u16.fault;
  EXPECT_EQ(u16.items[0], (Received{StreamItemKind::kFrame, {1, 513, 4095}, 123'456, 7, ""}));
  const Reading f32 = readBytes(bytesOf(kFrameF32Hex), padHand({{1, 3}}));
  ASSERT_EQ(f32.items.size(), 1u) << f32.fault;
  EXPECT_EQ(f32.items[0],
            (Received{StreamItemKind::kFrame, {0.5, 1.25, 4095}, std::int64_t{1} << 40, 8, ""}));
}

TEST(StreamPackets, WritesWhatPythonMakes) {
  Bytes bytes;
  appendStreamFrame(bytes, 7, 123'456, std::vector<float>{1, 513, 4095});
  EXPECT_EQ(bytes, bytesOf(kFrameU16Hex));
  bytes.clear();
  appendStreamFrame(bytes, 8, std::uint64_t{1} << 40, std::vector<float>{0.5F, 1.25F, 4095});
  EXPECT_EQ(bytes, bytesOf(kFrameF32Hex));
}

TEST(StreamPackets, ReadsAnglesTemperaturesAndADescription) {
  const auto packet = [](StreamPacketType type, const std::vector<float>& values) {
    Bytes payload(4 * values.size());
    std::memcpy(payload.data(), values.data(), payload.size());
    Bytes bytes;
    appendStreamPacket(bytes, type, 3, 5, payload);
    return bytes;
  };
  const std::string text = "{\"serial\":\"P7\"}";
  Bytes description;
  appendStreamPacket(description,
                     StreamPacketType::kDescription,
                     0,
                     0,
                     std::as_bytes(std::span(text.data(), text.size())));
  const Reading reading = readBytes(joined({packet(StreamPacketType::kAngles, {-1.5F, 90.0F}),
                                            packet(StreamPacketType::kTemperatures, {36.5F}),
                                            description}),
                                    smallHand());
  ASSERT_EQ(reading.items.size(), 3u) << reading.fault;
  EXPECT_EQ(reading.items[0], (Received{StreamItemKind::kAngles, {-1.5, 90}, 5, 3, ""}));
  EXPECT_EQ(reading.items[1], (Received{StreamItemKind::kTemperatures, {36.5}, 5, 3, ""}));
  EXPECT_EQ(reading.items[2].text, text);
}

TEST(StreamPackets, FindsTheNextPacketAfterAnySingleCorruptByte) {
  // The sync bytes also stand in the payload: 0x5AA5 is sent A5 5A.
  HandDescription hand = padHand({{1, 4}});
  hand.maximumCounts = 65'535.0F;
  const Bytes good = frameBytes(9, {0x5AA5, 0x5AA5, 0x0101, 3});
  const Received expected = readBytes(good, hand).items.at(0);
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= std::byte{0x5A};
    const Reading reading = readBytes(joined({bad, good}), hand, 3);
    ASSERT_EQ(reading.items.size(), 1u) << "byte " << i;
    EXPECT_EQ(reading.items[0], expected) << "byte " << i;
    EXPECT_EQ(reading.stats.skippedBytes, bad.size()) << "byte " << i;
  }
}

TEST(StreamPackets, NoiseBetweenPacketsHidesNone) {
  std::mt19937 random(11);
  const HandDescription hand = padHand({{4, 4}});
  Bytes stream;
  std::size_t noise = 0;
  for (std::uint32_t n = 0; n < 300; ++n) {
    for (std::size_t k = random() % 40; k > 0; --k, ++noise)
      stream.push_back(static_cast<std::byte>(random() % 3 == 0 ? 0xA5 : random()));
    const Bytes packet = frameBytes(n, std::vector<float>(16, static_cast<float>(n)));
    stream.insert(stream.end(), packet.begin(), packet.end());
  }
  const Reading whole = readBytes(stream, hand);
  ASSERT_EQ(whole.items.size(), 300u);
  for (std::uint32_t n = 0; n < 300; ++n) {
    EXPECT_EQ(whole.items[n].sequence, n);
    EXPECT_EQ(whole.items[n].numbers, std::vector<double>(16, n));
  }
  EXPECT_EQ(whole.stats.skippedBytes, noise);
  for (const std::size_t chunk : {1, 5, 64})
    EXPECT_EQ(readBytes(stream, hand, chunk).items, whole.items);
}

TEST(StreamPackets, AHalfPacketIsGivenUpAtTheEndOfItsDatagram) {
  const HandDescription hand = padHand({{1, 3}});
  const Bytes packet = frameBytes(1, {1, 2, 3});
  const Bytes half(packet.begin(), packet.begin() + 22);
  EXPECT_EQ(readBytes(half, hand, SIZE_MAX, false).stats.skippedBytes, 0u);
  const Reading reading = readBytes(joined({half, packet}), hand);
  EXPECT_EQ(reading.items.size(), 1u);
  EXPECT_EQ(reading.stats.skippedBytes, half.size());
}

// stranger S9: the last packet of an input went without a word.
TEST(StreamPackets, APacketThatIsCutOffIsCounted) {
  const Bytes packet = frameBytes(1, {1, 2, 3});
  for (const std::size_t size : {std::size_t{2}, std::size_t{12}, packet.size() - 1}) {
    const Bytes part(packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(size));
    const Reading reading = readBytes(joined({packet, part}), padHand({{1, 3}}));
    EXPECT_EQ(reading.items.size(), 1u);
    EXPECT_EQ(reading.stats.badLengths, 1u) << size;
    EXPECT_EQ(reading.fault, "packet 2: cut off: " + std::to_string(size) + " bytes of it came");
  }
  EXPECT_EQ(readBytes(joined({packet, packet}), padHand({{1, 3}})).stats.badLengths, 0u);
}

TEST(StreamPackets, NamesAWrongLength) {
  const Reading reading = readBytes(frameBytes(1, {1, 2, 3, 4}), padHand({{1, 3}}));
  EXPECT_EQ(reading.items.size(), 0u);
  EXPECT_EQ(reading.stats.badLengths, 1u);
  EXPECT_EQ(reading.fault, "packet 1: 8 bytes of u16 values (4) instead of 3");
}

TEST(StreamPackets, KeepsAValueOutOfRangeAndNamesIt) {
  const Reading reading = readBytes(
      joined(
          {frameBytes(1, {1, 2, 3}), frameBytes(2, {1, 5000, 3}), frameBytes(3, {1.5F, NAN, 3})}),
      padHand({{1, 3}}));
  ASSERT_EQ(reading.items.size(), 3u);
  EXPECT_EQ(reading.items[1].numbers, (std::vector<double>{1, 5000, 3}));
  EXPECT_EQ(reading.items[2].numbers, (std::vector<double>{1.5, 0, 3}));
  EXPECT_EQ(reading.stats.outOfRange, 2u);
  EXPECT_EQ(reading.stats.refused, 0u);
  EXPECT_EQ(reading.outOfRange, "packet 3: value 2 is nan: 0 is kept");
}

TEST(StreamPackets, CountsAWrongChecksum) {
  Bytes bytes = frameBytes(1, {1, 2, 3});
  bytes[21] ^= std::byte{1};
  const Reading reading = readBytes(bytes, padHand({{1, 3}}));
  EXPECT_EQ(reading.items.size(), 0u);
  EXPECT_EQ(reading.stats.badChecksums, 1u);
  EXPECT_EQ(reading.fault, "packet 1: wrong checksum");
}

TEST(StreamPackets, AHugeLengthIsNotAwaited) {
  // A length of 4 GB, then a good packet.
  Bytes bytes = bytesOf("a55a 01 01 ffffffff 00000000 0000000000000000");
  const Bytes good = frameBytes(1, {1, 2, 3});
  bytes.insert(bytes.end(), good.begin(), good.end());
  EXPECT_EQ(readBytes(bytes, padHand({{1, 3}}), SIZE_MAX, false).items.size(), 1u);
}

TEST(StreamPackets, AnAbsurdTimeIsRefused) {
  Bytes bytes;
  appendStreamPacket(bytes, StreamPacketType::kFrameU16, 0, UINT64_MAX, Bytes(6));
  EXPECT_EQ(readBytes(bytes, padHand({{1, 3}})).fault,
            "packet 1: the device time 18446744073709551615 us is out of range");
}

}  // namespace
}  // namespace palpate::testing::stream_packets_test
