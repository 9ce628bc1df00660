// A program that moves a fake hand dies in every way: what arrives at the hand, what is left
// behind.
#include "palpate/device/last_stop.h"

#include <csignal>
#include <map>
#include <set>
#include <sstream>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "palpate/device/live_hand.h"

#include "device/collecting_sink.h"
#include "device/last_stop_bench.h"
#include "testing/awaited.h"
#include "testing/background_program.h"
#include "testing/process_facts.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::last_stop_test {
namespace {
namespace fs = std::filesystem;

// docs of the SDH-2's protocol: blanks before a command have no meaning, the longest record has 36
// bytes.
const std::string kStopLine = " \r\nstop\r\n";
const std::string kSerialStop = std::string(40, ' ') + kStopLine;

std::string repeated(const std::string& text) { return text + text + text; }

// Without palpate_stop: the stops come from the process that crashes.
class Crash : public LastStopTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(Crash, StopsTheHandAndEndsAsWithoutIt) {
  const std::string how = GetParam();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  if (how == "overflow_in_thread") GTEST_SKIP() << "sanitizers have stacks of their own";
  constexpr bool kExitIsOurs = false;
#else
  constexpr bool kExitIsOurs = true;
#endif
  const auto program = movedBy({how});
  const int exit = program->wait();
  const std::map<std::string, int> signals{
      {"bus", SIGBUS}, {"fpe", SIGFPE}, {"ill", SIGILL}, {"abort", SIGABRT}};
  const auto found = signals.find(how);
  if (kExitIsOurs) {
    EXPECT_EQ(exit, 128 + (found == signals.end() ? SIGSEGV : found->second)) << program->err();
  }
  EXPECT_EQ(moves(), 1);
  EXPECT_TRUE(awaited([this] { return stops() == 3; })) << stops();
}
INSTANTIATE_TEST_SUITE_P(
    Ways,
    Crash,
    ::testing::Values("segv", "bus", "fpe", "ill", "abort", "overflow", "overflow_in_thread"),
    [](const auto& given) { return std::string(given.param); });

TEST_F(LastStopTest, AProgramThatIsKilledStopsTheHandAndLeavesThePort) {
  const auto program = movedBy({"kill", kStopProgram});
  EXPECT_EQ(stops(), 0);
  program->signal(SIGKILL);
  EXPECT_EQ(program->wait(), 128 + SIGKILL);
  // The lock ended with the process, whatever palpate_stop still does.
  EXPECT_NO_THROW(openChannel(server.path()));
  CollectingSink sink;
  LiveHandOptions options;
  options.sdhPort = server.path();
  LiveHand next(options);
  next.start(sink);
  EXPECT_TRUE(awaited([&] { return next.status().motion->state == PortState::kStreaming; }));
  EXPECT_TRUE(awaited([this] { return stops() >= 3; })) << stops();
  EXPECT_TRUE(awaited([this] { return stopProgramsOf(server.path()).empty(); }));
  next.stop();
}

TEST_F(LastStopTest, AProgramThatIsKilledIsFoundDeadWhileItsChildLives) {
  const auto program = movedBy({"kill_with_child", kStopProgram});
  const auto child = program->awaitLine("child ");
  ASSERT_TRUE(child.has_value());
  program->signal(SIGKILL);
  EXPECT_EQ(program->wait(), 128 + SIGKILL);
  EXPECT_TRUE(awaited([this] { return stops() == 3; })) << stops();
  EXPECT_EQ(::kill(std::stoi(child->substr(6)), SIGKILL), 0) << "it lived until here";
}

TEST_F(LastStopTest, SignalsOfATerminalDontEndTheStopProgram) {
  const auto program = movedBy({"kill", kStopProgram});
  const pid_t pid = stopProgram();
  ASSERT_GT(pid, 0);
  EXPECT_EQ(::getsid(pid), pid);
  // Its name is set after the signals are ignored. `pkill palpate` doesn't match it.
  EXPECT_TRUE(
      awaited([&] { return readFile("/proc/" + std::to_string(pid) + "/comm") == "hand_stop\n"; }));
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE}) ::kill(pid, number);
  program->signal(SIGKILL);
  program->wait();
  EXPECT_TRUE(awaited([this] { return stops() == 3; })) << stops();
}

TEST_F(LastStopTest, TheStopProgramHoldsThePortAndThePipeOnly) {
  const auto program = movedBy({"kill", kStopProgram});
  const fs::path descriptors = "/proc/" + std::to_string(stopProgram()) + "/fd";
  const auto open = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(descriptors))
      names.insert(entry.path().filename());
    return names;
  };
  EXPECT_TRUE(awaited([&] { return open() == std::set<std::string>{"0", "1", "2"}; }));
  EXPECT_TRUE(fs::read_symlink(descriptors / "0").string().starts_with("pipe:"));
  EXPECT_EQ(fs::read_symlink(descriptors / "1"), fs::path(server.path()));
  EXPECT_EQ(fs::read_symlink(descriptors / "2"), fs::path("/dev/null"));
}

TEST_F(LastStopTest, AnOrdinaryEndSendsNoStopAndLeavesNoProcess) {
  const auto program = movedBy({"end", kStopProgram});
  EXPECT_EQ(program->wait(), 0) << program->out();
  EXPECT_TRUE(stopProgramsOf(server.path()).empty());
  EXPECT_EQ(moves(), 1);
  EXPECT_EQ(stops(), 0);
}

TEST_F(LastStopTest, AMissingStopProgramIsSaidAndPreventsNoMotion) {
  const auto program = movedBy({"end", "/no/such/palpate_stop"});
  EXPECT_EQ(program->wait(), 0);
  EXPECT_EQ(
      program->out(),
      "/no/such/palpate_stop: can't be started (No such file or directory): if the program is "
      "killed in a motion, nothing stops the hand; install palpate again\nmoves\n");
  EXPECT_EQ(moves(), 1);
}

TEST(LastStop, WritesBlanksThatEndAHalfRecordOnASerialLineOnly) {
  PtyPair pty;
  BackgroundProgram program(PALPATE_DYING_PROGRAM, {pty.path(), "hold", kStopProgram});
  ASSERT_TRUE(program.awaitLine("moves").has_value());
  program.signal(SIGKILL);
  const std::string serial = repeated(kSerialStop);
  EXPECT_EQ(pty.receive(serial.size(), 20'000), textBytes(serial));

  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  BackgroundProgram network(
      PALPATE_DYING_PROGRAM,
      {"tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port)), "hold", kStopProgram});
  const FileDescriptor connection(::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC));
  ::close(listener);
  ASSERT_TRUE(network.awaitLine("moves").has_value());
  // An answer that nobody reads must not cost the stop.
  ASSERT_EQ(::send(connection.get(), "POS=0\r\n", 7, MSG_NOSIGNAL), 7);
  network.signal(SIGKILL);
  std::string received;
  char piece[256];
  for (ssize_t got = 0; (got = ::read(connection.get(), piece, sizeof piece)) > 0;)
    received.append(piece, static_cast<std::size_t>(got));
  EXPECT_EQ(received, repeated(kStopLine));
}

TEST(LastStop, AHundredConnectionsLeaveNothingOpen) {
  const PtyPair pty;
  stopHandsWhenKilled(kStopProgram);
  const auto connect = [&] {
    const auto channel = openChannel(pty.path());
    const LastStop lastStop(*channel);
    EXPECT_EQ(lastStop.problem(), "");
  };
  connect();
  const std::size_t before = openDescriptors();
  for (int times = 0; times < 100; ++times) connect();
  stopHandsWhenKilled({});
  EXPECT_EQ(openDescriptors(), before);
  EXPECT_TRUE(stopProgramsOf(pty.path()).empty());
}

TEST(StopProgram, IsMissingWhereItCannotBeExecuted) {
  EXPECT_EQ(stopProgramProblem(), "") << "none was asked for";
  stopHandsWhenKilled(kStopProgram);
  EXPECT_EQ(stopProgramProblem(), "");
  stopHandsWhenKilled("/no/such/palpate_stop");
  EXPECT_EQ(stopProgramProblem(),
            "/no/such/palpate_stop: can't be started (No such file or directory): if the program "
            "is killed in a motion, nothing stops the hand; install palpate again");
  stopHandsWhenKilled({});
}

TEST(StopProgram, LoadsTheCLibraryOnly) {
  if (!kMemoryIsOurs) GTEST_SKIP() << "a sanitizer is loaded, too";
  const ProgramResult result = runProgram("/usr/bin/ldd", {kStopProgram});
  std::set<std::string> libraries;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);)
    if (line.find("=>") != std::string::npos) libraries.insert(line.substr(1, line.find(' ') - 1));
  EXPECT_EQ(libraries, std::set<std::string>{"libc.so.6"}) << result.out;
}

}  // namespace
}  // namespace palpate::testing::last_stop_test
