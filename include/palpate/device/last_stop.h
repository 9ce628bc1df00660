// The stop of a hand whose program dies while it may move: written to the motion port by the
// program's own crash handler, and by a small program, palpate_stop, that notices the death from
// outside (kill -9, no memory left). docs/notes/safety.md says which deaths are covered.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include <palpate/core/file_descriptor.h>
#include <palpate/device/byte_channel.h>

namespace palpate {

// From now on, a crash of this process (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) first writes a
// stop to the port of each LastStop; then it goes on as before: exit status and core dump are
// unchanged. Covers the stack overflow of the calling thread; other threads need a CrashStack.
void stopHandsInACrash();

// From now on, a LastStop starts `program`: palpate_stop; empty: none, as without this call. Called
// by main(), before there are threads.
void stopHandsWhenKilled(std::filesystem::path program);
// What is wrong if that program is missing or can't be executed, with its path and what to do;
// otherwise empty.
std::string stopProgramProblem();

// The stack on which a crash of this thread is handled: on its own stack there may be no room left.
// A local variable of a thread's first function. A stack that was set before (by a sanitizer)
// stays.
class CrashStack {
 public:
  CrashStack() noexcept;
  ~CrashStack();
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;

 private:
  alignas(16) std::array<std::byte, 32 * 1024> bytes_;
  bool ours_ = false;
};

// Exists while the hand at a port may move. Does nothing for a channel without a descriptor.
class LastStop {
 public:
  // Starts the program of stopHandsWhenKilled() with a duplicate of the channel's descriptor, but
  // not of its lock. The channel must outlive this object. A program that can't be started is no
  // error: see problem().
  explicit LastStop(const ByteChannel& channel);
  // Ends the program, which sends nothing then, and waits for its end.
  ~LastStop();
  LastStop(const LastStop&) = delete;
  LastStop& operator=(const LastStop&) = delete;

  // Why the program doesn't run, with its path and what to do; empty if it runs or none was asked
  // for.
  const std::string& problem() const noexcept { return problem_; }
  // Whether the program still runs, or none was asked for.
  bool isReady() const noexcept;

 private:
  void start(const ByteChannel& channel);

  // Place of the port in the table that the crash handler reads; -1: none.
  int crashPort_ = -1;
  // The only write end of a pipe: the program finds its end when this process has died.
  FileDescriptor alive_;
  int pid_ = -1;
  std::string problem_;
};

}  // namespace palpate
