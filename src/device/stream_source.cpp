#include "device/stream_source.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/port_list.h"

#include "device/descriptor_channel.h"
#include "device/tcp_channel.h"

namespace palpate {
namespace {

constexpr std::string_view kListenPrefix = "listen:";
constexpr std::string_view kUdpPrefix = "udp:";
constexpr int kUdpBufferBytes = 1 << 22;
constexpr int kBacklog = 8;
constexpr std::size_t kMaxWaiting = 8;
constexpr std::int64_t kAcceptEveryUs = 100'000;
constexpr std::int64_t kHolderSilentUs = 1'000'000;
// A sender that comes back this soon after another one sent is a second sender, no successor.
constexpr std::int64_t kOtherSenderUs = 2'000'000;
constexpr std::int64_t kRemarkEveryUs = 10'000'000;

// Whether bytes of the sender wait to be read; empty: it closed the connection.
std::optional<bool> hasSent(const FileDescriptor& connection) {
  char first = 0;
  const ssize_t got = ::recv(connection.get(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  if (got > 0) return true;
  if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return false;
  return std::nullopt;
}

class InputChannel final : public DescriptorChannel {
 public:
  // A socket for the base class, because a read of no bytes is the end.
  InputChannel(std::string name, FileDescriptor fd)
      : DescriptorChannel(std::move(name), fd.get(), true), fd_(std::move(fd)) {}
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    try {
      return DescriptorChannel::read(into, timeout);
    } catch (const DeviceError&) {
      throw DeviceError(DeviceFault::kDisconnected, name(), "standard input has ended");
    }
  }

 private:
  FileDescriptor fd_;
};

}  // namespace

class UdpChannel final : public DescriptorChannel {
 public:
  // No socket for the base class, to which an empty datagram would be the end.
  UdpChannel(StreamSource& source, FileDescriptor fd)
      : DescriptorChannel(source.name_, fd.get(), false), fd_(std::move(fd)), source_(source) {}
  bool isNetwork() const noexcept override { return true; }
  bool isDatagrams() const noexcept override { return true; }

 private:
  ssize_t receive(std::span<std::byte> into) override {
    SocketAddress sender;
    const ssize_t got =
        ::recvfrom(fd_.get(), into.data(), into.size(), 0, sender.get(), &sender.size);
    if (got > 0) source_.noteDatagramFrom(sender.place().text());
    return got;
  }

  FileDescriptor fd_;
  StreamSource& source_;
};

// A connection to a listening port. It ends when it is silent and another sender sends: a
// connection whose other end died without a word would hold the port for ever.
class ListenedChannel final : public ByteChannel {
 public:
  ListenedChannel(StreamSource& source, std::unique_ptr<ByteChannel> connection)
      : source_(source),
        connection_(std::move(connection)),
        heardUs_(source.clock_.monotonicUs()) {}

  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    const std::size_t got = connection_->read(into, timeout);
    const std::int64_t nowUs = source_.clock_.monotonicUs();
    if (got > 0) heardUs_ = nowUs;
    source_.acceptWaiting();
    if (nowUs - heardUs_ >= kHolderSilentUs && source_.someWaitingSends())
      throw DeviceError(DeviceFault::kDisconnected,
                        name(),
                        source_.holder_ +
                            " sent nothing for a second while another sender waited: "
                            "the other one is read now");
    return got;
  }
  void write(std::span<const std::byte> bytes) override { connection_->write(bytes); }
  void interrupt() noexcept override { connection_->interrupt(); }
  const std::string& name() const noexcept override { return connection_->name(); }
  bool isNetwork() const noexcept override { return true; }
  bool atEnd() const noexcept override { return connection_->atEnd(); }

 private:
  StreamSource& source_;
  std::unique_ptr<ByteChannel> connection_;
  std::int64_t heardUs_;
};

StreamSource::StreamSource(std::string name, int baud, const Clock& clock)
    : name_(std::move(name)), baud_(baud), clock_(clock) {
  if (name_ == "-") {
    kind_ = Kind::kInput;
    return;
  }
  for (const auto& [prefix, kind] :
       {std::pair{kListenPrefix, Kind::kListen}, std::pair{kUdpPrefix, Kind::kUdp}})
    if (name_.starts_with(prefix)) kind_ = kind;
  if (kind_ == Kind::kPort) return;
  const std::string prefix(kind_ == Kind::kListen ? kListenPrefix : kUdpPrefix);
  const auto place = networkPlaceOf(name_.substr(prefix.size()));
  if (!place)
    throw std::invalid_argument("'" + shortened(name_) + "' is not " + prefix +
                                "[ADDRESS:]PORT, for example " + prefix + "9871 or " + prefix +
                                "0.0.0.0:9871; " + kNetworkPlaceRule);
  place_ = *place;
}

bool StreamSource::isOpenToOthers() const {
  return (kind_ == Kind::kListen || kind_ == Kind::kUdp) && place_.isOpenToOthers();
}

std::optional<std::uint16_t> StreamSource::localPort() const {
  const int port = localPort_;
  return port == 0 ? std::nullopt : std::optional(static_cast<std::uint16_t>(port));
}

void StreamSource::close() {
  listening_ = FileDescriptor();
  waiting_.clear();
  localPort_ = 0;
}

std::string StreamSource::placeText() const {
  const auto port = localPort();
  return port ? NetworkPlace{place_.address, *port}.text() : std::string();
}

std::unique_ptr<ByteChannel> StreamSource::open() {
  switch (kind_) {
    case Kind::kListen:
      return acceptSender();
    case Kind::kUdp:
      return openUdp();
    case Kind::kInput:
      return openInput();
    case Kind::kPort:
      break;
  }
  return openPort();
}

std::unique_ptr<ByteChannel> StreamSource::openPort() {
  // A replugged port may get another number, but its name under /dev/serial/by-id stays the same.
  ChannelOptions options;
  options.baud = baud_;
  auto channel = openChannel(stableName_.empty() ? name_ : stableName_, options);
  if (stableName_.empty()) stableName_ = stableNameOf(name_);
  return channel;
}

std::unique_ptr<ByteChannel> StreamSource::openInput() {
  if (std::exchange(inputOpened_, true)) {
    ended_ = true;
    throw DeviceError(DeviceFault::kDisconnected, name_, "standard input has ended");
  }
  FileDescriptor input(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0));
  if (input.get() < 0) throw DeviceError(DeviceFault::kNotFound, name_, "standard input is closed");
  return std::make_unique<InputChannel>(name_, std::move(input));
}

FileDescriptor StreamSource::boundSocket(int type) {
  NetworkPlace bound = place_;
  FileDescriptor fd = listenAt(bound, name_, type, kBacklog);
  if (type == SOCK_DGRAM)
    ::setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &kUdpBufferBytes, sizeof kUdpBufferBytes);
  localPort_ = bound.port;
  return fd;
}

std::unique_ptr<ByteChannel> StreamSource::openUdp() {
  return std::make_unique<UdpChannel>(*this, boundSocket(SOCK_DGRAM));
}

// Takes the newest sender that sends, or else the one that waits longest.
std::unique_ptr<ByteChannel> StreamSource::acceptSender() {
  holder_.clear();
  if (listening_.get() < 0) listening_ = boundSocket(SOCK_STREAM);
  nextAcceptUs_ = 0;
  acceptWaiting();
  std::erase_if(waiting_, [](const Waiting& each) { return !hasSent(each.connection); });
  if (waiting_.empty())
    throw DeviceError(
        DeviceFault::kNotFound, name_, "no sender is connected; waiting at " + placeText());
  auto chosen = std::find_if(waiting_.rbegin(), waiting_.rend(), [](const Waiting& each) {
    return hasSent(each.connection).value_or(false);
  });
  if (chosen == waiting_.rend()) chosen = std::prev(waiting_.rend());
  Waiting sender = std::move(*chosen);
  waiting_.erase(std::prev(chosen.base()));
  holder_ = sender.peer;
  waitedUs_ = clock_.monotonicUs() - sender.sinceUs;
  return std::make_unique<ListenedChannel>(
      *this, TcpChannel::accepted(name_, std::move(sender.connection)));
}

void StreamSource::acceptWaiting() {
  const std::int64_t nowUs = clock_.monotonicUs();
  if (nowUs < nextAcceptUs_) return;
  nextAcceptUs_ = nowUs + kAcceptEveryUs;
  for (;;) {
    SocketAddress peer;
    FileDescriptor sender(
        ::accept4(listening_.get(), peer.get(), &peer.size, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (sender.get() < 0) return;
    if (waiting_.size() == kMaxWaiting) makeRoom();
    waiting_.push_back({std::move(sender), peer.place().text(), nowUs});
    if (!holder_.empty())
      remark(nextRemarkUs_,
             waiting_.back().peer + " is connected, too, and waits: " + holderText());
  }
}

// Forgets those that closed their connection and sent nothing, or else the sender that waits
// longest.
void StreamSource::makeRoom() {
  std::erase_if(waiting_, [](const Waiting& each) { return !hasSent(each.connection); });
  if (waiting_.size() < kMaxWaiting) return;
  ++numDropped_;
  remark(nextDropRemarkUs_,
         counted(numDropped_, "sender") + " lost the connection while waiting, at last " +
             waiting_.front().peer + ": only " + std::to_string(kMaxWaiting) +
             " can wait; what was sent is not read");
  waiting_.erase(waiting_.begin());
}

bool StreamSource::someWaitingSends() {
  return std::ranges::any_of(
      waiting_, [](const Waiting& each) { return hasSent(each.connection).value_or(false); });
}

std::string StreamSource::holderText() const {
  return holder_.empty() ? std::string() : holder_ + " holds the port";
}

// Two senders are told by the first one coming back soon after the second one sent.
void StreamSource::noteDatagramFrom(const std::string& sender) {
  if (sender == sender_) return;
  const std::int64_t nowUs = clock_.monotonicUs();
  if (sender == otherSender_ && nowUs - otherSenderUs_ < kOtherSenderUs)
    remark(nextRemarkUs_,
           "two senders use the port, " + sender_ + " and " + sender +
               ": their frames are mixed; stop one of them");
  otherSender_ = std::exchange(sender_, sender);
  otherSenderUs_ = nowUs;
}

// One remark of a kind in ten seconds; several at the same time are one text.
void StreamSource::remark(std::int64_t& nextUs, const std::string& text) {
  const std::int64_t nowUs = clock_.monotonicUs();
  if (nowUs < nextUs) return;
  nextUs = nowUs + kRemarkEveryUs;
  remark_ += (remark_.empty() ? "" : "; ") + text;
}

}  // namespace palpate
