// Client of a local socket that can break the protocol in every way that a test needs.
#pragma once

#include <chrono>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "testing/awaited.h"

namespace palpate::testing {

class RawClient {
 public:
  explicit RawClient(const std::filesystem::path& path)
      : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    connected_ =
        ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawClient() { close(); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool connected() const noexcept { return connected_; }
  // Returns how many bytes were accepted; waits at most limitMs for room.
  std::size_t send(std::string_view bytes, int limitMs = 0) const {
    pollfd waiting{socket_, POLLOUT, 0};
    ::poll(&waiting, 1, limitMs);
    const ssize_t n = ::send(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    return n < 0 ? 0 : static_cast<std::size_t>(n);
  }
  // The next line without its end; nothing if none arrives within the limit or the server has gone.
  std::optional<std::string> line(int limitMs = 5000) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(limitMs);
    while (received_.find('\n') == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
                            end - std::chrono::steady_clock::now())
                            .count();
      pollfd waiting{socket_, POLLIN, 0};
      if (left <= 0 || ::poll(&waiting, 1, static_cast<int>(left)) != 1) return std::nullopt;
      char bytes[4096];
      const ssize_t n = ::recv(socket_, bytes, sizeof bytes, 0);
      if (n <= 0) return std::nullopt;
      received_.append(bytes, static_cast<std::size_t>(n));
    }
    const auto at = received_.find('\n');
    std::string line = received_.substr(0, at);
    received_.erase(0, at + 1);
    return line;
  }
  // Waits until the server closes the connection.
  bool ended(int limitMs = 5000) {
    while (line(limitMs)) {
    }
    char byte = 0;
    return ::recv(socket_, &byte, 1, MSG_DONTWAIT) == 0;
  }
  void endSending() const { ::shutdown(socket_, SHUT_WR); }
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

 private:
  int socket_;
  bool connected_ = false;
  std::string received_;
};

// Waits until the condition holds, at most ten seconds.
template <typename Condition>
bool soon(Condition&& condition) {
  return awaited(condition, std::chrono::seconds(10));
}

}  // namespace palpate::testing
