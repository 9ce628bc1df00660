// Sends datagrams to a UDP port of this machine (127.0.0.1 only). Never waits: a datagram that
// can't be sent at once is dropped and counted.
#pragma once

#include <cstdint>
#include <string_view>

#include <palpate/core/file_descriptor.h>

namespace palpate {

struct DatagramStats {
  // Number of datagrams that the operating system accepted. Whether a program received them is
  // unknown, unless the system reports a closed port.
  std::uint64_t sent = 0;
  std::uint64_t dropped = 0;  // no receiver, no room, or too long
  // Number of datagrams that the system accepted and then reported as without a receiver.
  std::uint64_t unheard = 0;
  // Whether the last two datagrams were accepted: the system reports a missing receiver only
  // with the next datagram.
  bool delivered = false;

  // Whether no datagram can have reached a program; the fate of the last one is unknown.
  bool nobodyListened() const noexcept { return unheard > 0 && sent <= unheard + 1; }
};

// Not thread-safe.
class DatagramSender {
 public:
  static constexpr std::size_t kMaxBytes = 65'507;  // largest UDP payload

  // Throws std::invalid_argument (port 0), DeviceError (the system has no socket left).
  explicit DatagramSender(std::uint16_t port);

  // Returns whether the system accepted the datagram. Sending continues even if no program received
  // earlier ones, because a receiver may start at any time.
  bool send(std::string_view bytes) noexcept;
  const DatagramStats& stats() const noexcept { return stats_; }

 private:
  FileDescriptor socket_;
  bool lastTaken_ = false;
  DatagramStats stats_;
};

}  // namespace palpate
