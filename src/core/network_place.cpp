#include "palpate/core/network_place.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

static_assert(sizeof(sockaddr_storage) == sizeof(SocketAddress::storage));

bool isV4(const SocketAddress& address) { return address.get()->sa_family == AF_INET; }

[[noreturn]] void failToListen(const NetworkPlace& place, const std::string& name, int error) {
  if (error == EADDRINUSE)
    throw DeviceError(DeviceFault::kBusy, name, "another program uses this port; name another one");
  if (error == EACCES)
    throw DeviceError(
        DeviceFault::kNoPermission, name, "no permission for this port; name one above 1023");
  if (error == EADDRNOTAVAIL)
    throw DeviceError(
        DeviceFault::kNotFound, name, "this machine does not have the address " + place.address);
  throw DeviceError(DeviceFault::kNotFound,
                    name,
                    "can't be opened (" + std::generic_category().message(error) + ")");
}

}  // namespace

std::string NetworkPlace::text() const {
  const bool isV6 = address.find(':') != std::string::npos;
  return (isV6 ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

bool NetworkPlace::isOpenToOthers() const {
  const auto found = socketAddressOf(*this);
  if (!found) return true;
  if (isV4(*found)) return !address.starts_with("127.");
  const in6_addr& bytes = reinterpret_cast<const sockaddr_in6*>(&found->storage)->sin6_addr;
  return !IN6_IS_ADDR_LOOPBACK(&bytes) &&
         !(IN6_IS_ADDR_V4MAPPED(&bytes) && bytes.s6_addr[12] == 127);
}

std::optional<NetworkPlace> networkPlaceOf(const std::string& text) {
  NetworkPlace place;
  const std::size_t colon = text.rfind(':');
  const auto port = parseInteger(colon == std::string::npos ? text : text.substr(colon + 1));
  if (!port || *port < 0 || *port > UINT16_MAX) return std::nullopt;
  place.port = static_cast<std::uint16_t>(*port);
  if (colon != std::string::npos) place.address = text.substr(0, colon);
  if (place.address.size() > 2 && place.address.front() == '[' && place.address.back() == ']')
    place.address = place.address.substr(1, place.address.size() - 2);
  return socketAddressOf(place) ? std::optional(place) : std::nullopt;
}

NetworkPlace SocketAddress::place() const {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (::getnameinfo(get(),
                    size,
                    host.data(),
                    host.size(),
                    port.data(),
                    port.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return {};
  return {host.data(), static_cast<std::uint16_t>(parseInteger(port.data()).value_or(0))};
}

std::optional<SocketAddress> socketAddressOf(const NetworkPlace& place) {
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (::getaddrinfo(place.address.c_str(), std::to_string(place.port).c_str(), &hints, &found) != 0)
    return std::nullopt;
  SocketAddress address;
  address.size = found->ai_addrlen;
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  ::freeaddrinfo(found);
  // The system takes "1" for 0.0.0.1, too.
  if (isV4(address) && address.place().address != place.address) return std::nullopt;
  return address;
}

FileDescriptor listenAt(NetworkPlace& place, const std::string& name, int type, int backlog) {
  auto address = socketAddressOf(place);
  if (!address)
    throw std::invalid_argument("'" + shortened(place.address) +
                                "' is not a numeric address; name one such as 127.0.0.1 or ::1");
  FileDescriptor fd(::socket(address->get()->sa_family, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  if (fd.get() >= 0 && type == SOCK_STREAM)
    ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (fd.get() < 0 || ::bind(fd.get(), address->get(), address->size) != 0 ||
      (type == SOCK_STREAM && ::listen(fd.get(), backlog) != 0) ||
      ::getsockname(fd.get(), address->get(), &address->size) != 0)
    failToListen(place, name, errno);
  place.port = address->place().port;
  return fd;
}

}  // namespace palpate
