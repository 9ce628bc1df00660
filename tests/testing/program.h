// Runs a program in a test and collects its output.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace palpate::testing {

// The exit code and the output of a program.
struct ProgramResult {
  // 128 + signal number when the program was killed.
  int exitCode = -1;
  std::string out;
  std::string err;
};

// Runs a program and waits for its end. `environment` is added to that of the test; an empty value
// removes a variable.
ProgramResult runProgram(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments,
                         const std::map<std::string, std::string>& environment = {});

// What both ways of running a program need. In the new process: nothing to read, and files of its
// output and errors.
void redirectStreams(const std::string& outPath, const std::string& errPath);
// Of the status that waitpid() gives.
ProgramResult resultOf(int status, const std::string& outPath, const std::string& errPath);

}  // namespace palpate::testing
