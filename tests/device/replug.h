// Tests of LiveHand with ports that are unplugged at any byte and plugged in again (reliability
// R8).
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/live_hand.h"
#include "palpate/emulator/emulated_hand.h"

#include "device/collecting_sink.h"
#include "emulator/numbered_hand.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::testing {

struct ReplugFigures {
  int cycles = 0;
  // Longest time from unplugging to the state "lost".
  double mostNoticedMs = 0.0;
  // Longest time from plugging in to the first frame and the first angles.
  double mostReturnMs = 0.0;
  std::uint64_t frames = 0;
};

class ReplugRun {
 public:
  explicit ReplugRun(unsigned seed)
      : random_(seed), hand_(std::make_unique<NumberedHand>(), withLinks(folder_)) {
    LiveHandOptions options;
    options.dsaPort = hand_.dsaPort();
    options.sdhPort = hand_.sdhPort();
    live_ = std::make_unique<LiveHand>(options);
    live_->start(sink_);
  }
  ~ReplugRun() { live_->stop(); }

  void cycle() {
    ASSERT_TRUE(awaitMore()) << stateText();
    std::this_thread::sleep_for(std::chrono::microseconds(random_() % 60'000));
    const std::size_t frames = sink_.numFrames();
    const std::size_t gaps = numGaps();
    auto from = Clock::now();
    hand_.unplug();
    ASSERT_TRUE(sink_.await([&] {
      const DeviceStatus status = live_->status();
      return status.tactile.state == PortState::kLost && status.motion->state == PortState::kLost;
    })) << stateText();
    figures_.mostNoticedMs = std::max(figures_.mostNoticedMs, since(from));
    std::this_thread::sleep_for(std::chrono::microseconds(random_() % 300'000));
    from = Clock::now();
    hand_.replug();
    ASSERT_TRUE(awaitMore()) << stateText();
    figures_.mostReturnMs = std::max(figures_.mostReturnMs, since(from));
    EXPECT_EQ(numGaps(), gaps + 1) << "the gap is recorded";
    EXPECT_GT(sink_.numFrames(), frames);
    ++figures_.cycles;
  }

  // Every received frame equals a sent one, once, in order.
  void checkFrames() {
    std::int64_t last = -1;
    for (const TactileFrame& frame : sink_.takeFrames()) {
      const auto number = NumberedHand::numberOf(frame.values);
      ASSERT_TRUE(number) << "a wrong frame";
      ASSERT_GT(static_cast<std::int64_t>(*number), last);
      last = static_cast<std::int64_t>(*number);
      ++figures_.frames;
    }
  }
  const ReplugFigures& figures() const noexcept { return figures_; }

 private:
  using Clock = std::chrono::steady_clock;
  static double since(Clock::time_point from) {
    return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
  }
  static EmulatedHandOptions withLinks(const TemporaryFolder& folder) {
    EmulatedHandOptions options;
    options.dsaPort = folder / "dsa";
    options.sdhPort = folder / "sdh";
    return options;
  }
  // Waits for one more frame and one more sample of the joint angles.
  bool awaitMore() {
    std::size_t frames = 0, angles = 0;
    sink_.await([&] {
      frames = sink_.frames.size();
      angles = sink_.angles.size();
      return true;
    });
    return sink_.await(
        [&] { return sink_.frames.size() > frames && sink_.angles.size() > angles; });
  }
  std::string stateText() const {
    const DeviceStatus status = live_->status();
    const auto text = [](const PortStatus& port) {
      return std::to_string(static_cast<int>(port.state)) + " " + std::to_string(port.items) +
             " items " + port.message + "; ";
    };
    return text(status.tactile) + text(*status.motion);
  }
  std::size_t numGaps() {
    std::size_t count = 0;
    for (const Event& event : sink_.takeEvents())
      if (event.kind == "gap") ++count;
    return count;
  }

  std::mt19937 random_;
  TemporaryFolder folder_;
  EmulatedHand hand_;
  CollectingSink sink_;
  std::unique_ptr<LiveHand> live_;
  ReplugFigures figures_;
};

inline ReplugFigures replugHands(int cycles, int hands) {
  std::vector<ReplugFigures> figures(static_cast<std::size_t>(hands));
  ProcessFacts warm, end;
  {
    std::vector<std::unique_ptr<ReplugRun>> runs;
    for (int h = 0; h < hands; ++h)
      runs.push_back(std::make_unique<ReplugRun>(static_cast<unsigned>(h) + 1));
    const auto all = [&](int each) {
      std::vector<std::jthread> workers;
      for (auto& run : runs)
        workers.emplace_back([&run, each] {
          for (int i = 0; i < each && !::testing::Test::HasFatalFailure(); ++i) run->cycle();
        });
    };
    all(1);
    warm = processFacts();
    all((cycles - hands) / hands);
    end = processFacts();
    for (int h = 0; h < hands; ++h) {
      runs[static_cast<std::size_t>(h)]->checkFrames();
      figures[static_cast<std::size_t>(h)] = runs[static_cast<std::size_t>(h)]->figures();
    }
  }
  EXPECT_EQ(end.descriptors, warm.descriptors);
  EXPECT_EQ(end.threads, warm.threads);
  ReplugFigures all;
  for (const ReplugFigures& one : figures) {
    all.cycles += one.cycles;
    all.frames += one.frames;
    all.mostNoticedMs = std::max(all.mostNoticedMs, one.mostNoticedMs);
    all.mostReturnMs = std::max(all.mostReturnMs, one.mostReturnMs);
  }
  std::printf(
      "%d cycles: noticed after %.0f ms at most, streaming %.0f ms after return at most; %llu "
      "frames, none wrong or twice; descriptors %zu -> %zu, threads %zu -> %zu\n",
      all.cycles,
      all.mostNoticedMs,
      all.mostReturnMs,
      static_cast<unsigned long long>(all.frames),
      warm.descriptors,
      end.descriptors,
      warm.threads,
      end.threads);
  return all;
}

}  // namespace palpate::testing
