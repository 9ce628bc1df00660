// Fuzzes the emulated motion controller with text, records and anything between. Beyond not
// crashing: every answer is a line or a record of full length with its checksum, joints stay within
// their range, and after silence and a line end it answers a correct question.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "palpate/emulator/sdh_server.h"

#include "emulator/line_client.h"
#include "emulator/still_hand.h"

namespace {

using namespace palpate;
using palpate::testing::Octets;

void require(bool condition) {
  if (!condition) std::abort();
}

void requireWhole(const LineMessage& message) {
  Octets bytes;
  for (const std::byte b : message.bytes) bytes.push_back(std::to_integer<std::uint8_t>(b));
  require(bytes.size() >= 3);
  if (message.checksummed) {
    require(bytes.size() == 34 && bytes[0] >= 0x80 && bytes[1] == 0x20 && bytes[2] == 7);
    const std::uint16_t crc =
        palpate::testing::bitwiseChecksum(Octets(bytes.begin(), bytes.end() - 2));
    require(bytes[32] == (crc & 0xFF) && bytes[33] == crc >> 8);
    return;
  }
  require(bytes[bytes.size() - 2] == '\r' && bytes.back() == '\n' && bytes[0] != '\r');
  for (const std::uint8_t byte : bytes) require(byte < 0x80);
}

std::string taken(SdhServer& server) {
  std::string text;
  for (const LineMessage& message : server.take()) {
    requireWhole(message);
    for (const std::byte b : message.bytes) text += std::to_integer<char>(b);
  }
  return text;
}

}  // namespace

// The first byte says how large the pieces are and how fast time goes; the rest is what the client
// sends.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::size_t piece = 1 + (data[0] & 0x1F);
  const std::int64_t stepUs = (data[0] >> 5) * 50'000;
  auto rest = std::as_bytes(std::span(data + 1, size - 1));
  palpate::testing::StillHand hand;
  SdhServer server(hand);
  std::int64_t nowUs = 0;
  while (!rest.empty()) {
    const auto now = rest.first(std::min(piece, rest.size()));
    rest = rest.subspan(now.size());
    server.receive(now, nowUs += stepUs);
    taken(server);
    for (std::size_t i = 0; i < 7; ++i) {
      const AxisDescription& axis = hand.hand().axes[i];
      const double deg = hand.joints().angles()[i];
      require(deg >= axis.minimumDeg - 1e-9 && deg <= axis.maximumDeg + 1e-9);
      require(std::isfinite(hand.joints().velocities()[i]));
    }
  }
  // Motions end, and those that wait behind them.
  for (int i = 0; i < 20'000 && server.nextUs(); ++i) server.advance(nowUs = *server.nextUs());
  require(!server.nextUs());
  server.onReceiveTimeout();
  server.receive(std::as_bytes(std::span("\r\n", 2)), nowUs);
  for (int i = 0; i < 20'000 && server.nextUs(); ++i) server.advance(nowUs = *server.nextUs());
  taken(server);
  server.receive(std::as_bytes(std::span("ver\r\n", 5)), nowUs);
  require(taken(server) == "VER=0.0.3.3\r\n");
  return 0;
}
