// A sender of a series for `palpate record --series NAME=tcp:..`: each connection gets a header and
// rows "n,-2n" from 1 on, and when a row was sent is kept.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include "palpate/core/file_descriptor.h"
#include "palpate/core/time.h"

namespace palpate::testing {

class NumberedSeries {
 public:
  NumberedSeries(std::string name, double hz)
      : name_(std::move(name)),
        period_(std::chrono::microseconds(static_cast<int>(1e6 / hz))),
        listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&place), size) != 0 ||
        ::listen(listener_.get(), 4) != 0 ||
        ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&place), &size) != 0)
      throw std::runtime_error("no port for a series");
    port_ = ntohs(place.sin_port);
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  const std::string& name() const noexcept { return name_; }
  std::string option() const { return name_ + "=tcp:127.0.0.1:" + std::to_string(port_); }
  // When each row of the last connection was sent [us since 1970]; the first one is number 1.
  std::vector<std::int64_t> sentUs() const {
    const std::lock_guard lock(mutex_);
    return sentUs_;
  }

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd waiting{listener_.get(), POLLIN, 0};
      if (::poll(&waiting, 1, 50) != 1) continue;
      const FileDescriptor peer(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
      if (peer.get() >= 0) sendRows(peer.get(), stop);
    }
  }
  void sendRows(int peer, const std::stop_token& stop) {
    {
      const std::lock_guard lock(mutex_);
      sentUs_.clear();
    }
    const auto sends = [&](std::string_view text) {
      return ::send(peer, text.data(), text.size(), MSG_NOSIGNAL) ==
             static_cast<ssize_t>(text.size());
    };
    if (!sends("n,m[N]\n")) return;
    auto due = std::chrono::steady_clock::now();
    for (std::int64_t n = 1; !stop.stop_requested(); ++n) {
      const std::int64_t nowUs = systemClock().wallUs();
      if (!sends(std::to_string(n) + "," + std::to_string(-2 * n) + "\n")) return;
      {
        const std::lock_guard lock(mutex_);
        sentUs_.push_back(nowUs);
      }
      std::this_thread::sleep_until(due += period_);
    }
  }

  const std::string name_;
  const std::chrono::microseconds period_;
  FileDescriptor listener_;
  std::uint16_t port_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::int64_t> sentUs_;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace palpate::testing
