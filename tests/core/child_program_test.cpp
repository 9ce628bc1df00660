#include "palpate/core/child_program.h"

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"

#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::child_program_test {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string shell(const std::string& script, int* exitCode = nullptr) {
  ChildProgram program("/bin/sh", {"-c", script});
  const int code = program.finish();
  if (exitCode) *exitCode = code;
  return program.said();
}

bool hasChildren() { return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

TEST(ChildProgram, GetsItsWordsAsTheyAreWithoutAShell) {
  ChildProgram program("/usr/bin/printf", {"<%s>", "a b", "$(x)", "'", "", "ü\n"});
  EXPECT_EQ(program.finish(), 0);
  EXPECT_EQ(program.said(), "<a b><$(x)><'><><ü\n>");
}

TEST(ChildProgram, HowItEnded) {
  int code = 0;
  shell("exit 7", &code);
  EXPECT_EQ(code, 7);
  shell("kill -9 $$", &code);
  EXPECT_EQ(code, 128 + 9);
  EXPECT_EQ(shell("echo out; echo err >&2"), "out\nerr\n");
}

TEST(ChildProgram, TalksWhileItIsFed) {
  // Far more in both directions than a pipe holds: whoever waits for one only waits for ever.
  ChildProgram program("/bin/cat", {});
  const std::string line(1023, 'x');
  for (int i = 0; i < 4096; ++i) ASSERT_TRUE(program.write(bytesOf(std::to_string(i % 10) + line)));
  EXPECT_EQ(program.finish(), 0);
  ASSERT_GE(program.said().size(), 4u * 1024u);
  EXPECT_LE(program.said().size(), 1024u * 1024u) << "of very much the end";
  EXPECT_EQ(program.said().substr(program.said().size() - 1024), "5" + line);
}

TEST(ChildProgram, OneThatReadsNoMoreIsNoSignalForUs) {
  ChildProgram program("/bin/sh", {"-c", "echo tired >&2; exit 3"});
  const std::string much(1 << 20, 'x');
  bool took = true;
  for (int i = 0; i < 100 && took; ++i) took = program.write(bytesOf(much));
  EXPECT_FALSE(took);
  EXPECT_EQ(program.finish(), 3);
  EXPECT_EQ(program.said(), "tired\n");
}

// What any program that is started by us inherits, and what it is given besides.
std::set<std::string> expectedDescriptors() {
  std::set<std::string> numbers = {"0", "1", "2", "3"};
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string number = entry.path().filename().string();
    const int flags = ::fcntl(std::stoi(number), F_GETFD);
    if (flags >= 0 && (flags & FD_CLOEXEC) == 0) numbers.insert(number);
  }
  return numbers;
}

TEST(ChildProgram, GetsADescriptorOfOursAndNoOther) {
  const testing::TemporaryFolder folder;
  const int ours = ::open((folder / "a").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  {
    ChildProgram program(
        "/bin/sh", {"-c", "printf 1 >&3; printf 23 >> /proc/self/fd/3; ls /proc/$$/fd; :"}, {ours});
    EXPECT_EQ(program.finish(), 0);
    std::istringstream said(program.said());
    std::set<std::string> given;
    for (std::string line; std::getline(said, line);) given.insert(line);
    EXPECT_EQ(given, expectedDescriptors());
  }
  ::close(ours);
  EXPECT_EQ(testing::readFile(folder / "a"), "123");
}

TEST(ChildProgram, WhatIsNoProgramIsSaid) {
  for (const char* path : {"/no/such/program", "/", "/etc/passwd"}) {
    try {
      ChildProgram program(path, {});
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("can't be started"), std::string::npos);
    }
  }
}

TEST(ChildProgram, WaitingCanBeCancelled) {
  {
    ChildProgram program("/bin/sh", {"-c", "sleep 1000"});
    const std::string much(1 << 22, 'x');
    int asked = 0;
    EXPECT_THROW(program.write(bytesOf(much), [&] { return ++asked < 3; }), Cancelled);
    EXPECT_THROW(program.finish([] { return false; }), Cancelled);
    EXPECT_TRUE(hasChildren());
  }
  EXPECT_FALSE(hasChildren()) << "killed and waited for";
}

TEST(ChildProgram, LeavesNoDescriptor) {
  shell("true");  // whatever is opened once
  const auto before = testing::leastProcessFacts().descriptors;
  for (int i = 0; i < 20; ++i) {
    shell("echo x");
    const ChildProgram killed("/bin/cat", {});
    EXPECT_THROW(ChildProgram("/no/such/program", {}), Error);
  }
  EXPECT_EQ(testing::leastProcessFacts().descriptors, before);
  EXPECT_FALSE(hasChildren());
}

TEST(ChildProgram, WhatItLeavesBehindIsEndedWithIt) {
  const auto start = std::chrono::steady_clock::now();
  int code = -1;
  const std::string pid = shell("sleep 1000 & echo $!; exit 0", &code);
  const std::filesystem::path status = "/proc/" + pid.substr(0, pid.find('\n')) + "/stat";
  // "1234 (sleep) Z ..": killed, and waited for by nobody; no such file: by somebody.
  const auto ended = [&] {
    std::string text;
    std::ifstream(status) >> text >> text >> text;
    return text.empty() || text == "Z";
  };
  while (!ended() && std::chrono::steady_clock::now() - start < std::chrono::seconds(20)) {
  }
  EXPECT_TRUE(ended());
  EXPECT_EQ(code, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace palpate::child_program_test
