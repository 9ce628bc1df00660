// Holds the readings of files before they begin, as a network folder that doesn't answer does.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>

#include <gtest/gtest.h>

#include "gui/source/file_reading.h"

namespace palpate::gui {

class HeldReadings {
 public:
  // The first `count` of them; others pass.
  explicit HeldReadings(std::size_t count = SIZE_MAX) {
    FileReading::setGate([state = state_, count] {
      std::unique_lock guard(state->mutex);
      if (state->arrived++ >= count) return;
      state->changed.notify_all();
      state->changed.wait(guard, [&] { return state->open; });
    });
  }
  ~HeldReadings() {
    release();
    FileReading::setGate({});
  }
  HeldReadings(const HeldReadings&) = delete;
  HeldReadings& operator=(const HeldReadings&) = delete;

  // Waits until so many have begun.
  void await(std::size_t count) {
    std::unique_lock guard(state_->mutex);
    EXPECT_TRUE(state_->changed.wait_for(
        guard, std::chrono::seconds(20), [&] { return state_->arrived >= count; }));
  }
  std::size_t arrived() const {
    const std::lock_guard guard(state_->mutex);
    return state_->arrived;
  }
  // Lets all go on, and waits until their threads are over; answers are under way then.
  void release() {
    {
      const std::lock_guard guard(state_->mutex);
      state_->open = true;
      state_->changed.notify_all();
    }
    EXPECT_TRUE(FileReading::awaitThreads(std::chrono::seconds(20)));
  }

 private:
  struct State {
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t arrived = 0;
    bool open = false;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace palpate::gui
