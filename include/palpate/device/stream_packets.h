// Reads and writes the packets of a binary stream. docs/manual/stream_protocol.md specifies them:
//
//   A5 5A | version u8 = 1 | type u8 | length u32 [bytes of payload] | sequence u32 |
//   device time u64 [us] | payload | CRC-32 u32
//
// Numbers are little-endian. The CRC-32 is zlib's (CRC-32/ISO-HDLC); it covers everything from the
// version to the end of the payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/device/stream_shape.h>

namespace palpate {

enum class StreamPacketType : std::uint8_t {
  kFrameU16 = 1,      // u16 per place or per taxel
  kFrameF32 = 2,      // f32 per place or per taxel
  kAngles = 3,        // f32 per axis
  kTemperatures = 4,  // f32 per sensor
  kDescription = 5,   // JSON, see StreamDescription
};

constexpr std::size_t kStreamHeaderBytes = 20;
constexpr std::size_t kStreamPacketBytes = kStreamHeaderBytes + 4;  // without the payload
constexpr std::size_t kLongestStreamDescription = 4096;             // [bytes]

// Appends one packet.
void appendStreamPacket(std::vector<std::byte>& out,
                        StreamPacketType type,
                        std::uint32_t sequence,
                        std::uint64_t deviceUs,
                        std::span<const std::byte> payload);
// Appends a frame of f32, or of u16 if all values are whole numbers of 0..65535.
void appendStreamFrame(std::vector<std::byte>& out,
                       std::uint32_t sequence,
                       std::uint64_t deviceUs,
                       std::span<const float> values);

// Every byte that was pushed is in exactly one of packetBytes, skippedBytes and pendingBytes().
struct StreamPacketStats {
  std::uint64_t packets = 0;       // with a right checksum
  std::uint64_t items = 0;         // handed to the sink
  std::uint64_t badChecksums = 0;  // candidates with a wrong checksum
  // Packets with a right checksum and implausible content.
  std::uint64_t refused = 0;
  // Frames with a value outside of the description of the hand; they are among `items`.
  std::uint64_t outOfRange = 0;
  // Beginnings of packets whose length is not that of an item of the hand; they are searched for
  // the next packet.
  std::uint64_t badLengths = 0;
  std::uint64_t packetBytes = 0;   // bytes of packets with a right checksum
  std::uint64_t skippedBytes = 0;  // bytes outside of any packet
};

// Not thread-safe. Never throws for bad input: a rejected candidate is counted, and the search
// continues one byte later, so that it hides no packet.
class StreamPacketParser {
 public:
  using Sink = std::function<void(const StreamItem&)>;
  explicit StreamPacketParser(StreamShape shape);

  // Consumes all bytes; calls `sink` once for each item, in order.
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Gives up the candidate that is pending and takes the packets behind its beginning, at the end
  // of a datagram or when nothing arrives any more. Then nothing is pending.
  void flush(const Sink& sink);
  const StreamPacketStats& stats() const noexcept { return stats_; }
  std::size_t pendingBytes() const noexcept { return pending_.size(); }
  // What is wrong with the last candidate that was not accepted: "packet 812: 510 bytes of u16
  // values (255) instead of 256 values". Packets are counted from 1, with those refused. Empty when
  // there was none.
  const std::string& lastFault() const noexcept { return lastFault_; }
  // The last value outside of the description: "packet 9: value 2 is 5880, not in 0..1023 counts".
  const std::string& lastOutOfRange() const noexcept { return lastOutOfRange_; }

 private:
  std::size_t take(std::span<const std::byte> bytes, bool isEnd, const Sink& sink);
  std::string lengthFault(StreamPacketType type, std::size_t length) const;
  void deliver(std::span<const std::byte> packet, const Sink& sink);
  std::string place() const;
  void fault(const std::string& why);

  StreamShape shape_;
  StreamPacketStats stats_;
  std::string lastFault_;
  std::string lastOutOfRange_;
  std::vector<std::byte> pending_;  // the beginning of a packet
  std::vector<float> values_;
  std::vector<double> numbers_;
};

}  // namespace palpate
