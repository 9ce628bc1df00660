// A WebSocket client of a few lines, written from RFC 6455 alone, for the tests of interop: it
// shares no code with the server.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace palpate::testing {

struct WebSocketFrame {
  int opcode = 0;  // 1 text, 2 binary, 8 close, 9 ping
  std::string payload;
};

class WebSocketClient {
 public:
  // `receiveBytes`: size of the system's receive buffer; 0: the usual one.
  explicit WebSocketClient(std::uint16_t port, int receiveBytes = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receiveBytes > 0)
      ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receiveBytes, sizeof receiveBytes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ =
        ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~WebSocketClient() { close(); }
  WebSocketClient(const WebSocketClient&) = delete;
  WebSocketClient& operator=(const WebSocketClient&) = delete;

  bool connected() const { return connected_; }
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  bool send(const std::string& bytes) const {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return false;
      sent += static_cast<std::size_t>(n);
    }
    return true;
  }

  static std::string request(const std::string& protocols, const std::string& more = {}) {
    return "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
           (protocols.empty() ? std::string() : "Sec-WebSocket-Protocol: " + protocols + "\r\n") +
           more + "\r\n";
  }
  // The head of the answer, "HTTP/1.1 101 ..", and its text where it has one; empty when the
  // connection ends before.
  std::string handshake(const std::string& text) {
    send(text);
    while (head_.empty() && receive())
      if (const std::size_t end = bytes_.find("\r\n\r\n"); end != std::string::npos) {
        head_ = bytes_.substr(0, end);
        bytes_.erase(0, end + 4);
      }
    if (head_.find(" 101 ") == std::string::npos)
      while (receive()) {
      }
    return head_ + (head_.find(" 101 ") == std::string::npos ? bytes_ : std::string());
  }
  bool join(const std::string& protocols = "foxglove.websocket.v1") {
    return handshake(request(protocols)).find(" 101 ") != std::string::npos;
  }

  // The next frame, pings apart, which it answers; nothing at the end of the connection, or when no
  // byte arrives for this time.
  std::optional<WebSocketFrame> frame(int limitMs = 20'000) {
    while (true) {
      if (auto found = takeFrame()) {
        if (found->opcode != 9) return found;
        send(masked(0x8A, found->payload));
      } else if (!receive(limitMs)) {
        return std::nullopt;
      }
    }
  }
  // Waits until the other end closes the connection.
  bool awaitEnd() {
    while (receive()) bytes_.clear();
    return ended_;
  }

  // Clients mask what they send.
  static std::string masked(int firstByte, const std::string& payload) {
    std::string bytes(1, static_cast<char>(firstByte));
    if (payload.size() < 126) {
      bytes += static_cast<char>(0x80 | payload.size());
    } else if (payload.size() < 65'536) {
      bytes += static_cast<char>(0x80 | 126);
      for (int shift : {8, 0}) bytes += static_cast<char>(payload.size() >> shift & 0xFF);
    } else {
      bytes += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8)
        bytes += static_cast<char>(static_cast<std::uint64_t>(payload.size()) >> shift & 0xFF);
    }
    const std::string mask = "\x11\x22\x33\x44";
    bytes += mask;
    for (std::size_t i = 0; i < payload.size(); ++i)
      bytes += static_cast<char>(payload[i] ^ mask[i % 4]);
    return bytes;
  }
  bool say(const std::string& text) const { return send(masked(0x81, text)); }

 private:
  bool receive(int limitMs = 20'000) {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, limitMs) != 1) return false;
    char piece[65'536];
    const ssize_t n = ::recv(socket_, piece, sizeof piece, 0);
    if (n <= 0) {
      ended_ = true;
      return false;
    }
    bytes_.append(piece, static_cast<std::size_t>(n));
    return true;
  }
  std::optional<WebSocketFrame> takeFrame() {
    const auto at = [this](std::size_t i) { return static_cast<unsigned char>(bytes_[i]); };
    if (bytes_.size() < 2) return std::nullopt;
    std::size_t head = 2;
    std::uint64_t size = at(1) & 0x7F;
    const int more = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (more > 0) {
      if (bytes_.size() < 2 + static_cast<std::size_t>(more)) return std::nullopt;
      size = 0;
      for (int i = 0; i < more; ++i) size = size << 8 | at(head++);
    }
    if (bytes_.size() < head + size) return std::nullopt;
    WebSocketFrame found{at(0) & 0xF, bytes_.substr(head, size)};
    bytes_.erase(0, head + size);
    return found;
  }

  int socket_;
  bool connected_ = false;
  bool ended_ = false;
  std::string head_, bytes_;
};

}  // namespace palpate::testing
