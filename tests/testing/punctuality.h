// Checks in tests that answers come in time. Each answer is measured once, without repetition. A
// late answer is excused only when a heartbeat shows that the machine stood still for as long as
// the answer was late; it is still counted and reported. Judged where time is
// (testing/time_limit.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "testing/heartbeat.h"

namespace palpate::testing {

struct PunctualityLimits {
  // At least `share` of all answers are within this time.
  std::int64_t usualUs = 20'000;
  // With fewer than 200 answers, 0.995 means all of them.
  double share = 0.995;
  // Every answer is within this time.
  std::int64_t worstUs = 100'000;
};

// The time of one answer, and how much of it the machine stood still.
struct TimedAnswer {
  std::int64_t tookUs = 0;
  std::int64_t standstillUs = 0;
};

struct PunctualityReport {
  std::size_t answers = 0;
  // Of all answers, also late and excused ones.
  double medianMs = 0, p99Ms = 0, worstMs = 0;
  // The number of answers later than usualUs.
  std::size_t late = 0;
  // Those of them without a standstill of the machine.
  std::size_t lateUnexcused = 0;
  // The number of answers later than worstUs without a standstill.
  std::size_t tooLateUnexcused = 0;
  std::size_t lateAllowed = 0;
  // Empty when the answers are punctual.
  std::string faults;
};
// Compares answers with limits.
PunctualityReport punctualityOf(const std::vector<TimedAnswer>& answers,
                                const PunctualityLimits& limits);

// Collects the answers of one test and judges them at its end.
class Punctuality {
 public:
  // `name` is the name in the report: "stop_on_the_wire".
  explicit Punctuality(std::string name, PunctualityLimits limits = {});
  // Adds an answer: from the call to the answer, both in CLOCK_MONOTONIC [us].
  void took(std::int64_t beginUs, std::int64_t endUs);
  // Adds a call that could not be made, or whose answer was prevented, in this time span. It is a
  // failure unless the machine stood still for `forUs` of it.
  void lost(std::int64_t beginUs, std::int64_t endUs, std::int64_t forUs, const std::string& why);
  // Prints each late answer, then a line `measured {..}` in JSON for scripts/measure; fails the
  // test when the answers are not punctual.
  PunctualityReport judge(const std::string& moreJson = "");

 private:
  std::string name_;
  PunctualityLimits limits_;
  Heartbeat heartbeat_;
  std::vector<TimedAnswer> answers_;
  std::size_t lost_ = 0;
};

}  // namespace palpate::testing
