// One port of the emulated hand: sends the messages of a server through the faults and the paced
// line to the client, and receives the client's bytes.
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
  // byteUs: time per byte on the line [us]; 0: no pacing.
  EmulatedPortChannel(std::unique_ptr<PortServer> port,
                      double byteUs,
                      const Faults& faults,
                      std::uint64_t seed);

  PortServer& port() noexcept { return *port_; }
  const PortServer& port() const noexcept { return *port_; }
  void setFaults(const Faults& faults);
  void setMuted(bool muted) noexcept { muted_ = muted; }
  void sendRandomBytes(std::uint64_t bytes) noexcept { babble_ += bytes; }
  // True if pushed messages will reach a client soon.
  bool ready() const noexcept;
  // Time at which all pushed messages will have been sent [us].
  std::int64_t freeAtUs() const noexcept { return line_.freeAtUs(); }

  // Returns the bytes that arrived from the client. At the first call it sends junk before any
  // answer.
  std::span<const std::byte> receive(std::int64_t nowUs, FaultCounts& counts);
  void push(LineMessage message, std::int64_t atUs, FaultCounts& counts);
  // Hands the bytes that are due to the system. Appends the messages that have left to ended().
  void flush(std::int64_t nowUs);
  void unplug();
  // Sends this number of further bytes and nothing more; then cut() is true until unplug().
  void cutAfter(std::uint64_t bytes) noexcept { bytesUntilCut_ = bytes; }
  bool cut() const noexcept { return bytesUntilCut_ == 0; }
  std::vector<SentMessage>& ended() noexcept { return ended_; }
  // Next time at which flush() has something to do; empty when nothing is pending.
  std::optional<std::int64_t> nextDueUs() const;
  // True when bytes are due but the system accepts none; flush() must be tried again later.
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
