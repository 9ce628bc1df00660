#include "palpate/interop/datagram_sender.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "palpate/core/error.h"

namespace palpate {

DatagramSender::DatagramSender(std::uint16_t port) : port_(port) {
  if (port == 0) throw std::invalid_argument("DatagramSender: port must be 1..65535");
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socket_ = FileDescriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // On a connected socket the system reports datagrams without a receiver.
  if (socket_.get() >= 0 &&
      ::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    return;
  const int error = errno;
  throw DeviceError(DeviceFault::kDisconnected,
                    "udp:127.0.0.1:" + std::to_string(port),
                    std::string("can't send: ") + std::strerror(error));
}

bool DatagramSender::send(std::string_view bytes) noexcept {
  const ssize_t taken =
      ::send(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (taken < 0 && errno == ECONNREFUSED && stats_.sent > stats_.unheard) ++stats_.unheard;
  stats_.delivered = taken >= 0 && lastTaken_;
  lastTaken_ = taken >= 0;
  ++(taken >= 0 ? stats_.sent : stats_.dropped);
  return taken >= 0;
}

}  // namespace palpate
