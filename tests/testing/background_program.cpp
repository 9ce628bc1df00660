#include "testing/background_program.h"

#include <csignal>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpate::testing {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLook{5};

int codeOf(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

BackgroundProgram::BackgroundProgram(const std::filesystem::path& program,
                                     const std::vector<std::string>& arguments) {
  const std::string outPath = folder_ / "out";
  const std::string errPath = folder_ / "err";
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(::open(outPath.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600), STDOUT_FILENO);
    ::dup2(::open(errPath.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
}

BackgroundProgram::~BackgroundProgram() {
  if (ended_) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

std::string BackgroundProgram::out() const {
  return std::filesystem::exists(folder_ / "out") ? readFile(folder_ / "out") : std::string();
}

std::string BackgroundProgram::err() const {
  return std::filesystem::exists(folder_ / "err") ? readFile(folder_ / "err") : std::string();
}

std::optional<std::string> BackgroundProgram::awaitLine(const std::string& text,
                                                        std::chrono::milliseconds limit) {
  const auto end = Clock::now() + limit;
  while (true) {
    const bool over = ended_.has_value() || Clock::now() > end;
    const std::string said = out();
    std::size_t at = 0;
    for (std::size_t stop = said.find('\n'); stop != std::string::npos;
         stop = said.find('\n', at)) {
      const std::string line = said.substr(at, stop - at);
      if (line.find(text) != std::string::npos) return line;
      at = stop + 1;
    }
    if (over) return std::nullopt;
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) ended_ = codeOf(status);
    std::this_thread::sleep_for(kLook);
  }
}

void BackgroundProgram::signal(int number) {
  if (!ended_) ::kill(pid_, number);
}

int BackgroundProgram::wait(std::chrono::milliseconds limit) {
  const auto end = Clock::now() + limit;
  while (!ended_) {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) {
      ended_ = codeOf(status);
      break;
    }
    if (Clock::now() > end) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
      ended_ = -1;
      break;
    }
    std::this_thread::sleep_for(kLook);
  }
  return *ended_;
}

}  // namespace palpate::testing
