// The program under test, and the shape its errors have.
#pragma once

#include <algorithm>

#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing {

inline ProgramResult palpate(const std::vector<std::string>& arguments,
                             std::map<std::string, std::string> environment = {}) {
  const TemporaryFolder home;  // the user's own settings are never touched
  for (const char* variable : {"XDG_CONFIG_HOME",
                               "XDG_DATA_HOME",
                               "XDG_STATE_HOME",
                               "XDG_CACHE_HOME",
                               "XDG_RUNTIME_DIR",
                               "HOME"})
    environment.try_emplace(variable, home.path().string());
  return runProgram(PALPATE_PROGRAM, arguments, environment);
}

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
