// Runs a program in parallel to a test: its output can be awaited, and it can be killed.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "testing/testing.h"

namespace palpate::testing {

class BackgroundProgram {
 public:
  BackgroundProgram(const std::filesystem::path& program,
                    const std::vector<std::string>& arguments);
  // Kills the program if it still runs.
  ~BackgroundProgram();
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  // Waits for a line of standard output that contains `text`; returns nothing when the time is over
  // or the program has ended without such a line.
  std::optional<std::string> awaitLine(const std::string& text,
                                       std::chrono::milliseconds limit = std::chrono::seconds(20));
  void signal(int number);
  // Waits for the end and returns the exit code, 128 + signal when it was killed. Kills the program
  // when the time is over and returns -1.
  int wait(std::chrono::milliseconds limit = std::chrono::seconds(20));
  // The output so far.
  std::string out() const;
  std::string err() const;
  pid_t pid() const noexcept { return pid_; }

 private:
  TemporaryFolder folder_;
  pid_t pid_ = -1;
  std::optional<int> ended_;
};

}  // namespace palpate::testing
