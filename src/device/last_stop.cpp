#include "palpate/device/last_stop.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "device/sdh_link.h"

extern char** environ;

namespace palpate {
namespace {

// --- In a crash. Only functions that are safe in a signal handler are called, and no memory is
// taken.

// A port to which a crash writes a stop.
struct CrashPort {
  std::atomic<bool> taken = false;
  std::atomic<int> fd = -1;
  std::atomic<bool> isNetwork = false;
};
// More than hands that one process moves.
std::array<CrashPort, 16> crashPorts;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

constexpr std::array<int, 5> kCrashSignals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
std::array<struct sigaction, kCrashSignals.size()> actionsBefore;

// Writes the bytes, or gives up after 100 ms in which the port takes none.
void writeInACrash(int fd, bool isNetwork, std::string_view bytes) {
  for (int tries = 0; tries < 20 && !bytes.empty(); ++tries) {
    const ssize_t written = isNetwork ? ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                      : ::write(fd, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    if (errno != EINTR && errno != EAGAIN) return;
    pollfd wait{fd, POLLOUT, 0};
    ::poll(&wait, 1, 5);
  }
}

extern "C" void handleCrash(int number, siginfo_t* facts, void*) {
  for (int times = 0; times < 3; ++times)
    for (const CrashPort& port : crashPorts)
      if (const int fd = port.fd; fd >= 0)
        writeInACrash(fd, port.isNetwork, sdhStopBytes(!port.isNetwork));
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    if (kCrashSignals[i] == number) ::sigaction(number, &actionsBefore[i], nullptr);
  // A fault of the machine occurs again when the handler returns, with the same registers, for the
  // action of before. A signal that was sent (abort, kill) doesn't.
  if (facts->si_code <= 0) ::raise(number);
}

// Duplicates a descriptor under a number above those of the standard streams.
FileDescriptor aboveStreams(int fd) {
  return FileDescriptor(::fcntl(fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
}

std::filesystem::path& stopProgram() {
  static std::filesystem::path program;
  return program;
}

std::string lastStopProblem(int error) {
  return stopProgram().string() + ": can't be started (" + std::generic_category().message(error) +
         "): if the program is killed in a motion, nothing stops the hand; install palpate again";
}

}  // namespace

void stopHandsInACrash() {
  static const CrashStack stack;
  struct sigaction action {};
  action.sa_sigaction = &handleCrash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    ::sigaction(kCrashSignals[i], &action, &actionsBefore[i]);
}

void stopHandsWhenKilled(std::filesystem::path program) {
  // Where SIGCHLD is ignored, as some launchers leave it, the number of a child that has ended may
  // become that of another process.
  std::signal(SIGCHLD, SIG_DFL);
  stopProgram() = std::move(program);
}

std::string stopProgramProblem() {
  const bool missing = !stopProgram().empty() && ::access(stopProgram().c_str(), X_OK) != 0;
  return missing ? lastStopProblem(errno) : std::string();
}

CrashStack::CrashStack() noexcept {
  stack_t before{};
  if (::sigaltstack(nullptr, &before) != 0 || (before.ss_flags & SS_DISABLE) == 0) return;
  stack_t stack{};
  stack.ss_sp = bytes_.data();
  stack.ss_size = bytes_.size();
  ours_ = ::sigaltstack(&stack, nullptr) == 0;
}

CrashStack::~CrashStack() {
  if (!ours_) return;
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  ::sigaltstack(&none, nullptr);
}

LastStop::LastStop(const ByteChannel& channel) {
  if (channel.descriptor() < 0) return;
  if (!stopProgram().empty()) start(channel);
  for (std::size_t i = 0; i < crashPorts.size() && crashPort_ < 0; ++i) {
    CrashPort& port = crashPorts[i];
    if (port.taken.exchange(true)) continue;
    port.isNetwork = channel.isNetwork();
    port.fd = channel.descriptor();
    crashPort_ = static_cast<int>(i);
  }
}

LastStop::~LastStop() {
  if (crashPort_ >= 0) {
    CrashPort& port = crashPorts[static_cast<std::size_t>(crashPort_)];
    port.fd = -1;
    port.taken = false;
  }
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool LastStop::isReady() const noexcept {
  if (pid_ < 0) return problem_.empty();
  siginfo_t ended{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0;
}

void LastStop::start(const ByteChannel& channel) {
  int error = 0;
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) error = errno;
  FileDescriptor read(ends[0]), alive(ends[1]);
  const FileDescriptor death = aboveStreams(read.get());
  const FileDescriptor port = aboveStreams(channel.descriptor());
  if (error == 0 && (death.get() < 0 || port.get() < 0)) error = EMFILE;
  if (error == 0) {
    // All that it inherits is the read end and the port; it closes whatever else is open.
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    error = posix_spawn_file_actions_adddup2(&files, death.get(), STDIN_FILENO);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&files, port.get(), STDOUT_FILENO);
    if (error == 0)
      error = posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // A session of its own: no signal of a terminal reaches it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    std::string name = "hand_stop", bytes(sdhStopBytes(!channel.isNetwork()));
    std::array<char*, 3> words = {name.data(), bytes.data(), nullptr};
    if (error == 0)
      error =
          ::posix_spawn(&pid_, stopProgram().c_str(), &files, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
  }
  if (error == 0) {
    alive_ = std::move(alive);
    return;
  }
  pid_ = -1;
  problem_ = lastStopProblem(error);
}

}  // namespace palpate
