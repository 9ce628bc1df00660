// The fit of a sender's clock: everything is simulated, so that the times at which items were
// measured are known.
#include "palpate/model/time_base.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace palpate::time_base_test {
namespace {

constexpr double kStartUs = 1'700'000'000e6;

struct Simulated {
  std::vector<double> truthUs;  // when each item was measured
  std::vector<ClockStamp> stamps;
};

struct Sender {
  double rateHz = 100.0;
  double seconds = 60.0;
  double driftPpm = 100.0;
  double burstUs = 50'000.0;  // items wait for the next multiple of it, by the sender's clock
  double jitterUs = 200.0;    // of the way, above a constant 3 ms
  double beginUs = 5e6;       // the sender's clock at the first item
  double pauseUs = 3e6;       // of a restart, before which the clock is at 0
  double startUs = kStartUs;
};

// Adds what a sender that runs until it is switched off sends, after what is there.
void run(const Sender& sender, Simulated& all, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> way(3'000.0, 3'000.0 + sender.jitterUs);
  const double rate = 1.0 + sender.driftPpm * 1e-6;  // of its clock
  const double begin = all.truthUs.empty() ? sender.startUs : all.truthUs.back() + sender.pauseUs;
  const double period = 1e6 / sender.rateHz;  // by its clock
  const auto count = static_cast<int>(sender.seconds * sender.rateHz);
  double last = all.stamps.empty() ? 0.0 : static_cast<double>(all.stamps.back().hostUs);
  double burst = -1.0, arrival = 0.0;
  for (int i = 0; i < count; ++i) {
    const double clock = i * period;
    const double sent = sender.burstUs > 0.0
                            ? std::floor(clock / sender.burstUs + 1.0) * sender.burstUs - period
                            : clock;
    if (sent != burst || sender.burstUs <= 0.0) arrival = begin + sent / rate + way(random);
    burst = sent;
    last = std::max(std::floor(arrival), last + 1.0);
    all.truthUs.push_back(begin + clock / rate);
    all.stamps.push_back({static_cast<std::int64_t>(last),
                          static_cast<std::int64_t>(std::floor(sender.beginUs + clock))});
  }
}

// Of the error, after a constant is taken off [ms].
double rmsMs(const Simulated& all, const TimeBase& base) {
  double sum = 0.0, squares = 0.0;
  const auto count = static_cast<double>(all.truthUs.size());
  for (std::size_t i = 0; i < all.truthUs.size(); ++i) {
    const double error = static_cast<double>(base.timesUs()[i]) - all.truthUs[i];
    sum += error;
    squares += error * error;
  }
  return std::sqrt(squares / count - sum / count * sum / count) / 1e3;
}

void expectAscending(const TimeBase& base) {
  for (std::size_t i = 1; i < base.timesUs().size(); ++i)
    ASSERT_LT(base.timesUs()[i - 1], base.timesUs()[i]) << i;
}

// The target of the program: 0.01 % drift, bursts of 50 ms, a restart.
TEST(TimeBase, FollowsADriftingClockThroughBurstsAndARestart) {
  Simulated all;
  run({}, all);
  run({.beginUs = 0.0}, all, 2);
  const auto base = TimeBase::fit(all.stamps);
  ASSERT_TRUE(base);
  EXPECT_LT(rmsMs(all, *base), 1.0);
  ASSERT_EQ(base->stretches().size(), 2u);
  EXPECT_EQ(base->stretches()[0].begin, 0u);
  EXPECT_EQ(base->stretches()[0].end, 6000u);
  EXPECT_EQ(base->stretches()[1].begin, 6000u);
  EXPECT_EQ(base->stretches()[1].end, 12'000u);
  for (const auto& stretch : base->stretches()) EXPECT_NEAR(stretch.driftPpm.value(), 100.0, 3.0);
  EXPECT_EQ(base->report().restarts, 1u);
  EXPECT_NEAR(base->report().driftPpm.value(), 100.0, 3.0);
  EXPECT_NEAR(base->report().delaySpreadMs, 40.0, 1.0);
  EXPECT_EQ(base->report().unusable, 0u);
  expectAscending(*base);
}

// As a link records it: after a restart the sender's time goes on by the time that passed.
TEST(TimeBase, FindsARestartWhereTheRecordedClockGoesOn) {
  Simulated all;
  run({}, all);
  Simulated after;
  run({.startUs = all.truthUs.back() + 3e6}, after, 2);
  const std::int64_t stepUs = all.stamps.back().deviceUs.value() - all.stamps.back().hostUs +
                              after.stamps.front().hostUs - after.stamps.front().deviceUs.value();
  for (std::size_t i = 0; i < after.stamps.size(); ++i) {
    all.truthUs.push_back(after.truthUs[i]);
    all.stamps.push_back({after.stamps[i].hostUs, *after.stamps[i].deviceUs + stepUs});
  }
  const auto base = TimeBase::fit(all.stamps);
  ASSERT_TRUE(base);
  ASSERT_EQ(base->stretches().size(), 2u);
  EXPECT_EQ(base->stretches()[1].begin, 6000u);
  EXPECT_LT(rmsMs(all, *base), 1.0);
  expectAscending(*base);
}

TEST(TimeBase, OfASteadyClockTheTimesOfArrivalStay) {
  std::vector<ClockStamp> stamps;
  for (int i = 0; i < 3000; ++i) stamps.push_back({1'000'000 + 10'000 * i, 10'000 * i});
  const auto base = TimeBase::fit(stamps);
  ASSERT_TRUE(base);
  for (std::size_t i = 0; i < stamps.size(); ++i) ASSERT_EQ(base->timesUs()[i], stamps[i].hostUs);
  EXPECT_EQ(base->report().driftPpm.value(), 0.0);
  EXPECT_EQ(base->report().boundMs, 0.0);
  EXPECT_EQ(base->stretches().size(), 1u);
}

TEST(TimeBase, ACounterOf32BitsMayWrap) {
  for (const std::int64_t turnUs : {std::int64_t{1} << 32, 1000 * (std::int64_t{1} << 32)}) {
    Simulated all;
    run({.beginUs = static_cast<double>(turnUs) - 20e6}, all);
    for (ClockStamp& stamp : all.stamps) stamp.deviceUs = *stamp.deviceUs % turnUs;
    const auto base = TimeBase::fit(all.stamps);
    ASSERT_TRUE(base);
    EXPECT_EQ(base->report().restarts, 0u);
    EXPECT_EQ(base->report().unusable, 0u);
    EXPECT_LT(rmsMs(all, *base), 1.0);
  }
}

// A digit lost, a digit too many, 0.3 s ahead, no time at all: only that item has its arrival.
TEST(TimeBase, AWrongStampMovesNothingElse) {
  Simulated all;
  run({}, all);
  const auto right = TimeBase::fit(all.stamps);
  ASSERT_TRUE(right);
  using Wrong = std::function<std::optional<std::int64_t>(std::int64_t)>;
  for (const Wrong& wrong : {Wrong([](std::int64_t us) { return us / 10; }),
                             Wrong([](std::int64_t us) { return us * 10; }),
                             Wrong([](std::int64_t us) { return us + 300'000; }),
                             Wrong([](std::int64_t) { return INT64_MIN; }),
                             Wrong([](std::int64_t) { return std::nullopt; })}) {
    std::vector<ClockStamp> stamps = all.stamps;
    stamps[3001].deviceUs = wrong(*stamps[3001].deviceUs);
    const auto base = TimeBase::fit(stamps);
    ASSERT_TRUE(base);
    EXPECT_EQ(base->stretches().size(), 1u);
    EXPECT_EQ(base->report().unusable, 1u);
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      if (i == 3001) continue;
      ASSERT_NEAR(base->timesUs()[i], right->timesUs()[i], 50) << i;
    }
    expectAscending(*base);
  }
}

// The clock of the second device is an hour ahead.
TEST(TimeBase, TwoDevicesAnHourApartAreFittedEachByItsOwnClock) {
  Simulated hand, cell;
  run({}, hand);
  run({.rateHz = 1000.0, .driftPpm = -40.0, .burstUs = 10'000.0, .beginUs = 3605e6}, cell, 2);
  const auto first = TimeBase::fit(hand.stamps), second = TimeBase::fit(cell.stamps);
  ASSERT_TRUE(first && second);
  EXPECT_LT(rmsMs(hand, *first), 1.0);
  EXPECT_LT(rmsMs(cell, *second), 1.0);
  EXPECT_NEAR(first->report().driftPpm.value(), 100.0, 3.0);
  EXPECT_NEAR(second->report().driftPpm.value(), -40.0, 3.0);
}

// Delays of a second, each for some time, are no jumps of the clock.
TEST(TimeBase, PilesAndStallsAreDelays) {
  Simulated all;
  run({}, all);
  for (std::size_t i = 0; i < all.stamps.size(); ++i) {
    const double phaseS = std::fmod(static_cast<double>(i) / 100.0, 10.0);
    if (phaseS < 1.5) all.stamps[i].hostUs += static_cast<std::int64_t>((1.5 - phaseS) * 1e6);
    if (i > 0) all.stamps[i].hostUs = std::max(all.stamps[i].hostUs, all.stamps[i - 1].hostUs + 1);
  }
  const auto base = TimeBase::fit(all.stamps);
  ASSERT_TRUE(base);
  EXPECT_EQ(base->stretches().size(), 1u);
  EXPECT_LT(rmsMs(all, *base), 1.0);
}

// The drift changes from 20 to 60 ppm within an hour: one line would be wrong by 18 ms.
TEST(TimeBase, FollowsADriftThatChanges) {
  Simulated all;
  std::mt19937 random(3);
  std::exponential_distribution<double> way(1.0 / 500.0);
  for (int i = 0; i < 36'000; ++i) {
    const double t = 0.1 * i;
    all.truthUs.push_back(kStartUs + 1e6 * t);
    all.stamps.push_back({static_cast<std::int64_t>(all.truthUs.back() + way(random)),
                          static_cast<std::int64_t>(1e6 * t + 20.0 * t + t * t / 180.0)});
  }
  const auto base = TimeBase::fit(all.stamps);
  ASSERT_TRUE(base);
  EXPECT_EQ(base->stretches().size(), 1u);
  EXPECT_LT(rmsMs(all, *base), 1.0);
  EXPECT_NEAR(base->report().driftPpm.value(), 40.0, 2.0);
  EXPECT_LT(base->report().rmsMs, 1.0);
}

TEST(TimeBase, SaysWhyThereIsNothingToFit) {
  std::string why;
  EXPECT_FALSE(TimeBase::fit({}, &why));
  EXPECT_EQ(why, "no times of the sender's clock");
  std::vector<ClockStamp> stamps(30);
  for (int i = 0; i < 30; ++i) stamps[static_cast<std::size_t>(i)].hostUs = i;
  EXPECT_FALSE(TimeBase::fit(stamps, &why));
  EXPECT_EQ(why, "no times of the sender's clock");
  for (int i = 0; i < 5; ++i) stamps[static_cast<std::size_t>(i)].deviceUs = i;
  EXPECT_FALSE(TimeBase::fit(stamps, &why));
  EXPECT_EQ(why, "only 5 usable times of the sender's clock, 20 are needed");
  Simulated all;
  run({}, all);
  for (ClockStamp& stamp : all.stamps)
    stamp.deviceUs = *stamp.deviceUs / 1000;  // ms, said to be us
  EXPECT_FALSE(TimeBase::fit(all.stamps, &why));
  EXPECT_NE(why.find("clock runs 0.001 times as fast as ours"), std::string::npos) << why;
}

TEST(TimeBase, AShortRecordingHasNoDriftButItsOwnIntervals) {
  Simulated all;
  run({.seconds = 2.0}, all);
  const auto base = TimeBase::fit(all.stamps);
  ASSERT_TRUE(base);
  EXPECT_FALSE(base->report().driftPpm);
  EXPECT_LT(rmsMs(all, *base), 0.1);
}

TEST(ClockMonitor, KnowsDriftDelaysAndRestartsWhileItemsArrive) {
  Simulated all;
  run({}, all);
  ClockMonitor monitor;
  monitor.add({1'000, {}});
  EXPECT_FALSE(monitor.report());
  monitor = ClockMonitor();
  for (const ClockStamp& stamp : all.stamps) monitor.add(stamp);
  ASSERT_TRUE(monitor.report());
  EXPECT_EQ(monitor.report()->restarts, 0u);
  EXPECT_NEAR(monitor.report()->driftPpm.value(), 100.0, 5.0);
  EXPECT_NEAR(monitor.report()->delaySpreadMs, 40.0, 1.0);
  const std::size_t before = all.stamps.size();
  run({.beginUs = 0.0}, all, 2);
  for (std::size_t i = before; i < all.stamps.size(); ++i) monitor.add(all.stamps[i]);
  EXPECT_EQ(monitor.report()->restarts, 1u);
  EXPECT_EQ(monitor.report()->items, all.stamps.size());
  EXPECT_NEAR(monitor.report()->driftPpm.value(), 100.0, 5.0);
}

TEST(ClockText, IsOneLine) {
  EXPECT_EQ(clockText({.restarts = 1,
                       .driftPpm = 100.24,
                       .delaySpreadMs = 40.06,
                       .rmsMs = 0.16,
                       .boundMs = 0.4}),
            "drift 100 ppm, delays vary by 40.1 ms, 1 restart, error 0.16 ms (at most 0.40)");
  EXPECT_EQ(clockText({.unusable = 2}),
            "drift not known yet, delays vary by 0.0 ms, 0 restarts, error 0.00 ms (at most 0.00), "
            "2 items without a usable time");
}

}  // namespace
}  // namespace palpate::time_base_test
