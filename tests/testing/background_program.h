// A program that runs beside the test: its output can be awaited, it can be killed.
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
  ~BackgroundProgram();  // killed when it still runs
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  // Waits for a line of standard output that contains `text`; nothing when time is over or the
  // program has ended without one.
  std::optional<std::string> awaitLine(const std::string& text,
                                       std::chrono::milliseconds limit = std::chrono::seconds(20));
  void signal(int number);
  // Waits for its end: the exit code, 128 + signal when killed. Kills it when time is over (-1).
  int wait(std::chrono::milliseconds limit = std::chrono::seconds(20));
  std::string out() const;  // so far
  std::string err() const;
  pid_t pid() const noexcept { return pid_; }

 private:
  TemporaryFolder folder_;
  pid_t pid_ = -1;
  std::optional<int> ended_;
};

}  // namespace palpate::testing
