// Fuzzes the emulated tactile controller with what a client might send, in pieces and over time.
// Beyond not crashing: all that it says is whole packets (or the queries of booting), frames have
// all their values, it never waits for more than a request, and after silence it answers a correct
// question.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "palpate/emulator/dsa_server.h"

#include "emulator/line_client.h"
#include "emulator/still_hand.h"

namespace {

using namespace palpate;
using palpate::testing::Octets;

void require(bool condition) {
  if (!condition) std::abort();
}

// Returns the number of packets with that id.
int requireWhole(const std::vector<LineMessage>& messages, int id) {
  palpate::testing::PacketScanner scanner;
  std::size_t packets = 0;
  for (const LineMessage& message : messages) {
    Octets bytes;
    for (const std::byte b : message.bytes) bytes.push_back(std::to_integer<std::uint8_t>(b));
    if (message.checksummed) ++packets;
    if (message.checksummed) scanner.feed(bytes);
  }
  int wanted = 0;
  while (const auto packet = scanner.next()) {
    --packets;
    if (packet->id == id) ++wanted;
    if (packet->id == 0) require(palpate::testing::decodeFramePayload(packet->payload).has_value());
    require(packet->payload.size() >= 2);
  }
  require(packets == 0 && scanner.skipped == 0 && scanner.badChecksums == 0);
  return wanted;
}

}  // namespace

// The first byte says how large the pieces are and how fast time goes; the rest is what the client
// sends.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::size_t piece = 1 + (data[0] & 0x1F);
  const std::int64_t stepUs = (data[0] >> 5) * 8000;
  auto rest = std::as_bytes(std::span(data + 1, size - 1));
  palpate::testing::StillHand hand;
  hand.noisy = (size & 1) != 0;
  DsaServer server(hand);
  std::int64_t nowUs = 0;
  while (!rest.empty()) {
    const auto now = rest.first(std::min(piece, rest.size()));
    rest = rest.subspan(now.size());
    server.receive(now, nowUs += stepUs);
    server.advance(nowUs, 0);
    requireWhole(server.take(), -1);
    for (const MatrixSetting& setting : hand.settings()) {
      require(setting.sensitivity >= 0.0 && setting.sensitivity <= 1.0);
      require(setting.thresholdCounts >= 0 && setting.thresholdCounts <= 4095);
    }
  }
  server.onReceiveTimeout();
  require(!server.hasPartialRequest());
  server.take();
  const Octets query = palpate::testing::tactilePacket(0x01, {});
  server.receive(std::as_bytes(std::span(query)), nowUs);
  require(requireWhole(server.take(), 0x01) == 1);
  return 0;
}
