// The sending half of a serial line: messages queue up, and each byte leaves at its own time
// (115200 baud, 8N1: 86.8 us per byte). Holds no descriptor and no clock: the caller says what time
// it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace palpate {

// One byte at 115200 baud: start bit, 8 bits, stop bit [us].
constexpr double kSerialByteUs = 10.0 * 1e6 / 115'200.0;

// What a server puts on the line in one go: a packet, a record, a text line.
struct LineMessage {
  std::vector<std::byte> bytes;
  bool checksummed = false;                 // the last two bytes are its checksum
  std::optional<std::uint64_t> frame = {};  // number of the tactile frame it carries
  bool damaged = false;                     // a fault has changed its bytes
};

// A message that has left the line.
struct SentMessage {
  std::optional<std::uint64_t> frame;
  std::size_t bytes = 0;
  bool damaged = false;  // by a fault, before it went on the line
  bool lost = false;     // at least one byte found nobody who took it
};

class PacedLine {
 public:
  // byteUs: time per byte [us]; 0: no pacing, everything is due at once.
  explicit PacedLine(double byteUs) : byteUs_(byteUs) {}

  // The message leaves at `atUs`, or when the line is free, if that is later.
  void push(LineMessage message, std::int64_t atUs);
  // When the last byte will have left [us]; 0 without pacing.
  std::int64_t freeAtUs() const noexcept;
  std::size_t pendingBytes() const noexcept { return buffer_.size() - head_; }
  // When the next bytes are due; nothing when there are none. Bytes come due in pieces of at most
  // 64 (5.6 ms), each when its last byte has left, and a message of up to 64 bytes in one piece.
  std::optional<std::int64_t> nextDueUs() const;
  // The bytes that have left the line by now; valid until the next call.
  std::span<const std::byte> due(std::int64_t nowUs) const;
  // The first `count` bytes of due() are gone: taken by the system, or lost. Appends the messages
  // that ended.
  void pass(std::size_t count, bool lost, std::vector<SentMessage>& ended);
  // All that is pending is lost.
  void clear(std::vector<SentMessage>& ended);

 private:
  struct Entry {
    SentMessage message;
    std::size_t passed = 0;
    double startUs = 0.0;
  };
  double leftUs(const Entry& entry, std::size_t bytes) const;

  double byteUs_;
  double freeAtUs_ = 0.0;
  std::vector<std::byte> buffer_;  // from head_ on: pending
  std::size_t head_ = 0;
  std::deque<Entry> entries_;
};

}  // namespace palpate
