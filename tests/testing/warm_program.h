// Runs a program many times without loading its libraries each time: a process that has loaded
// them, forked while it has a single thread, forks again for each run and calls the program's main.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <sys/types.h>

#include "testing/program.h"

namespace palpate::testing {

class WarmProgram {
 public:
  using Main = int (*)(int argc, char** argv);

  // `name` becomes argv[0]; `main` must flush what it prints by C++ streams. To be made before this
  // process has threads whose locks it could hold.
  WarmProgram(std::string name, Main main);
  ~WarmProgram();
  WarmProgram(const WarmProgram&) = delete;
  WarmProgram& operator=(const WarmProgram&) = delete;

  // As runProgram(): with the environment and the folder that this process has now. Calls of
  // several threads wait for one another.
  ProgramResult run(const std::vector<std::string>& arguments,
                    const std::map<std::string, std::string>& environment);

 private:
  std::string name_;
  std::mutex mutex_;
  int socket_ = -1;
  pid_t server_ = -1;
};

}  // namespace palpate::testing
