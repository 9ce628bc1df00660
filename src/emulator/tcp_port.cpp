// The TCP port behind openTcpPort(), and openPortServer(), which chooses the kind of port.
#include <cerrno>
#include <stdexcept>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include "palpate/core/escaped_line.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/network_place.h"
#include "palpate/core/number_text.h"
#include "palpate/emulator/port_server.h"

namespace palpate {
namespace {

class TcpPort final : public PortServer {
 public:
  explicit TcpPort(std::uint16_t port) : place_{.port = port} { plug(); }
  ~TcpPort() override { unplug(); }
  TcpPort(const TcpPort&) = delete;
  TcpPort& operator=(const TcpPort&) = delete;

  const std::string& name() const noexcept override { return name_; }
  bool isNetwork() const noexcept override { return true; }
  int descriptor() const noexcept override {
    return client_.get() >= 0 ? client_.get() : listener_.get();
  }
  bool connected() const noexcept override { return client_.get() >= 0; }

  std::size_t read(std::span<std::byte> into) override {
    if (client_.get() < 0) accept();
    if (client_.get() < 0) return 0;
    const ssize_t n = ::recv(client_.get(), into.data(), into.size(), MSG_DONTWAIT);
    if (n > 0) return static_cast<std::size_t>(n);
    if (n == 0 || !(errno == EAGAIN || errno == EINTR)) hangUp();
    return 0;
  }

  std::size_t write(std::span<const std::byte> bytes) override {
    if (client_.get() < 0) return 0;
    const ssize_t n =
        ::send(client_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (!(errno == EAGAIN || errno == EINTR)) hangUp();
    return 0;
  }

  void unplug() noexcept override {
    hangUp();
    listener_ = FileDescriptor();
  }

  void plug() override {
    if (listener_.get() >= 0) return;
    listener_ = listenAt(place_, "tcp:" + place_.text(), SOCK_STREAM, 1);
    name_ = "tcp:" + place_.text();
  }

 private:
  void accept() {
    client_ =
        FileDescriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    const int on = 1;
    if (client_.get() >= 0) ::setsockopt(client_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }

  void hangUp() noexcept { client_ = FileDescriptor(); }

  NetworkPlace place_;
  std::string name_;
  FileDescriptor listener_;
  FileDescriptor client_;
};

}  // namespace

std::unique_ptr<PortServer> openTcpPort(std::uint16_t port) {
  return std::make_unique<TcpPort>(port);
}

std::unique_ptr<PortServer> openPortServer(const std::string& where) {
  if (!where.starts_with("tcp:")) return openPtyPort(where);
  const std::size_t colon = where.rfind(':');
  const std::string host = colon > 4 ? where.substr(4, colon - 4) : std::string();
  const auto port = parseInteger(where.substr(colon + 1));
  if ((host != "127.0.0.1" && host != "localhost") || !port || *port < 0 || *port > 65'535)
    throw std::invalid_argument(
        "'" + shortened(where) +
        "' isn't a port of this machine: tcp:127.0.0.1:PORT, PORT 0..65535");
  return openTcpPort(static_cast<std::uint16_t>(*port));
}

}  // namespace palpate
