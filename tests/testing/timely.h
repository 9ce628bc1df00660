// Limits in milliseconds on a machine that runs other tests beside: what is late for a reason of ours is late again
// when it is tried again, what is late because the processor was elsewhere is not.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace palpate::testing {

struct Timely {
  std::optional<std::int64_t> bestUs;  // nothing: no try could be judged
  int tries = 0;
};

// Tries up to `most` times, until one is within the limit. `measure` returns how long it took [us], nothing when the
// try can't be judged (what is measured did not happen, because the machine stood still).
inline Timely inTime(std::int64_t limitUs,
                     int most,
                     const std::function<std::optional<std::int64_t>()>& measure) {
  Timely result;
  while (result.tries < most && (!result.bestUs || *result.bestUs > limitUs)) {
    ++result.tries;
    const auto took = measure();
    if (took && (!result.bestUs || *took < *result.bestUs)) result.bestUs = took;
  }
  return result;
}

}  // namespace palpate::testing
