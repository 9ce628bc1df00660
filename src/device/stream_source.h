// The other end of a stream: a port or a TCP connection as openChannel() opens them, a TCP or UDP
// port of this machine on which senders are awaited, or standard input.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "palpate/core/file_descriptor.h"
#include "palpate/device/byte_channel.h"

namespace palpate {

// Opened again and again by one thread; localPort() and ended() may be called from any.
class StreamSource {
 public:
  // `name`: see StreamDeviceOptions::source. Throws std::invalid_argument when it is malformed.
  StreamSource(std::string name, int baud);

  // Throws DeviceError; kNotFound also while no sender has connected to a listening port, which
  // stays open.
  std::unique_ptr<ByteChannel> open();
  // Ends listening.
  void close();
  // The port on which senders are awaited; empty before it is open, and for other sources.
  std::optional<std::uint16_t> localPort() const;
  // True once everything from standard input was read.
  bool ended() const noexcept { return ended_; }
  // True when other machines can reach the port on which senders are awaited.
  bool isOpenToOthers() const noexcept;
  // True when the first bytes may lack the beginning of a line: the sender may be running already.
  bool startsInside() const noexcept { return kind_ == Kind::kPort; }
  bool isInput() const noexcept { return kind_ == Kind::kInput; }
  // "127.0.0.1:9871", where senders are awaited; empty where localPort() is.
  std::string placeText() const;

 private:
  enum class Kind { kPort, kListen, kUdp, kInput };
  std::unique_ptr<ByteChannel> openPort();
  std::unique_ptr<ByteChannel> openInput();
  std::unique_ptr<ByteChannel> openUdp();
  std::unique_ptr<ByteChannel> acceptSender();
  FileDescriptor boundSocket(int type);

  const std::string name_;
  const int baud_;
  Kind kind_ = Kind::kPort;
  std::string address_;  // numeric
  std::uint16_t port_ = 0;
  std::string stableName_;
  FileDescriptor listening_;
  bool inputOpened_ = false;
  std::atomic<int> localPort_ = 0;
  std::atomic<bool> ended_ = false;
};

}  // namespace palpate
