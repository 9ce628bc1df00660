#include "palpate/interop/datagram_sender.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/network_place.h"

namespace palpate {

DatagramSender::DatagramSender(std::uint16_t port) {
  if (port == 0) throw std::invalid_argument("DatagramSender: port must be 1..65535");
  const NetworkPlace place{.port = port};  // on this machine
  const auto address = socketAddressOf(place);
  socket_ = FileDescriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // On a connected socket the system reports datagrams without a receiver.
  if (address && socket_.get() >= 0 && ::connect(socket_.get(), address->get(), address->size) == 0)
    return;
  const int error = errno;
  throw DeviceError(DeviceFault::kDisconnected,
                    "udp:" + place.text(),
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
