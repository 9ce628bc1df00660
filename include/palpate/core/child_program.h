// Runs another program, writes bytes to its standard input and keeps its output. No shell is
// involved, so no file name needs quoting. The program is killed when this object is destroyed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/file_descriptor.h>

namespace palpate {

class ChildProgram {
 public:
  // Called every 50 ms during a wait; when it returns false, the waiting function throws Cancelled.
  using KeepGoing = std::function<bool()>;

  // Number under which the program finds the first of `descriptors`; the others follow it.
  static constexpr int kPassedAs = 3;
  // Starts the program in a process group of its own, so that Ctrl-C in a terminal reaches only
  // Palpate. Throws Error: no such program, not executable, ..
  ChildProgram(const std::filesystem::path& program,
               const std::vector<std::string>& arguments,
               const std::vector<int>& descriptors = {});
  // Unless finish() has returned, kills the program and all processes that it started, and waits
  // for it.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  // Writes all bytes to the program's standard input. Returns false when the program has closed it;
  // finish() then gives the exit code. Throws Cancelled.
  bool write(std::span<const std::byte> bytes, const KeepGoing& keepGoing = {});
  // Closes the standard input and waits until the program ends; processes that it started and left
  // running are killed. Returns the exit code, or 128 + signal when it was killed. Throws
  // Cancelled.
  int finish(const KeepGoing& keepGoing = {});
  // What the program has written so far to standard output and error; of a very long text only the
  // end.
  const std::string& said() const noexcept { return said_; }

 private:
  // Waits up to 50 ms until the program takes more input or writes something.
  void wait(bool toWrite);
  void kill();

  // The process id (pid_t); -1: the program has ended and was waited for.
  int pid_ = -1;
  // A socket, since writing to it raises no SIGPIPE.
  FileDescriptor input_;
  // Invalid once the program has closed its output.
  FileDescriptor output_;
  std::string said_;
};

}  // namespace palpate
