// Sending side of an emulated serial line: messages queue up, and each byte leaves at its own time
// (115200 baud, 8N1: 86.8 us per byte). It uses neither file descriptor nor clock: the caller
// passes the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace palpate {

// Duration of one byte at 115200 baud: start bit, 8 bits, stop bit [us].
constexpr double kSerialByteUs = 10.0 * 1e6 / 115'200.0;

// A message that a server sends as a whole: a packet, a record, or a text line.
struct LineMessage {
  std::vector<std::byte> bytes;
  bool checksummed = false;  // the last two bytes are a checksum
  // Number of the tactile frame in this message, if it contains one.
  std::optional<std::uint64_t> frame = {};
  bool damaged = false;  // a fault has changed its bytes
};

// A message that has left the line.
struct SentMessage {
  std::optional<std::uint64_t> frame;
  std::size_t bytes = 0;
  bool damaged = false;  // changed by a fault before it was sent
  bool lost = false;     // at least one byte was not read by any client
};

class PacedLine {
 public:
  // byteUs: time per byte [us]; 0 for no pacing, where everything is due at once.
  explicit PacedLine(double byteUs) : byteUs_(byteUs) {}

  // Queues a message. Its first byte leaves at `atUs`, or later when the line is free.
  void push(LineMessage message, std::int64_t atUs);
  // Time at which the last byte will have left [us]; 0 without pacing.
  std::int64_t freeAtUs() const noexcept;
  std::size_t pendingBytes() const noexcept { return buffer_.size() - head_; }
  // Time at which the next bytes are due; empty when none are pending. Bytes become due in chunks
  // of at most 64 (5.6 ms), each when its last byte has left; a message of up to 64 bytes is one
  // chunk.
  std::optional<std::int64_t> nextDueUs() const;
  // The bytes that have left the line by now; valid until the next call.
  std::span<const std::byte> due(std::int64_t nowUs) const;
  // Removes the first `count` bytes of due(), which the system accepted or which were lost. Appends
  // the messages that ended with them.
  void pass(std::size_t count, bool lost, std::vector<SentMessage>& ended);
  // Drops all pending bytes as lost.
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
  std::vector<std::byte> buffer_;  // pending bytes, from head_ on
  std::size_t head_ = 0;
  std::deque<Entry> entries_;
};

}  // namespace palpate
