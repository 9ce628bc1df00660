// Where programs listen and send on a network: a numeric address and a port. One rule for all of
// them: what Palpate chooses by itself is 127.0.0.1, which no other machine reaches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <palpate/core/file_descriptor.h>

struct sockaddr;

namespace palpate {

struct NetworkPlace {
  std::string address = "127.0.0.1";  // IPv4 or IPv6, numeric, without brackets
  std::uint16_t port = 0;             // 0, to listen: a free one

  std::string text() const;  // "127.0.0.1:9871", "[::1]:9871"
  // Whether other machines can reach it; true for what is not a numeric address.
  bool isOpenToOthers() const;
};

// "[ADDRESS:]PORT", for example "9871", "0.0.0.0:9871", "[::1]:0"; nullopt: the text is not one.
std::optional<NetworkPlace> networkPlaceOf(const std::string& text);
// What users are told of such a text.
inline constexpr const char* kNetworkPlaceRule =
    "ADDRESS is numeric, PORT 0..65535 (0: a free one)";

// A place as the system has it; without one, room for any: a sockaddr_storage and its socklen_t.
struct SocketAddress {
  alignas(8) std::array<std::byte, 128> storage{};
  unsigned size = 128;

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  NetworkPlace place() const;
};
// nullopt: the address is not numeric.
std::optional<SocketAddress> socketAddressOf(const NetworkPlace& place);

// A socket (`type`: SOCK_STREAM, SOCK_DGRAM) that is bound to the place, does not block, is closed
// in child processes, and listens unless it is for datagrams. Sets the port where it was 0. Throws
// DeviceError with `name`, std::invalid_argument (the address is not numeric).
FileDescriptor listenAt(NetworkPlace& place, const std::string& name, int type, int backlog = 0);

}  // namespace palpate
