// Pseudo-terminal for tests: the test uses one end, the tested code opens the other by its path.
#pragma once

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

namespace palpate::testing {

using Bytes = std::vector<std::byte>;

inline Bytes textBytes(std::string_view text) {
  Bytes bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

class PtyPair {
 public:
  PtyPair() {
    char name[128] = {};
    if (::openpty(&master_, &slave_, name, nullptr, nullptr) != 0)
      throw std::runtime_error("openpty failed");
    path_ = name;
    for (const int fd : {master_, slave_}) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    termios settings{};
    ::tcgetattr(slave_, &settings);
    ::cfmakeraw(&settings);  // otherwise our own output is echoed until the other end is open
    ::tcsetattr(slave_, TCSANOW, &settings);
  }
  ~PtyPair() { unplug(); }
  PtyPair(const PtyPair&) = delete;
  PtyPair& operator=(const PtyPair&) = delete;

  const std::string& path() const noexcept { return path_; }
  int master() const noexcept { return master_; }
  int slave() const noexcept { return slave_; }

  // Closes the port: the other end sees a hang-up.
  void unplug() {
    for (int* fd : {&slave_, &master_}) {
      if (*fd >= 0) ::close(*fd);
      *fd = -1;
    }
  }

  void send(const Bytes& bytes) {
    if (::write(master_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      throw std::runtime_error("the pty took not all bytes");
  }

  // Waits up to `timeoutMs` for bytes, and returns those that arrived.
  Bytes receive(int timeoutMs) {
    pollfd wait{master_, POLLIN, 0};
    if (::poll(&wait, 1, timeoutMs) <= 0) return {};
    Bytes bytes(4096);
    const ssize_t got = ::read(master_, bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }
  // Reads exactly `count` bytes, or fewer after `timeoutMs` without any.
  Bytes receive(std::size_t count, int timeoutMs) {
    Bytes all;
    while (all.size() < count) {
      const Bytes piece = receive(timeoutMs);
      if (piece.empty()) break;
      all.insert(all.end(), piece.begin(), piece.end());
    }
    return all;
  }

 private:
  int master_ = -1;
  int slave_ = -1;
  std::string path_;
};

inline std::size_t openDescriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    ++count;
  return count;
}

}  // namespace palpate::testing
