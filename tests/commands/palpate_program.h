// The program under test, and the shape its errors have.
#pragma once

#include <algorithm>

#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing {

// Runs `palpate` with settings and folders of its own, which are empty. It isn't started, but
// called in a copy of this process: loading its libraries would take most of the time of these
// tests.
ProgramResult palpate(const std::vector<std::string>& arguments,
                      std::map<std::string, std::string> environment = {});
// The same by starting the program.
ProgramResult startedPalpate(const std::vector<std::string>& arguments,
                             std::map<std::string, std::string> environment = {});

// Failed with `exitCode` and exactly one line on stderr that contains `words`.
inline void expectOneLineError(const ProgramResult& result,
                               int exitCode,
                               const std::vector<std::string>& words) {
  EXPECT_EQ(result.exitCode, exitCode) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.err.rfind("palpate: ", 0), 0u) << result.err;
  for (const std::string& word : words)
    EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' not in " << result.err;
}

}  // namespace palpate::testing
