// One port of the emulated hand: what a server says goes through the faults and over the paced line
// to whoever reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/faults.h"
#include "palpate/emulator/paced_line.h"
#include "palpate/emulator/port_server.h"

namespace palpate {

class EmulatedPortChannel {
 public:
  // byteUs: line time of a byte [us], 0: no pacing.
  EmulatedPortChannel(std::unique_ptr<PortServer> port,
                      double byteUs,
                      const Faults& faults,
                      std::uint64_t seed);

  PortServer& port() noexcept { return *port_; }
  const PortServer& port() const noexcept { return *port_; }
  void setFaults(const Faults& faults);
  void setMuted(bool muted) noexcept { muted_ = muted; }
  void sendRandomBytes(std::uint64_t bytes) noexcept { babble_ += bytes; }
  // Whether what is pushed will reach somebody, and soon.
  bool ready() const noexcept;
  // When the line will have sent all that was pushed [us].
  std::int64_t freeAtUs() const noexcept { return line_.freeAtUs(); }

  // What has come from the client; the first time, junk goes out ahead of any answer.
  std::span<const std::byte> receive(std::int64_t nowUs, FaultCounts& counts);
  void push(LineMessage message, std::int64_t atUs, FaultCounts& counts);
  // Hands to the system what is due. Appends to ended() the messages that have left.
  void flush(std::int64_t nowUs);
  void unplug();
  // After so many bytes more nothing leaves any more; then cut() is true, until the plug is out.
  void cutAfter(std::uint64_t bytes) noexcept { bytesUntilCut_ = bytes; }
  bool cut() const noexcept { return bytesUntilCut_ == 0; }
  std::vector<SentMessage>& ended() noexcept { return ended_; }
  // When flush() has something to do; nothing: nothing pends.
  std::optional<std::int64_t> nextDueUs() const;
  // Bytes are due, but the system takes none: try again in a while.
  bool blocked() const noexcept { return blocked_; }
  EmulatedPortCounts counts() const noexcept;

 private:
  void write(std::int64_t nowUs);
  void countLostBytes(const LineMessage& message);

  std::unique_ptr<PortServer> port_;
  bool paced_;
  PacedLine line_;
  ByteFaults faults_;
  std::uint64_t seed_;
  std::uint64_t faultSets_ = 0;
  std::size_t junkBytes_;
  bool muted_ = false;
  bool blocked_ = false;
  std::uint64_t babble_ = 0;
  std::optional<std::uint64_t> bytesUntilCut_;
  std::vector<std::byte> input_;
  std::vector<SentMessage> ended_;
  EmulatedPortCounts counts_;
};

}  // namespace palpate
