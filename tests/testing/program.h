// Runs a program and collects what it said.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace palpate::testing {

struct ProgramResult {
  int exitCode = -1;  // 128 + signal number when it was killed
  std::string out;
  std::string err;
};

// Waits for the end. `environment` is added to ours; an empty value removes a variable.
ProgramResult runProgram(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments,
                         const std::map<std::string, std::string>& environment = {});

}  // namespace palpate::testing
