#include "testing/process_facts.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <thread>

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
  const pid_t child = ::fork();
  if (child == 0) {
    bool done = false;
    try {
      done = work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(done ? 0 : 1);
  }
  int status = 0;
  rusage usage{};
  EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace palpate::testing
