// Answers that must come in time. Each is measured once: the first time is the figure. A late one
// is excused only where a heartbeat proves that the machine stood still for as long as it was late,
// and is counted and published all the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "testing/heartbeat.h"

namespace palpate::testing {

struct PunctualityLimits {
  std::int64_t usualUs = 20'000;   // at least `share` of all answers are within this,
  double share = 0.995;            // which of fewer than 200 means each
  std::int64_t worstUs = 100'000;  // and each is within this
};

// One answer, and how much of the time until then the machine stood still.
struct TimedAnswer {
  std::int64_t tookUs = 0;
  std::int64_t standstillUs = 0;
};

struct PunctualityReport {
  std::size_t answers = 0;
  double medianMs = 0, p99Ms = 0, worstMs = 0;  // of all, the late and the excused too
  std::size_t late = 0;                         // of all: beyond usualUs
  std::size_t lateUnexcused = 0;                // of these: the machine had not stood still
  std::size_t tooLateUnexcused = 0;             // beyond worstUs
  std::size_t lateAllowed = 0;
  std::string faults;  // empty: punctual
};
PunctualityReport punctualityOf(const std::vector<TimedAnswer>& answers,
                                const PunctualityLimits& limits);

class Punctuality {
 public:
  // `name` is that of the figures: "stop_on_the_wire".
  explicit Punctuality(std::string name, PunctualityLimits limits = {});
  // From the call to the answer, both by CLOCK_MONOTONIC [us].
  void took(std::int64_t beginUs, std::int64_t endUs);
  // A call that could not be made or whose answer something else forestalled, in this stretch of
  // time. That is a failure, unless the machine stood still for `forUs` of it.
  void lost(std::int64_t beginUs, std::int64_t endUs, std::int64_t forUs, const std::string& why);
  // Prints each late answer, then a line `measured {..}` in JSON, which scripts/measure reads;
  // fails the test when the answers are not punctual.
  PunctualityReport judge(const std::string& moreJson = "");

 private:
  std::string name_;
  PunctualityLimits limits_;
  Heartbeat heartbeat_;
  std::vector<TimedAnswer> answers_;
  std::size_t lost_ = 0;
};

}  // namespace palpate::testing
