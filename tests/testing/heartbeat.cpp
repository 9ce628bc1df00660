#include "testing/heartbeat.h"

#include <algorithm>
#include <ctime>

#include <pthread.h>
#include <sched.h>

namespace palpate::testing {
namespace {

constexpr std::int64_t kBeatUs = 1000;
// Delay by timers and the scheduler on an otherwise idle machine [us].
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
  if (lengthUs > kUsualUs) standstills_.push_back({wokeUs - lengthUs, wokeUs});
}

std::int64_t LateWakeUps::standstillUs(std::int64_t beginUs, std::int64_t endUs) const {
  std::vector<Standstill> parts;
  for (const Standstill& each : standstills_) {
    const Standstill part{std::max(beginUs, each.beginUs), std::min(endUs, each.endUs)};
    if (part.beginUs < part.endUs) parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end(), [](const Standstill& a, const Standstill& b) {
    return a.beginUs < b.beginUs;
  });
  std::int64_t sum = 0, countedUs = beginUs;
  for (const Standstill& part : parts) {
    sum += std::max<std::int64_t>(part.endUs - std::max(part.beginUs, countedUs), 0);
    countedUs = std::max(countedUs, part.endUs);
  }
  return sum;
}

Heartbeat::Heartbeat() {
  cpu_set_t ours;
  CPU_ZERO(&ours);
  sched_getaffinity(0, sizeof ours, &ours);
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &ours)) cores.push_back(core);
  lastUs_.assign(cores.size(), 0);
  for (std::size_t i = 0; i < cores.size(); ++i)
    threads_.emplace_back([this, i, core = cores[i]] { beat(i, core); });
  // Waits until every thread has begun; until then it notices no standstill.
  std::unique_lock lock(mutex_);
  beaten_.wait(lock, [&] {
    return std::all_of(lastUs_.begin(), lastUs_.end(), [](auto lastUs) { return lastUs > 0; });
  });
}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  for (std::thread& thread : threads_) thread.join();
}

void Heartbeat::beat(std::size_t at, int core) {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(core, &only);
  pthread_setaffinity_np(pthread_self(), sizeof only, &only);
  for (;;) {
    const std::int64_t workedUs = microsecondsOf(CLOCK_PROCESS_CPUTIME_ID);
    const std::int64_t dueUs = microsecondsOf(CLOCK_MONOTONIC) + kBeatUs;
    sleepUntilUs(dueUs);
    const std::int64_t wokeUs = microsecondsOf(CLOCK_MONOTONIC);
    const std::int64_t ownWorkUs = microsecondsOf(CLOCK_PROCESS_CPUTIME_ID) - workedUs;
    const std::lock_guard lock(mutex_);
    late_.note(dueUs, wokeUs, ownWorkUs);
    lastUs_[at] = wokeUs;
    beaten_.notify_all();
    if (ends_) return;
  }
}

std::int64_t Heartbeat::standstillUs(std::int64_t beginUs, std::int64_t endUs) {
  std::unique_lock lock(mutex_);
  beaten_.wait(lock, [&] {
    return std::all_of(
        lastUs_.begin(), lastUs_.end(), [&](auto lastUs) { return lastUs >= endUs; });
  });
  return late_.standstillUs(beginUs, endUs);
}

}  // namespace palpate::testing
