#include "testing/heartbeat.h"

#include <algorithm>
#include <ctime>

namespace palpate::testing {
namespace {

constexpr std::int64_t kBeatUs = 1000;
// Timers and the way through the scheduler cost this much on a machine that does nothing else.
constexpr std::int64_t kUsualUs = 500;

std::int64_t microsecondsOf(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
}

}  // namespace

void sleepUntilUs(std::int64_t monotonicUs) {
  timespec time{};
  time.tv_sec = monotonicUs / 1'000'000;
  time.tv_nsec = monotonicUs % 1'000'000 * 1000;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != 0) {
  }
}

void LateWakeUps::note(std::int64_t dueUs, std::int64_t wokeUs, std::int64_t ownWorkUs) {
  const std::int64_t lengthUs = wokeUs - dueUs - std::max<std::int64_t>(ownWorkUs, 0);
  if (lengthUs > kUsualUs) standstills_.push_back({dueUs, wokeUs, lengthUs});
}

std::int64_t LateWakeUps::standstillUs(std::int64_t beginUs, std::int64_t endUs) const {
  std::int64_t sum = 0;
  for (const Standstill& each : standstills_) {
    const std::int64_t common = std::min(endUs, each.endUs) - std::max(beginUs, each.beginUs);
    if (common > 0) sum += std::min(common, each.lengthUs);
  }
  return sum;
}

Heartbeat::Heartbeat() : thread_([this] { beat(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  thread_.join();
}

void Heartbeat::beat() {
  for (;;) {
    const std::int64_t workedUs = microsecondsOf(CLOCK_PROCESS_CPUTIME_ID);
    const std::int64_t dueUs = microsecondsOf(CLOCK_MONOTONIC) + kBeatUs;
    sleepUntilUs(dueUs);
    const std::int64_t wokeUs = microsecondsOf(CLOCK_MONOTONIC);
    const std::int64_t ownWorkUs = microsecondsOf(CLOCK_PROCESS_CPUTIME_ID) - workedUs;
    const std::lock_guard lock(mutex_);
    late_.note(dueUs, wokeUs, ownWorkUs);
    lastUs_ = wokeUs;
    beaten_.notify_all();
    if (ends_) return;
  }
}

std::int64_t Heartbeat::standstillUs(std::int64_t beginUs, std::int64_t endUs) {
  std::unique_lock lock(mutex_);
  beaten_.wait(lock, [&] { return lastUs_ >= endUs; });
  return late_.standstillUs(beginUs, endUs);
}

}  // namespace palpate::testing
