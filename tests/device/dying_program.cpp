// A program that moves a hand and dies: for last_stop_test.
//   dying_program PORT HOW [STOP_PROGRAM]
// prints its alarms, then "moves" when the hand does. With HOW "hold" it only opens the port.
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "palpate/device/last_stop.h"
#include "palpate/device/live_hand.h"

#include "device/collecting_sink.h"
#include "testing/awaited.h"

namespace palpate::testing {
namespace {

void say(const std::string& text) {
  std::puts(text.c_str());
  std::fflush(stdout);
}

// Endless; each call has a frame of its own.
[[gnu::noinline]] int overflow(int depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow(depth + 1) + frame[0];
}

// The faults reach the machine; UBSan would end the program before them.
[[gnu::no_sanitize("undefined")]] void die(const std::string& how) {
  static volatile int zero = 0;
  if (how == "segv") *reinterpret_cast<volatile int*>(static_cast<std::intptr_t>(zero)) = 1;
  if (how == "bus") {
    // A page of a file that ends before it.
    std::FILE* file = std::tmpfile();
    void* page = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, ::fileno(file), 0);
    *static_cast<volatile char*>(page) = 1;
  }
  if (how == "fpe") zero = 1000 / zero;  // 1 / zero is a comparison for compilers
  if (how == "ill") __builtin_trap();
  if (how == "abort") std::abort();
  if (how == "kill_with_child") {
    // It inherits what isn't closed for it.
    char name[] = "sleep", seconds[] = "600";
    char* words[] = {name, seconds, nullptr};
    pid_t child = -1;
    ::posix_spawn(&child, "/bin/sleep", nullptr, nullptr, words, nullptr);
    say("child " + std::to_string(child));
  }
  if (how == "overflow") std::exit(overflow(0));
  if (how == "overflow_in_thread") std::thread([] { std::exit(overflow(0)); }).join();
  while (how != "end") ::pause();
}

int run(const std::string& port, const std::string& how) {
  if (how == "hold") {
    const auto channel = openChannel(port);
    const LastStop lastStop(*channel);
    say("moves");
    die(how);
  }
  CollectingSink sink;
  LiveHandOptions options;
  options.sdhPort = port;
  LiveHand hand(options);
  hand.start(sink);
  if (!awaited([&] { return hand.status().motion->state == PortState::kStreaming; })) return 1;
  hand.submit(MoveJoints{{0, -10, 10, -10, 10, -10, 10}, {}, false}).get();
  for (const Event& event : sink.takeEvents())
    if (event.kind == "alarm") say(event.text);
  say("moves");
  die(how);
  const bool still = awaited([&] { return hand.axisStates() == std::vector<int>(7, 0); });
  hand.stop();
  return still ? 0 : 1;
}

}  // namespace
}  // namespace palpate::testing

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  constexpr rlimit kNoCoreDump{0, 0};
  ::setrlimit(RLIMIT_CORE, &kNoCoreDump);
  palpate::stopHandsInACrash();
  if (argc > 3) palpate::stopHandsWhenKilled(argv[3]);
  return palpate::testing::run(argv[1], argv[2]);
}
