// Sink that stores the items of a device; await() waits for a condition with a deadline.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "palpate/device/device.h"

namespace palpate::testing {

class CollectingSink : public DeviceSink {
 public:
  void onFrame(TactileFrame&& frame) override {
    std::lock_guard lock(mutex_);
    frames.push_back(std::move(frame));
    changed_.notify_all();
  }
  void onSample(Sample&& sample) override {
    std::lock_guard lock(mutex_);
    (sample.series == kAngleSeries ? angles : temperatures).push_back(std::move(sample));
    changed_.notify_all();
  }
  void onEvent(Event&& event) override {
    std::lock_guard lock(mutex_);
    events.push_back(std::move(event));
    changed_.notify_all();
  }

  // Returns true once `condition` holds (called with the lock held), false when the time is over.
  bool await(const std::function<bool()>& condition,
             std::chrono::milliseconds limit = std::chrono::seconds(10)) {
    std::unique_lock lock(mutex_);
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition())
      if (changed_.wait_until(
              lock,
              std::min(end, std::chrono::steady_clock::now() + std::chrono::milliseconds(5))) ==
              std::cv_status::timeout &&
          std::chrono::steady_clock::now() >= end)
        return condition();
    return true;
  }
  bool awaitFrames(std::size_t count, std::chrono::milliseconds limit = std::chrono::seconds(10)) {
    return await([&] { return frames.size() >= count; }, limit);
  }
  std::size_t numFrames() {
    std::lock_guard lock(mutex_);
    return frames.size();
  }
  // These functions return copies and may be called while the device runs.
  std::vector<TactileFrame> takeFrames() {
    std::lock_guard lock(mutex_);
    return frames;
  }
  std::vector<Event> takeEvents() {
    std::lock_guard lock(mutex_);
    return events;
  }

  std::vector<TactileFrame> frames;
  std::vector<Sample> angles;
  std::vector<Sample> temperatures;
  std::vector<Event> events;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace palpate::testing
