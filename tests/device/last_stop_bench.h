// Test bench: a fake hand on a pseudo-terminal, and a program that moves it and dies.
#pragma once

#include <csignal>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "device/fake_sdh_hand.h"
#include "device/pty_server.h"
#include "testing/background_program.h"

namespace palpate::testing {

inline const std::string kStopProgram = PALPATE_STOP_PROGRAM;

// The processes of palpate_stop that hold this port.
inline std::set<pid_t> stopProgramsOf(const std::string& port) {
  std::set<pid_t> found;
  std::error_code ignored;
  for (const auto& process : std::filesystem::directory_iterator("/proc")) {
    if (std::filesystem::read_symlink(process.path() / "exe", ignored) ==
            std::filesystem::path(kStopProgram) &&
        std::filesystem::read_symlink(process.path() / "fd/1", ignored) ==
            std::filesystem::path(port))
      found.insert(std::stoi(process.path().filename()));
  }
  return found;
}

class LastStopTest : public ::testing::Test {
 protected:
  FakeSdhHand hand;
  PtyServer server{[this](const Bytes& request) { return hand.receive(request); }};

  int stops() {
    int count = 0;
    server.between([&] { count = hand.stops; });
    return count;
  }
  int moves() {
    int count = 0;
    server.between([&] { count = hand.moves; });
    return count;
  }
  std::unique_ptr<BackgroundProgram> movedBy(const std::vector<std::string>& words) {
    std::vector<std::string> all = {server.path()};
    all.insert(all.end(), words.begin(), words.end());
    auto program = std::make_unique<BackgroundProgram>(PALPATE_DYING_PROGRAM, all);
    EXPECT_TRUE(program->awaitLine("moves").has_value()) << program->err();
    return program;
  }
  pid_t stopProgram() {
    const std::set<pid_t> found = stopProgramsOf(server.path());
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? -1 : *found.begin();
  }
};

}  // namespace palpate::testing
