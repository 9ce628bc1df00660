#include "palpate/core/child_program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"

extern char** environ;

namespace palpate {
namespace {

constexpr int kPatienceMs = 50;
constexpr std::size_t kMaxSaid = 256 * 1024;  // [bytes] kept of the output
// Above all descriptors that the program receives.
constexpr int kFirstFree = 10;

std::string childProgramMessageOf(int error) { return std::generic_category().message(error); }

// Duplicates the descriptor under a higher number, which isn't overwritten when it becomes one of
// the program's own.
FileDescriptor movedUp(int descriptor) {
  const int higher = ::fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstFree);
  if (higher < 0) throw Error("too many files are open: " + childProgramMessageOf(errno));
  return FileDescriptor(higher);
}

// The descriptors that the program inherits; all others of this process are closed when it starts.
class SpawnPlan {
 public:
  SpawnPlan() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    sigset_t usual;
    sigemptyset(&usual);
    for (const int each : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&usual, each);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  void give(int ours, int theirs) { posix_spawn_file_actions_adddup2(&files, ours, theirs); }

  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
};

void ask(const ChildProgram::KeepGoing& keepGoing) {
  if (keepGoing && !keepGoing()) throw Cancelled();
}

}  // namespace

ChildProgram::ChildProgram(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments,
                           const std::vector<int>& descriptors) {
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    throw Error(program.string() + " can't be started: " + childProgramMessageOf(errno));
  FileDescriptor input(sockets[0]);
  FileDescriptor theirInput(sockets[1]);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw Error(program.string() + " can't be started: " + childProgramMessageOf(errno));
  FileDescriptor output(pipe[0]);
  FileDescriptor theirOutput(pipe[1]);
  theirInput = movedUp(theirInput.get());
  theirOutput = movedUp(theirOutput.get());
  ::fcntl(output.get(), F_SETFL, O_NONBLOCK);
  SpawnPlan plan;
  plan.give(theirInput.get(), STDIN_FILENO);
  plan.give(theirOutput.get(), STDOUT_FILENO);
  plan.give(theirOutput.get(), STDERR_FILENO);
  // These come last: their numbers may be ones that are assigned above.
  std::vector<FileDescriptor> passed;
  for (const int each : descriptors) {
    passed.push_back(movedUp(each));
    plan.give(passed.back().get(), kPassedAs + static_cast<int>(passed.size()) - 1);
  }

  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv = {name.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int failure =
      ::posix_spawn(&pid_, name.c_str(), &plan.files, &plan.attributes, argv.data(), environ);
  if (failure != 0) {
    pid_ = -1;
    throw Error(program.string() + " can't be started: " + childProgramMessageOf(failure));
  }
  input_ = std::move(input);
  output_ = std::move(output);
}

ChildProgram::~ChildProgram() { kill(); }

void ChildProgram::kill() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

void ChildProgram::wait(bool toWrite) {
  std::array<pollfd, 2> polled = {pollfd{output_.get(), POLLIN, 0},
                                  pollfd{toWrite ? input_.get() : -1, POLLOUT, 0}};
  if (::poll(polled.data(), polled.size(), kPatienceMs) <= 0 || polled[0].revents == 0) return;
  std::array<char, 4096> piece{};
  const ssize_t count = ::read(output_.get(), piece.data(), piece.size());
  if (count > 0) {
    said_.append(piece.data(), static_cast<std::size_t>(count));
    if (said_.size() > 2 * kMaxSaid) said_.erase(0, said_.size() - kMaxSaid);
  } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
    output_ = FileDescriptor();
  }
}

bool ChildProgram::write(std::span<const std::byte> bytes, const KeepGoing& keepGoing) {
  while (!bytes.empty()) {
    if (input_.get() < 0) return false;
    const ssize_t written =
        ::send(input_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (written > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      continue;
    }
    if (errno == EPIPE || errno == ECONNRESET) {
      input_ = FileDescriptor();
      return false;
    }
    if (errno != EAGAIN && errno != EINTR)
      throw Error("can't write to the program: " + childProgramMessageOf(errno));
    ask(keepGoing);
    wait(true);
  }
  return true;
}

int ChildProgram::finish(const KeepGoing& keepGoing) {
  input_ = FileDescriptor();
  int status = 0;
  while (pid_ >= 0) {
    // WNOWAIT leaves the program a zombie: until it is waited for, its process id and group id
    // can't be reused.
    siginfo_t facts{};
    const int asked = ::waitid(P_PID, static_cast<id_t>(pid_), &facts, WEXITED | WNOHANG | WNOWAIT);
    if (asked == 0 && facts.si_pid == pid_) {
      ::kill(-pid_, SIGKILL);
      while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
      }
      pid_ = -1;
    } else if (asked != 0 && errno != EINTR) {
      pid_ = -1;
      throw Error("can't wait for the program to end: " + childProgramMessageOf(errno));
    } else {
      ask(keepGoing);
      wait(false);
    }
  }
  // Reads the last output, which is still in the pipe.
  for (std::size_t before = said_.size() + 1; output_.get() >= 0 && before != said_.size();) {
    before = said_.size();
    wait(false);
  }
  constexpr int kKilled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kKilled + WTERMSIG(status);
}

}  // namespace palpate
