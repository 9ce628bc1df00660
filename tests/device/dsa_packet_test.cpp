#include "palpate/device/dsa_packet.h"

#include <gtest/gtest.h>

#include "device/dsa_wire.h"

namespace palpate::testing::dsa_packet_test {
namespace {

struct Found {
  std::vector<Bytes> payloads;
  std::vector<unsigned> ids;
  DsaPacketStats stats;
  std::size_t pending = 0;
};

Found parse(const Bytes& bytes, std::size_t chunk, bool flush = false) {
  DsaPacketParser parser;
  Found found;
  const auto sink = [&](const DsaPacket& packet) {
    found.payloads.emplace_back(packet.payload.begin(), packet.payload.end());
    found.ids.push_back(static_cast<unsigned>(packet.id));
  };
  for (std::size_t at = 0; at < bytes.size(); at += chunk)
    parser.push(std::span(bytes).subspan(at, std::min(chunk, bytes.size() - at)), sink);
  if (flush) parser.flush(sink);
  found.stats = parser.stats();
  found.pending = parser.pendingBytes();
  EXPECT_EQ(found.stats.packetBytes + found.stats.skippedBytes + found.pending, bytes.size())
      << "every byte is accounted for";
  EXPECT_EQ(found.stats.packets, found.payloads.size());
  return found;
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Requests whose bytes are printed in the protocol document.
TEST(DsaPacket, MakesTheRequestsOfTheDocument) {
  EXPECT_EQ(dsaRequest(DsaId::kAcquisition, bytesOf("01 00 00")),
            bytesOf("AA AA AA 03 03 00 01 00 00 2F 6A"));
  EXPECT_EQ(dsaRequest(DsaId::kAcquisition, bytesOf("81 01 00")),
            bytesOf("AA AA AA 03 03 00 81 01 00 7C 5C"));
  EXPECT_EQ(dsaRequest(DsaId::kAcquisition, bytesOf("80 01 00")),
            bytesOf("AA AA AA 03 03 00 80 01 00 DE 36"));
  EXPECT_EQ(dsaRequest(DsaId::kControllerConfiguration), bytesOf("AA AA AA 01 00 00"));
  EXPECT_EQ(dsaRequest(DsaId::kMatrixConfiguration, bytesOf("05")),
            bytesOf("AA AA AA 0B 01 00 05 6E AB"));
  EXPECT_EQ(dsaRequest(DsaId::kReadMask, bytesOf("00 01")),
            bytesOf("AA AA AA 04 02 00 00 01 EF 00"));
  EXPECT_EQ(dsaRequest(DsaId::kSetDynamicMask, bytesOf("01 00 6A A5 56 6A A5 56 6A A5 56 6A 05")),
            bytesOf("AA AA AA AB 0D 00 01 00 6A A5 56 6A A5 56 6A A5 56 6A 05 F5 26"));
}

TEST(DsaPacket, ReadsTheAnswersOfTheDocument) {
  const Found found =
      parse(joined({bytesOf("AA AA AA 03 02 00 00 00 4B B9"),
                    bytesOf("AA AA AA 0B 02 00 18 00 62 52"),
                    bytesOf("AA AA AA 12 0B 00 00 00 02 00 00 40 3F 00 00 00 3F 61 ED"),
                    bytesOf("AA AA AA 14 04 00 00 00 21 00 55 E9")}),
            7);
  EXPECT_EQ(found.ids, (std::vector<unsigned>{0x03, 0x0B, 0x12, 0x14}));
  EXPECT_EQ(found.payloads[1], bytesOf("18 00"));
  EXPECT_EQ(found.stats.skippedBytes, 0u);
}

TEST(DsaPacket, FindsTheNextPacketAfterAnySingleCorruptByte) {
  // The payload contains a preamble on purpose.
  const Bytes first = wirePacket(0x00, bytesOf("01 00 00 00 01 AA AA AA 03 02 00 00 F0"));
  const Bytes second = wirePacket(0x03, bytesOf("00 00"));
  const Bytes silence(1200, std::byte{0});
  for (std::size_t i = 0; i < first.size(); ++i) {
    Bytes bad = first;
    bad[i] ^= std::byte{0x5A};
    const Found found = parse(joined({bad, second, silence}), 3);
    EXPECT_EQ(found.payloads, std::vector<Bytes>{bytesOf("00 00")}) << "byte " << i;
  }
}

TEST(DsaPacket, StrayPreambleBytesCostNothing) {
  const Bytes good = wirePacket(0x03, bytesOf("00 00"));
  for (std::size_t stray = 1; stray < 10; ++stray) {
    const Found found = parse(joined({Bytes(stray, std::byte{0xAA}), good}), 1);
    EXPECT_EQ(found.payloads.size(), 1u) << stray;
    EXPECT_EQ(found.stats.skippedBytes, stray);
  }
}

TEST(DsaPacket, ACorruptSizeIsNotWaitedForBeyondTheSensorsFrame) {
  const Bytes good = wirePacket(0x03, bytesOf("00 00"));
  // 979 bytes are one taxel more than the sensor has.
  EXPECT_EQ(parse(joined({bytesOf("AA AA AA 00 D3 03"), good}), 64).payloads.size(), 1u);
  // A packet of 977 bytes is awaited; when the line falls silent, the packet behind it is found.
  EXPECT_EQ(parse(joined({bytesOf("AA AA AA 00 D1 03"), good}), 64).payloads.size(), 0u);
  EXPECT_EQ(parse(joined({bytesOf("AA AA AA 00 D1 03"), good}), 64, true).payloads.size(), 1u);
  EXPECT_EQ(parse(joined({bytesOf("AA AA AA 00 D1 03"), good}), 64, true).pending, 0u);
}

TEST(DsaPacket, EscapeSequencesOfABootingControllerAreSkipped) {
  const Bytes boot = bytesOf("1B 5B 35 6E");
  const Found found = parse(joined({boot, boot, wirePacket(0x03, bytesOf("00 00")), boot}), 5);
  EXPECT_EQ(found.payloads.size(), 1u);
  EXPECT_EQ(found.stats.skippedBytes, 12u);
}

TEST(DsaPacket, RefusesPlacesThatNoFrameCanHave) {
  EXPECT_THROW(DsaPacketParser({.numCells = 0}), std::invalid_argument);
  EXPECT_THROW(DsaPacketParser({.numCells = 32'766}), std::invalid_argument);
  EXPECT_NO_THROW(DsaPacketParser({.numCells = 32'765}));
}

}  // namespace
}  // namespace palpate::testing::dsa_packet_test
