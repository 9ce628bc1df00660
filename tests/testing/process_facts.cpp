#include "testing/process_facts.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

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

}  // namespace palpate::testing
