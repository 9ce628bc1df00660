// Tests stops at random times (R18): whatever the two ports are doing, the stop is sent within 20
// ms. Each stop is measured once.
#pragma once

#include <random>

#include "control/emulated_bench.h"
#include "testing/punctuality.h"

namespace palpate::testing {

// The stream is dead after 100 ms of silence; one period of the hand may have been on its way.
constexpr std::int64_t kStandstillThatKillsAStreamUs = 50'000;

class StopMoments {
 public:
  void connect() { bench_.connect(); }
  // Runs one grasp and stops it `pressUs` after its call.
  void stopAfter(std::int64_t pressUs, const GraspRequest& request) {
    bench_.log.clear();
    const std::int64_t askedUs = systemClock().monotonicUs();
    const auto lost = [&](const std::string& why) {
      stops_.lost(askedUs, systemClock().monotonicUs(), kStandstillThatKillsAStreamUs, why);
    };
    ASSERT_TRUE(eventuallyTrue([&] { return bench_.control->status().cannotReact.empty(); }));
    try {
      bench_.control->grasp(request);
    } catch (const DeviceError& refused) {
      return lost(refused.what());
    }
    const std::int64_t beganUs = systemClock().monotonicUs();
    sleepUntilUs(beganUs + pressUs);  // the time itself is what is tested
    const std::int64_t pressedUs = systemClock().monotonicUs();
    bench_.control->stop();
    const auto report = bench_.awaitEnd();
    ASSERT_TRUE(report.has_value());
    if (report->outcome == GraspOutcome::kStreamLost) return lost(report->text);
    // The way to the target may be so short that the hand has arrived: a stop is sent nevertheless.
    EXPECT_TRUE(report->outcome == GraspOutcome::kStopped ||
                report->outcome == GraspOutcome::kFinished)
        << report->text;
    ASSERT_TRUE(eventuallyTrue([&] {
      return bench_.log.firstSince("stop", pressedUs).has_value();
    })) << "no stop came";
    const std::int64_t arrivedUs = bench_.log.firstSince("stop", pressedUs)->monoUs;
    stops_.took(pressedUs, arrivedUs);
    // After the stop nothing moves, and no command begins a motion.
    EXPECT_FALSE(bench_.handMoves());
    for (const ArrivedCommand& deed : bench_.log.deeds())
      EXPECT_LE(deed.monoUs, arrivedUs) << deed.name << " behind the stop";
    inMotion_ += !bench_.log.named("m").empty();
    stopped_ += report->outcome == GraspOutcome::kStopped;
  }
  void judge() { stops_.judge("\"in_motion\": " + std::to_string(inMotion_)); }
  int inMotion() const noexcept { return inMotion_; }
  int stopped() const noexcept { return stopped_; }

 private:
  EmulatedBench bench_{stillHand()};  // lines at 115200 baud, answers after 2 to 3 ms
  Punctuality stops_{"stop_on_the_wire"};
  int inMotion_ = 0;
  int stopped_ = 0;
};

inline void stopAtRandomMoments(int moments, std::int64_t latestUs) {
  StopMoments bench;
  bench.connect();
  std::mt19937 random(18);
  for (int i = 0; i < moments; ++i) {
    SCOPED_TRACE("moment " + std::to_string(i));
    GraspRequest request = i % 3 == 0 ? reactiveGrasp() : GraspRequest{};
    request.velocityDegPerS = 20.0;
    request.closeRatio = i % 2 == 0 ? 1.0 : 0.0;
    bench.stopAfter(std::uniform_int_distribution<std::int64_t>(0, latestUs)(random), request);
    if (::testing::Test::HasFatalFailure()) return;
  }
  bench.judge();
  EXPECT_GT(bench.stopped(), moments * 3 / 4);
  EXPECT_GT(bench.inMotion(), moments / 2);
}

}  // namespace palpate::testing
