// The other end of a stream: a port or a TCP connection as openChannel() opens them, a TCP or UDP
// port of this machine on which senders are awaited, or standard input.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/file_descriptor.h"
#include "palpate/core/network_place.h"
#include "palpate/core/time.h"
#include "palpate/device/byte_channel.h"

namespace palpate {

// Opened again and again by one thread; localPort(), ended() and placeText() may be called from
// any.
class StreamSource {
 public:
  // `name`: see StreamDeviceOptions::source. The clock must outlive the source. Throws
  // std::invalid_argument when the name is malformed.
  StreamSource(std::string name, int baud, const Clock& clock = systemClock());

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
  bool isOpenToOthers() const;
  // True when the first bytes may lack the beginning of a line: the sender may be running already.
  bool startsInside() const noexcept { return kind_ == Kind::kPort; }
  bool isInput() const noexcept { return kind_ == Kind::kInput; }
  // "127.0.0.1:9871", where senders are awaited; empty where localPort() is.
  std::string placeText() const;
  // Of a listening port: who is connected, for messages: "127.0.0.1:50412 holds the port"; empty
  // for other sources.
  std::string holderText() const;
  // How long the connection that was opened last waited for another one to end [us].
  std::int64_t waitedUs() const noexcept { return waitedUs_; }
  // What is to be said of the senders, once: others wait or waited in vain, or two of them send
  // datagrams. Empty: nothing.
  std::string takeRemark() { return std::exchange(remark_, {}); }

 private:
  enum class Kind { kPort, kListen, kUdp, kInput };
  std::unique_ptr<ByteChannel> openPort();
  std::unique_ptr<ByteChannel> openInput();
  std::unique_ptr<ByteChannel> openUdp();
  std::unique_ptr<ByteChannel> acceptSender();
  void acceptWaiting();
  void makeRoom();
  bool someWaitingSends();
  void noteDatagramFrom(const std::string& sender);
  void remark(std::int64_t& nextUs, const std::string& text);
  FileDescriptor boundSocket(int type);

  friend class ListenedChannel;
  friend class UdpChannel;

  // A sender that connected while another one is read.
  struct Waiting {
    FileDescriptor connection;
    std::string peer;
    std::int64_t sinceUs = 0;  // monotonic
  };

  const std::string name_;
  const int baud_;
  const Clock& clock_;
  Kind kind_ = Kind::kPort;
  NetworkPlace place_;
  std::string stableName_;
  FileDescriptor listening_;
  std::vector<Waiting> waiting_;  // the newest last
  std::int64_t nextAcceptUs_ = 0;
  std::string holder_;
  std::int64_t waitedUs_ = 0;
  // The last two senders of datagrams.
  std::string sender_, otherSender_;
  std::int64_t otherSenderUs_ = 0;
  std::string remark_;
  std::int64_t nextRemarkUs_ = 0;
  std::int64_t nextDropRemarkUs_ = 0;
  std::size_t numDropped_ = 0;  // senders that waited
  bool inputOpened_ = false;
  std::atomic<int> localPort_ = 0;
  std::atomic<bool> ended_ = false;
};

}  // namespace palpate
