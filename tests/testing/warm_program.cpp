#include "testing/warm_program.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "testing/testing.h"

namespace palpate::testing {
namespace {

using Words = std::vector<std::string>;

// What a run gets, as words: the folder, the files of its output and errors, its environment, its
// arguments.
struct Request {
  Words places;
  Words environment;
  Words arguments;
};

// False: the other end is closed.
bool sendAll(int socket, const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket, next, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    next += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receiveAll(int socket, void* data, std::size_t size) {
  char* next = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t received = ::recv(socket, next, size, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    next += received;
    size -= static_cast<std::size_t>(received);
  }
  return true;
}

bool sendWords(int socket, const Words& words) {
  const std::uint64_t count = words.size();
  if (!sendAll(socket, &count, sizeof count)) return false;
  for (const std::string& word : words) {
    const std::uint64_t size = word.size();
    if (!sendAll(socket, &size, sizeof size) || !sendAll(socket, word.data(), word.size()))
      return false;
  }
  return true;
}

bool receiveWords(int socket, Words& words) {
  std::uint64_t count = 0;
  if (!receiveAll(socket, &count, sizeof count)) return false;
  words.resize(count);
  for (std::string& word : words) {
    std::uint64_t size = 0;
    if (!receiveAll(socket, &size, sizeof size)) return false;
    word.resize(size);
    if (!receiveAll(socket, word.data(), size)) return false;
  }
  return true;
}

[[noreturn]] void runHere(WarmProgram::Main main, Request& request) {
  if (::chdir(request.places[0].c_str()) != 0) std::_Exit(127);
  redirectStreams(request.places[1], request.places[2]);
  ::clearenv();
  for (std::string& variable : request.environment) ::putenv(variable.data());
  std::vector<char*> argv;
  for (std::string& word : request.arguments) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int code = main(static_cast<int>(request.arguments.size()), argv.data());
  // Without the ends of what this process began before: threads that a copy doesn't have.
  std::fflush(nullptr);
  std::_Exit(code);
}

[[noreturn]] void serve(int socket, WarmProgram::Main main) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  Request request;
  while (receiveWords(socket, request.places) && receiveWords(socket, request.environment) &&
         receiveWords(socket, request.arguments)) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(socket);
      runHere(main, request);
    }
    int status = -1;
    if (child < 0 || ::waitpid(child, &status, 0) != child) std::_Exit(1);
    if (!sendAll(socket, &status, sizeof status)) break;
  }
  std::_Exit(0);
}

}  // namespace

WarmProgram::WarmProgram(std::string name, Main main) : name_(std::move(name)) {
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error("socketpair failed");
  server_ = ::fork();
  if (server_ < 0) throw std::runtime_error("fork failed");
  if (server_ == 0) {
    ::close(ends[0]);
    serve(ends[1], main);
  }
  ::close(ends[1]);
  socket_ = ends[0];
}

WarmProgram::~WarmProgram() {
  ::close(socket_);
  ::waitpid(server_, nullptr, 0);
}

ProgramResult WarmProgram::run(const std::vector<std::string>& arguments,
                               const std::map<std::string, std::string>& environment) {
  const TemporaryFolder folder;
  const std::string outPath = folder / "out";
  const std::string errPath = folder / "err";
  Request request{{std::filesystem::current_path().string(), outPath, errPath}, {}, {name_}};
  for (char** variable = environ; *variable; ++variable) {
    const std::string text = *variable;
    if (!environment.contains(text.substr(0, text.find('=')))) request.environment.push_back(text);
  }
  for (const auto& [name, value] : environment)
    if (!value.empty()) request.environment.push_back(name + "=" + value);
  request.arguments.insert(request.arguments.end(), arguments.begin(), arguments.end());
  int status = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!sendWords(socket_, request.places) || !sendWords(socket_, request.environment) ||
        !sendWords(socket_, request.arguments) || !receiveAll(socket_, &status, sizeof status))
      throw std::runtime_error("the warm program has ended");
  }
  return resultOf(status, outPath, errPath);
}

}  // namespace palpate::testing
