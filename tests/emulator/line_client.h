// A client of the two ports, written from the protocol document alone: plain descriptors, its own
// checksum (bit by bit), its own decoding. Shares no code with the driver or the emulator.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpate::testing {

using Octets = std::vector<std::uint8_t>;

// "AA 03 7C" as bytes; "00x28" stands for 28 times 00.
Octets octets(const std::string& hex);
std::string hexText(const Octets& bytes);
std::uint16_t bitwiseChecksum(const Octets& bytes);
// AA AA AA id length payload checksum (none without payload).
Octets tactilePacket(std::uint8_t id, const Octets& payload);

struct TactilePacket {
  std::uint8_t id = 0;
  Octets payload;
  std::chrono::steady_clock::time_point at;  // when its last byte was read
};
struct DecodedFrame {
  std::uint32_t deviceMs = 0;
  bool runLength = false;
  std::vector<std::uint16_t> values;
  std::size_t packetBytes = 0;
};
// Nothing when it isn't a full frame of 486 values.
std::optional<DecodedFrame> decodeFramePayload(const Octets& payload);

// Takes packets out of a stream; what is no packet is skipped and counted.
class PacketScanner {
 public:
  void feed(const Octets& bytes) { pending_.insert(pending_.end(), bytes.begin(), bytes.end()); }
  std::optional<TactilePacket> next();
  std::size_t skipped = 0;
  std::size_t badChecksums = 0;

 private:
  Octets pending_;
};

class LineClient {
 public:
  // A pty path (or link), or tcp:127.0.0.1:PORT. Throws std::runtime_error.
  explicit LineClient(const std::string& port);
  ~LineClient();
  LineClient(const LineClient&) = delete;
  LineClient& operator=(const LineClient&) = delete;

  void send(const Octets& bytes);
  void send(const std::string& text);
  // What comes within the time, at once when there is something; empty: nothing came.
  Octets receive(std::chrono::milliseconds timeout);
  // Exactly so many bytes; fewer when they don't come in time.
  Octets receiveExactly(std::size_t count,
                        std::chrono::milliseconds timeout = std::chrono::milliseconds(2000));
  // A line without its end; nothing when none comes.
  std::optional<std::string> receiveLine(
      std::chrono::milliseconds timeout = std::chrono::milliseconds(2000));
  // Reads until nothing has come for that long; returns what came.
  Octets receiveUntilSilent(std::chrono::milliseconds silence);
  // The next packet of the stream.
  std::optional<TactilePacket> packet(
      std::chrono::milliseconds timeout = std::chrono::milliseconds(2000));
  // The next packet with that id, frames in between are dropped.
  std::optional<TactilePacket> answer(std::uint8_t id);
  // Sends, and gives the payload of the answer with the same id.
  std::optional<Octets> ask(std::uint8_t id, const Octets& payload = {});
  bool hungUp() const noexcept { return hungUp_; }
  PacketScanner& scanner() noexcept { return scanner_; }

 private:
  int descriptor_ = -1;
  bool hungUp_ = false;
  Octets kept_;
  PacketScanner scanner_;
};

}  // namespace palpate::testing
