// Stop pressed at random moments (R18): whatever the two ports are doing, it is on the wire within 20 ms.
#pragma once

#include <algorithm>
#include <cstdio>
#include <random>

#include "control/emulated_bench.h"

namespace palpate::testing {

inline void stopAtRandomMoments(int moments, std::int64_t latestUs) {
  constexpr std::int64_t kLimitUs = 20'000;
  EmulatedBench bench(stillHand());  // lines at 115200 baud, answers after 2 to 3 ms
  bench.connect();
  std::mt19937 random(18);
  std::vector<std::int64_t> latencies;
  std::size_t motions = 0, stopped = 0;
  for (int i = 0; i < moments; ++i) {
    GraspRequest request = i % 3 == 0 ? reactiveGrasp(200, 20.0) : GraspRequest{};
    request.velocityDegPerS = 20.0;
    request.closeRatio = i % 2 == 0 ? 1.0 : 0.0;
    const auto pressUs = std::uniform_int_distribution<std::int64_t>(0, latestUs)(random);
    ASSERT_NO_THROW(bench.control->grasp(request));
    const std::int64_t beganUs = systemClock().monotonicUs();
    // Precise to the moment: what is tested is the moment.
    while (systemClock().monotonicUs() - beganUs < pressUs)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    const std::int64_t pressedUs = systemClock().monotonicUs();
    bench.control->stop();
    const auto report = bench.awaitEnd();
    ASSERT_TRUE(report.has_value()) << "moment " << i;
    // The way back may be so short that the hand is there already: a stop goes out all the same.
    EXPECT_TRUE(report->outcome == GraspOutcome::kStopped ||
                report->outcome == GraspOutcome::kFinished)
        << "moment " << i << ": " << report->text;
    stopped += report->outcome == GraspOutcome::kStopped;
    ASSERT_TRUE(eventuallyTrue([&] { return bench.log.firstSince("stop", pressedUs).has_value(); }))
        << "moment " << i;
    const auto stop = bench.log.firstSince("stop", pressedUs);
    latencies.push_back(stop->monoUs - pressedUs);
    EXPECT_LE(latencies.back(), kLimitUs + bench.load.withheldUs(pressedUs, stop->monoUs))
        << "moment " << i << ", pressed " << pressUs << " us after the grasp began";
    // Nothing moves after it, and nothing sets it moving again.
    EXPECT_FALSE(bench.handMoves()) << "moment " << i;
    for (const ArrivedCommand& deed : bench.log.deeds())
      EXPECT_LT(deed.monoUs, stop->monoUs) << deed.name << " behind the stop, moment " << i;
    motions += bench.log.named("m").size();
    bench.log.clear();
  }
  std::sort(latencies.begin(), latencies.end());
  std::printf("stop on the wire, %d moments (%zu in a motion): median %.2f ms, worst %.2f ms\n",
              moments,
              motions,
              static_cast<double>(latencies[latencies.size() / 2]) / 1e3,
              static_cast<double>(latencies.back()) / 1e3);
  EXPECT_GT(stopped, static_cast<std::size_t>(moments) * 3 / 4);
  EXPECT_GT(motions, static_cast<std::size_t>(moments) / 2);
}

}  // namespace palpate::testing
