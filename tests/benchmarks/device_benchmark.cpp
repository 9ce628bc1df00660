// What a frame packet costs on its way in: framing, checksum, decoding, clock; beside the checksum
// in its textbook form (a table, byte by byte) over the same bytes. Target: under 3 us per packet.
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "palpate/device/dsa_frame.h"
#include "palpate/device/dsa_packet.h"
#include "palpate/device/sdh2.h"
#include "palpate/device/weiss_checksum.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/tactile_frame.h"

#include "device/dsa_wire.h"

namespace {

using namespace palpate;
using testing::Bytes;

enum Content { kUntouched, kGrasp, kNoise, kRaw };

std::vector<Bytes> packets(Content content) {
  std::mt19937 random(1);
  std::vector<Bytes> all;
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::vector<unsigned> counts(486, 0);
    if (content == kGrasp || content == kRaw) counts = testing::graspCounts(random);
    if (content == kNoise) {
      std::size_t place = 0;
      for (const MatrixLayout& matrix : sdh2().layout->matrices())
        for (const std::uint8_t exists : matrix.staticMask)
          counts[place++] = exists != 0 ? 40 + random() % 3 : 0;
    }
    all.push_back(
        testing::wirePacket(0, testing::framePayload(1000 + 32 * i, counts, content != kRaw)));
  }
  return all;
}

void framePacket(benchmark::State& state, Content content) {
  const std::vector<Bytes> all = packets(content);
  DsaPacketParser parser;
  TactileFrame frame(sdh2().layout);
  std::uint64_t decoded = 0;
  const DsaPacketParser::Sink sink = [&](const DsaPacket& packet) {
    if (decodeDsaFrame(packet.payload, *sdh2().layout, true, frame.values)) ++decoded;
  };
  std::size_t next = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    parser.push(all[next], sink);
    bytes += all[next].size();
    next = (next + 1) % all.size();
  }
  if (decoded != static_cast<std::uint64_t>(state.iterations()))
    state.SkipWithError("frames were refused");
  state.counters["bytes"] = static_cast<double>(bytes) / static_cast<double>(state.iterations());
}

void textbookChecksum(benchmark::State& state, Content content) {
  const std::vector<Bytes> all = packets(content);
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned r = i << 8;
    for (int bit = 0; bit < 8; ++bit) r = (r & 0x8000u) != 0 ? r << 1 ^ 0x1021u : r << 1;
    table[i] = static_cast<std::uint16_t>(r);
  }
  std::size_t next = 0;
  for (auto _ : state) {
    std::uint16_t crc = 0xFFFF;
    for (const std::byte b : all[next])
      crc = static_cast<std::uint16_t>(crc >> 8 ^
                                       table[(crc ^ std::to_integer<unsigned>(b)) & 0xFFu]);
    benchmark::DoNotOptimize(crc);
    next = (next + 1) % all.size();
  }
}

BENCHMARK_CAPTURE(framePacket, untouched, kUntouched);
BENCHMARK_CAPTURE(textbookChecksum, untouched, kUntouched);
BENCHMARK_CAPTURE(framePacket, grasp, kGrasp);
BENCHMARK_CAPTURE(textbookChecksum, grasp, kGrasp);
BENCHMARK_CAPTURE(framePacket, noise, kNoise);
BENCHMARK_CAPTURE(textbookChecksum, noise, kNoise);
BENCHMARK_CAPTURE(framePacket, raw, kRaw);
BENCHMARK_CAPTURE(textbookChecksum, raw, kRaw);

}  // namespace
