// Bounds on real time in tests. The fast suite shares its machine with whatever runs there, so it
// judges what happens, not how soon; files listed after TIMED in a CMakeLists.txt run again in the
// slow suite, where their bounds hold as written.
#pragma once

#include <cstdlib>

namespace palpate::testing {

// Whether this run judges real time: it has the machine for itself.
inline bool judgesTime() { return std::getenv("PALPATE_JUDGE_TIME") != nullptr; }

// `bound` where time is judged; elsewhere thirty times as much, which only something that hangs
// takes.
template <class Time>
Time timeLimit(Time bound) {
  return judgesTime() ? bound : bound * 30;
}

}  // namespace palpate::testing
