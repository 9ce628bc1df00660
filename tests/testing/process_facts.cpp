#include "testing/process_facts.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpate::testing {
namespace {

std::size_t entriesOf(const char* folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    static_cast<void>(entry);
    ++count;
  }
  return count;
}

// A value of /proc/self/status, such as "VmHWM:  1234 kB" [bytes].
std::uint64_t statusBytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::uint64_t kilobytes = 0;
  while (status >> word)
    if (word == name && status >> kilobytes) break;
  return kilobytes * 1024;
}

}  // namespace

ProcessFacts leastProcessFacts() {
  ProcessFacts least = processFacts();
  for (int i = 0; i < 10; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const ProcessFacts now = processFacts();
    least.residentBytes = std::min(least.residentBytes, now.residentBytes);
    least.descriptors = std::min(least.descriptors, now.descriptors);
    least.threads = std::min(least.threads, now.threads);
  }
  return least;
}

ProcessFacts processFacts() {
  ProcessFacts facts;
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages >> facts.residentBytes;
  facts.residentBytes *= static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  facts.descriptors = entriesOf("/proc/self/fd");
  facts.threads = entriesOf("/proc/self/task");
  return facts;
}

std::uint64_t memoryOf(const std::function<bool()>& work) {
  std::array<int, 2> ends{-1, -1};
  EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    // What the test has in memory already is not the work's.
    std::ofstream("/proc/self/clear_refs") << 5;
    const std::uint64_t before = statusBytes("VmHWM:");
    bool done = false;
    try {
      done = work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    rusage started{};
    ::getrusage(RUSAGE_CHILDREN, &started);
    const std::uint64_t memory = std::max(statusBytes("VmHWM:") - before,
                                          static_cast<std::uint64_t>(started.ru_maxrss) * 1024);
    const bool told = ::write(ends[1], &memory, sizeof memory) == sizeof memory;
    ::_exit(done && told ? 0 : 1);
  }
  ::close(ends[1]);
  std::uint64_t memory = UINT64_MAX;
  EXPECT_EQ(::read(ends[0], &memory, sizeof memory), static_cast<ssize_t>(sizeof memory));
  ::close(ends[0]);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return memory;
}

}  // namespace palpate::testing
