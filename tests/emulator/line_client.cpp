#include "emulator/line_client.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

namespace palpate::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

milliseconds leftUntil(steady_clock::time_point end) {
  return std::max(milliseconds(0), std::chrono::ceil<milliseconds>(end - steady_clock::now()));
}

int openTty(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  termios settings{};
  if (::tcgetattr(descriptor, &settings) != 0) throw std::runtime_error(path + " is no terminal");
  // The same settings as in the vendor's library.
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXON | IXOFF | ICRNL | ISTRIP);
  settings.c_oflag &= ~static_cast<tcflag_t>(OPOST);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  ::cfsetspeed(&settings, B115200);
  ::tcsetattr(descriptor, TCSANOW, &settings);
  return descriptor;
}

int openTcp(const std::string& port) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port.substr(port.rfind(':') + 1))));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error(port + ": " + std::strerror(errno));
  ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
  return descriptor;
}

}  // namespace

Octets octets(const std::string& hex) {
  Octets bytes;
  std::istringstream words(hex);
  for (std::string word; words >> word;) {
    if (word == "|") continue;
    const std::size_t times = word.find('x');
    const int count = times == std::string::npos ? 1 : std::stoi(word.substr(times + 1));
    const std::string digits = word.substr(0, times);
    Octets one;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
      one.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    for (int i = 0; i < count; ++i) bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}

std::string hexText(const Octets& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    if (!text.empty()) text += ' ';
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

// The definition: a left-shifting remainder of each byte, applied to a right-shifting register.
std::uint16_t bitwiseChecksum(const Octets& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    unsigned remainder = ((crc ^ byte) & 0xFFu) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (remainder & 0x8000u) != 0;
      remainder = (remainder << 1) & 0xFFFFu;
      if (carry) remainder ^= 0x1021u;
    }
    crc = crc >> 8 ^ remainder;
  }
  return static_cast<std::uint16_t>(crc);
}

Octets tactilePacket(std::uint8_t id, const Octets& payload) {
  Octets packet(6 + payload.size(), 0xAA);
  packet[3] = id;
  packet[4] = static_cast<std::uint8_t>(payload.size() & 0xFF);
  packet[5] = static_cast<std::uint8_t>(payload.size() >> 8);
  std::copy(payload.begin(), payload.end(), packet.begin() + 6);
  if (payload.empty()) return packet;
  const std::uint16_t crc = bitwiseChecksum(Octets(packet.begin() + 3, packet.end()));
  packet.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  packet.push_back(static_cast<std::uint8_t>(crc >> 8));
  return packet;
}

std::optional<DecodedFrame> decodeFramePayload(const Octets& payload) {
  constexpr std::size_t kTexels = 486;
  if (payload.size() < 5) return std::nullopt;
  DecodedFrame frame;
  for (int i = 3; i >= 0; --i) frame.deviceMs = frame.deviceMs << 8 | payload[std::size_t(i)];
  frame.runLength = (payload[4] & 1) != 0;
  frame.packetBytes = payload.size() + 8;
  for (std::size_t i = 5; i + 1 < payload.size(); i += 2) {
    const unsigned unit = payload[i] | unsigned{payload[i + 1]} << 8;
    const std::size_t run = frame.runLength ? unit >> 12 : 1;
    frame.values.insert(frame.values.end(), run, static_cast<std::uint16_t>(unit & 0x0FFF));
  }
  if (frame.values.size() != kTexels) return std::nullopt;
  return frame;
}

std::optional<TactilePacket> PacketScanner::next() {
  const auto drop = [&](std::size_t count) {
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(count));
    skipped += count;
  };
  for (;;) {
    std::size_t at = 0;
    while (at < pending_.size() && pending_[at] != 0xAA) ++at;
    if (at > 0) drop(at);
    if (pending_.size() < 6) return std::nullopt;
    const std::size_t length = pending_[4] | std::size_t{pending_[5]} << 8;
    if (pending_[1] != 0xAA || pending_[2] != 0xAA || pending_[3] == 0xAA || length > 977) {
      drop(1);
      continue;
    }
    const std::size_t total = 6 + length + (length > 0 ? 2 : 0);
    if (pending_.size() < total) return std::nullopt;
    const Octets body(pending_.begin() + 3, pending_.begin() + 6 + std::ptrdiff_t(length));
    const unsigned crc = length > 0 ? pending_[total - 2] | unsigned{pending_[total - 1]} << 8 : 0;
    if (length > 0 && bitwiseChecksum(body) != crc) {
      ++badChecksums;
      drop(1);
      continue;
    }
    TactilePacket packet{body[0], Octets(body.begin() + 3, body.end()), steady_clock::now()};
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(total));
    return packet;
  }
}

LineClient::LineClient(const std::string& port)
    : descriptor_(port.starts_with("tcp:") ? openTcp(port) : openTty(port)) {}

LineClient::~LineClient() { ::close(descriptor_); }

void LineClient::send(const Octets& bytes) {
  std::size_t sent = 0;
  const auto end = steady_clock::now() + std::chrono::seconds(20);
  while (sent < bytes.size()) {
    const ssize_t n = ::write(descriptor_, bytes.data() + sent, bytes.size() - sent);
    if (n > 0) sent += static_cast<std::size_t>(n);
    if (n > 0) continue;
    if (errno != EAGAIN) throw std::runtime_error(std::string("send: ") + std::strerror(errno));
    if (steady_clock::now() > end) throw std::runtime_error("the port takes nothing");
    // The answers must be read, or both sides would wait.
    pollfd polled{descriptor_, POLLIN | POLLOUT, 0};
    ::poll(&polled, 1, 100);
    if ((polled.revents & POLLIN) == 0) continue;
    const Octets more = receive(milliseconds(0));
    kept_.insert(kept_.end(), more.begin(), more.end());
  }
}

void LineClient::send(const std::string& text) { send(Octets(text.begin(), text.end())); }

Octets LineClient::receive(milliseconds timeout) {
  if (!kept_.empty() && timeout.count() > 0) return std::exchange(kept_, {});
  pollfd polled{descriptor_, POLLIN, 0};
  if (::poll(&polled, 1, static_cast<int>(timeout.count())) <= 0) return {};
  Octets bytes(65536);
  const ssize_t n = ::read(descriptor_, bytes.data(), bytes.size());
  if (n == 0 || (n < 0 && errno != EAGAIN)) hungUp_ = true;
  bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return bytes;
}

Octets LineClient::receiveExactly(std::size_t count, milliseconds timeout) {
  const auto end = steady_clock::now() + timeout;
  Octets bytes;
  while (bytes.size() < count && !hungUp_ && steady_clock::now() < end) {
    const Octets more = receive(std::max(leftUntil(end), milliseconds(1)));
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  if (bytes.size() > count) {
    kept_.assign(bytes.begin() + static_cast<std::ptrdiff_t>(count), bytes.end());
    bytes.resize(count);
  }
  return bytes;
}

std::optional<std::string> LineClient::receiveLine(milliseconds timeout) {
  const auto end = steady_clock::now() + timeout;
  std::string line;
  while (!line.ends_with("\r\n") && !hungUp_ && steady_clock::now() < end) {
    const Octets one = receiveExactly(1, std::max(leftUntil(end), milliseconds(1)));
    line.append(one.begin(), one.end());
  }
  if (!line.ends_with("\r\n")) return std::nullopt;
  return line.substr(0, line.size() - 2);
}

Octets LineClient::receiveUntilSilent(milliseconds silence) {
  Octets all;
  for (;;) {
    const Octets more = receive(silence);
    if (more.empty()) return all;
    all.insert(all.end(), more.begin(), more.end());
  }
}

std::optional<TactilePacket> LineClient::packet(milliseconds timeout) {
  const auto end = steady_clock::now() + timeout;
  for (;;) {
    if (auto packet = scanner_.next()) return packet;
    if (steady_clock::now() >= end || hungUp_) return std::nullopt;
    scanner_.feed(receive(std::max(leftUntil(end), milliseconds(1))));
  }
}

std::optional<TactilePacket> LineClient::answer(std::uint8_t id) {
  const auto end = steady_clock::now() + milliseconds(2000);
  while (steady_clock::now() < end)
    if (auto next = packet(std::max(leftUntil(end), milliseconds(1))); next && next->id == id)
      return next;
  return std::nullopt;
}

std::optional<Octets> LineClient::ask(std::uint8_t id, const Octets& payload) {
  send(tactilePacket(id, payload));
  const auto packet = answer(id);
  if (!packet) return std::nullopt;
  return packet->payload;
}

}  // namespace palpate::testing
