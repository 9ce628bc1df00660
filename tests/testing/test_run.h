// Runs the selected tests of a process.
#pragma once

namespace palpate::testing {

// RUN_ALL_TESTS(), called with what main() was called with. Tests that drive an emulated hand in
// real time need the machine: a hand whose frames or answers don't come in time is stopped. Where
// PALPATE_EXCUSE_STANDSTILL is set and the machine stood still during each test that failed
// (testing/heartbeat.h), the process says so and starts anew, twice at most. Files listed after
// LIVE in a CMakeLists.txt are run in this way in the fast suite; the slow one excuses nothing.
int runTests(char** arguments);

}  // namespace palpate::testing
