// Stop pressed at random moments (R18): whatever the two ports are doing, it is on the wire within 20 ms.
#pragma once

#include <algorithm>
#include <cstdio>
#include <random>

#include "control/emulated_bench.h"

namespace palpate::testing {

// One grasp, stopped so long after its call. Time from the call of stop() to the arrival of the stop at the hand [us];
// nothing when something else ended the grasp before (a machine that stands still has no tactile stream).
class StopMoment {
 public:
  std::optional<std::int64_t> stopAfter(std::int64_t pressUs, const GraspRequest& request) {
    bench_.log.clear();
    if (!eventuallyTrue([&] { return bench_.control->status().cannotReact.empty(); })) return {};
    try {
      bench_.control->grasp(request);
    } catch (const DeviceError&) {
      return {};  // the stream again
    }
    const std::int64_t beganUs = systemClock().monotonicUs();
    // Precise to the moment: what is tested is the moment.
    while (systemClock().monotonicUs() - beganUs < pressUs)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    const std::int64_t pressedUs = systemClock().monotonicUs();
    bench_.control->stop();
    const auto report = bench_.awaitEnd();
    if (!report || report->outcome == GraspOutcome::kStreamDead) return {};
    // The way back may be so short that the hand is there already: a stop goes out all the same.
    EXPECT_TRUE(report->outcome == GraspOutcome::kStopped ||
                report->outcome == GraspOutcome::kFinished)
        << report->text;
    if (!eventuallyTrue([&] { return bench_.log.firstSince("stop", pressedUs).has_value(); })) {
      ADD_FAILURE() << "no stop came";
      return {};
    }
    const std::int64_t arrivedUs = bench_.log.firstSince("stop", pressedUs)->monoUs;
    // Nothing moves after it, and nothing sets it moving again.
    EXPECT_FALSE(bench_.handMoves());
    for (const ArrivedCommand& deed : bench_.log.deeds())
      EXPECT_LE(deed.monoUs, arrivedUs) << deed.name << " behind the stop";
    inMotion_ += !bench_.log.named("m").empty();
    stopped_ += report->outcome == GraspOutcome::kStopped;
    return arrivedUs - pressedUs;
  }
  void connect() { bench_.connect(); }
  int inMotion() const noexcept { return inMotion_; }
  int stopped() const noexcept { return stopped_; }

 private:
  EmulatedBench bench_{stillHand()};  // lines at 115200 baud, answers after 2 to 3 ms
  int inMotion_ = 0;
  int stopped_ = 0;
};

inline void stopAtRandomMoments(int moments, std::int64_t latestUs) {
  constexpr std::int64_t kLimitUs = 20'000;
  constexpr int kTries = 6;
  StopMoment moment;
  moment.connect();
  std::mt19937 random(18);
  std::vector<std::int64_t> latencies;
  int again = 0;
  for (int i = 0; i < moments; ++i) {
    const auto pressUs = std::uniform_int_distribution<std::int64_t>(0, latestUs)(random);
    int turn = i;
    const Timely timely = inTime(kLimitUs, kTries, [&] {
      GraspRequest request = i % 3 == 0 ? reactiveGrasp() : GraspRequest{};
      request.velocityDegPerS = 20.0;
      request.closeRatio = turn++ % 2 == 0 ? 1.0 : 0.0;
      return moment.stopAfter(pressUs, request);
    });
    ASSERT_TRUE(timely.bestUs.has_value()) << "moment " << i;
    EXPECT_LE(*timely.bestUs, kLimitUs)
        << "moment " << i << ", pressed " << pressUs << " us after the grasp began";
    latencies.push_back(*timely.bestUs);
    again += timely.tries - 1;
  }
  std::sort(latencies.begin(), latencies.end());
  std::printf(
      "stop on the wire, %d moments (%d in a motion): median %.2f ms, worst %.2f ms; "
      "%d tried again\n",
      moments,
      moment.inMotion(),
      static_cast<double>(latencies[latencies.size() / 2]) / 1e3,
      static_cast<double>(latencies.back()) / 1e3,
      again);
  EXPECT_GT(moment.stopped(), moments * 3 / 4);
  EXPECT_GT(moment.inMotion(), moments / 2);
}

}  // namespace palpate::testing
