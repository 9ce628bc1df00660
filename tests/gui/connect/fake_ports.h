// Ports that a test makes up: what is listed, and what answers when. No real port is touched.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "gui/connect/port_scan.h"

namespace palpate::gui {

inline PortInfo usbPort(const std::string& name, const std::string& stableName = {}) {
  return {.name = name,
          .stableName = stableName.empty() ? name : stableName,
          .description = "FT232R USB UART",
          .usb = true,
          .bluetooth = false,
          .readable = true,
          .writable = true};
}

inline PortProbe answering(PortAnswer answer, const std::string& message) {
  PortProbe probe;
  probe.answer = answer;
  probe.message = message;
  return probe;
}

// What the hand's controllers say.
inline PortProbe tactileAnswer() {
  return answering(PortAnswer::kTactile, "tactile controller, firmware 268, serial 1D9B0057");
}
inline PortProbe motionAnswer() {
  return answering(PortAnswer::kMotion, "motion controller, firmware 0.0.3.3, serial 48");
}

// Safe from several threads.
class FakePorts {
 public:
  PortScan::Functions functions() {
    return {[this] {
              const std::lock_guard lock(mutex_);
              return ports_;
            },
            [this](const std::string& port, const std::function<bool()>& isCancelled) {
              return probe(port, isCancelled);
            }};
  }
  // Without an answer it is a port that doesn't exist.
  void answer(const std::string& port, const PortProbe& probe) {
    const std::lock_guard lock(mutex_);
    answers_[port] = probe;
  }
  void list(std::vector<PortInfo> ports) {
    const std::lock_guard lock(mutex_);
    ports_ = std::move(ports);
  }
  // Says nothing until it is released, or (unless `stubborn`) given up.
  void hang(const std::string& port, bool stubborn = false) {
    const std::lock_guard lock(mutex_);
    hanging_[port] = stubborn;
  }
  void release(const std::string& port) {
    const std::lock_guard lock(mutex_);
    hanging_.erase(port);
    changed_.notify_all();
  }
  std::vector<std::string> asked() {
    const std::lock_guard lock(mutex_);
    return asked_;
  }
  int numOpen() {
    const std::lock_guard lock(mutex_);
    return numOpen_;
  }
  int mostOpen() {
    const std::lock_guard lock(mutex_);
    return mostOpen_;
  }
  ~FakePorts() {
    std::unique_lock lock(mutex_);
    hanging_.clear();
    changed_.notify_all();
    changed_.wait(lock, [this] { return numOpen_ == 0; });
  }

 private:
  PortProbe probe(const std::string& port, const std::function<bool()>& isCancelled) {
    std::unique_lock lock(mutex_);
    asked_.push_back(port);
    mostOpen_ = std::max(mostOpen_, ++numOpen_);
    while (hanging_.contains(port) && (hanging_[port] || !isCancelled()))
      changed_.wait_for(lock, std::chrono::milliseconds(5));
    --numOpen_;
    changed_.notify_all();
    const auto known = answers_.find(port);
    return known != answers_.end() ? known->second
                                   : answering(PortAnswer::kNotFound, "no such port");
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<PortInfo> ports_;
  std::map<std::string, PortProbe> answers_;
  std::map<std::string, bool> hanging_;
  std::vector<std::string> asked_;
  int numOpen_ = 0;
  int mostOpen_ = 0;
};

}  // namespace palpate::gui
