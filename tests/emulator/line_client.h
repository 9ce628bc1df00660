// Client of the two ports for tests, written from the protocol document alone: plain file
// descriptors, its own bitwise checksum and its own decoding. It shares no code with the driver or
// the emulator.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpate::testing {

using Octets = std::vector<std::uint8_t>;

// Converts "AA 03 7C" to bytes; "00x28" means 28 times 00.
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
// Decodes a full frame of 486 values; returns nothing for any other payload.
std::optional<DecodedFrame> decodeFramePayload(const Octets& payload);

// Extracts packets from a stream; other bytes are skipped and counted.
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
  // `port`: a pty path (or link), or tcp:127.0.0.1:PORT. Throws std::runtime_error.
  explicit LineClient(const std::string& port);
  ~LineClient();
  LineClient(const LineClient&) = delete;
  LineClient& operator=(const LineClient&) = delete;

  void send(const Octets& bytes);
  void send(const std::string& text);
  // Returns the bytes that arrive within the time, as soon as there are some; empty if none
  // arrived.
  Octets receive(std::chrono::milliseconds timeout);
  // Reads exactly `count` bytes; fewer when they don't arrive in time.
  Octets receiveExactly(std::size_t count,
                        std::chrono::milliseconds timeout = std::chrono::milliseconds(2000));
  // Reads a line without its end; returns nothing when none arrives.
  std::optional<std::string> receiveLine(
      std::chrono::milliseconds timeout = std::chrono::milliseconds(2000));
  // Reads until no byte has arrived for `silence`; returns all bytes.
  Octets receiveUntilSilent(std::chrono::milliseconds silence);
  // The next packet of the stream.
  std::optional<TactilePacket> packet(
      std::chrono::milliseconds timeout = std::chrono::milliseconds(2000));
  // The next packet with that id; frames in between are dropped.
  std::optional<TactilePacket> answer(std::uint8_t id);
  // Sends a request and returns the payload of the answer with the same id.
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
