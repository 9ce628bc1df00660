// Fake device on a pty: a thread that answers the bytes written to it.
#pragma once

#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "device/pty_pair.h"

namespace palpate::testing {

class PtyServer {
 public:
  // `answer` is called in the server's thread, one call at a time.
  explicit PtyServer(std::function<Bytes(const Bytes&)> answer)
      : answer_(std::move(answer)), thread_([this](std::stop_token stop) { serve(stop); }) {}

  const std::string& path() const noexcept { return pty_.path(); }
  // Calls `access` between two answers.
  void between(const std::function<void()>& access) {
    const std::scoped_lock lock(mutex_);
    access();
  }
  // Writes bytes that are not an answer.
  void send(const Bytes& bytes) { pty_.send(bytes); }
  // Ends the device: a program that has the other end open sees a hang-up.
  void unplug() {
    thread_.request_stop();
    thread_.join();
    pty_.unplug();
  }

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const Bytes request = pty_.receive(2);
      if (request.empty()) continue;
      const std::scoped_lock lock(mutex_);
      const Bytes answer = answer_(request);
      if (!answer.empty()) pty_.send(answer);
    }
  }

  PtyPair pty_;
  std::mutex mutex_;
  std::function<Bytes(const Bytes&)> answer_;
  std::jthread thread_;
};

}  // namespace palpate::testing
