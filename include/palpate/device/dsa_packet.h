// DSACON32-M packet framing: finds and checks packets in a raw byte stream, and makes requests.
//
// Wire layout, little-endian (behaviour of SCHUNK's SDHLibrary; names after the Weiss Robotics
// DSACON32 command set):
//   AA AA AA | id u8 | size u16 [bytes] | payload[size] | checksum u16, only when size > 0
// The checksum (weiss_checksum.h) covers id, size and payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace palpate {

// Packet ids; an answer carries the id of its request.
enum class DsaId : std::uint8_t {
  kFrame = 0x00,
  kControllerConfiguration = 0x01,
  kSensorConfiguration = 0x02,
  kAcquisition = 0x03,
  kReadMask = 0x04,
  kDescriptor = 0x05,
  kLoop = 0x06,
  kControllerState = 0x0A,
  kMatrixConfiguration = 0x0B,
  kSetSensitivity = 0x0F,
  kGetSensitivity = 0x12,
  kSetThreshold = 0x13,
  kGetThreshold = 0x14,
  kSetDynamicMask = 0xAB,
};

struct DsaPacket {
  DsaId id = DsaId::kFrame;
  std::span<const std::byte> payload;  // valid only inside the sink call
};

// Counts since construction. Every byte pushed is in exactly one packet, skipped, or still pending.
struct DsaPacketStats {
  std::uint64_t bytes = 0;         // pushed
  std::uint64_t packets = 0;       // delivered to the sink
  std::uint64_t packetBytes = 0;   // bytes in those packets
  std::uint64_t skippedBytes = 0;  // outside any accepted packet
  std::uint64_t implausible = 0;   // candidates whose id or size no controller sends
  std::uint64_t badChecksums = 0;  // candidates with a wrong checksum
};

struct DsaPacketOptions {
  // Places in a frame (SDH-2: 486): a frame's payload is 5 + 2 n bytes, n = 1..places. A candidate
  // that claims a larger size is rejected at once, so a corrupt size delays the search by at most
  // one frame.
  std::size_t numCells = 486;
};

// Push parser; not thread-safe (one per port thread). Never throws on bad input: bad bytes are
// counted and the search restarts one byte later, so that a rejected candidate hides no packet.
class DsaPacketParser {
 public:
  using Sink = std::function<void(const DsaPacket&)>;
  // Throws std::invalid_argument when a frame of that many places has no u16 size (0, or over
  // 32,765).
  explicit DsaPacketParser(DsaPacketOptions options = {});
  // Consumes all of `bytes`; calls `sink` once per valid packet, in order, before returning. The
  // sink must not call push().
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Changes the number of places when the sensor turns out to have another one. Throws as the
  // constructor does.
  void setNumPlaces(std::size_t numCells);
  const DsaPacketStats& stats() const noexcept { return stats_; }
  std::size_t pendingBytes() const noexcept { return pending_.size(); }
  // Call this when the line has been silent, so that a pending packet will not be completed. The
  // search restarts one byte after the start of the pending candidate, so that a packet behind a
  // corrupt size is found; nothing is pending afterwards.
  void flush(const Sink& sink);

 private:
  bool plausible(std::uint8_t id, std::size_t size) const noexcept;
  // Consumes from the front of `in`; returns the number of bytes that are processed.
  std::size_t consume(std::span<const std::byte> in, const Sink& sink);

  std::size_t largestFrame_ = 0;  // payload [bytes]
  DsaPacketStats stats_;
  std::vector<std::byte> pending_;  // start of a packet that is not complete yet
};

// Encodes a request: preamble, id, size, payload, checksum (none for an empty payload).
std::vector<std::byte> dsaRequest(DsaId id, std::span<const std::byte> payload = {});

}  // namespace palpate
