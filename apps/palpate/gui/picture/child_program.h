// Another program that is fed bytes: without a shell, so that no name needs quoting; what it says
// is kept; it never outlives us by neglect.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

#include <palpate/core/file_descriptor.h>

namespace palpate::gui {

class ChildProgram {
 public:
  // Asked every 50 ms while we wait; false: what is waited for throws Cancelled.
  using KeepGoing = std::function<bool()>;

  // Where the program finds `descriptor` of ours.
  static constexpr int kPassedAs = 3;
  // Starts it in a process group of its own (Ctrl-C in a terminal is ours to answer). descriptor:
  // open in the program as kPassedAs; -1: none. Throws Error: no such program, not to be executed,
  // ..
  ChildProgram(const std::filesystem::path& program,
               const std::vector<std::string>& arguments,
               int descriptor = -1);
  // Killed with all that it started, and waited for, unless finish() has returned.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  // Writes all of it to its standard input. False: it reads no more, see finish(). Throws
  // Cancelled.
  bool write(std::span<const std::byte> bytes, const KeepGoing& keepGoing = {});
  // Ends its standard input and waits for its end; what it started and left running is killed.
  // Returns the exit code, 128 + signal when it was killed. Throws Cancelled.
  int finish(const KeepGoing& keepGoing = {});
  // What it has said so far, on standard output and error; of very much the end.
  const std::string& said() const noexcept { return said_; }

 private:
  // Waits until its input takes more or it says something, 50 ms at most.
  void wait(bool toWrite);
  void kill();

  pid_t pid_ = -1;         // -1: ended, and waited for
  FileDescriptor input_;   // a socket: writing to it raises no SIGPIPE
  FileDescriptor output_;  // none: it has closed its own
  std::string said_;
};

}  // namespace palpate::gui
