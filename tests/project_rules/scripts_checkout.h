// The scripts in a checkout of their own, with apt, CMake, ninja and palpate played by stand-ins
// that write down how they were called.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing {

class Scripts : public ::testing::Test {
 protected:
  // One package is missing, nothing is configured or built, there is room for everything.
  void SetUp() override;

  // A line of shell that writes down a call: "NAME ARGUMENTS".
  std::string log(const std::string& name) const;
  // Puts a program into the only folder where the scripts look for programs.
  void standIn(const std::string& name, const std::string& body);
  // apt-get that answers the question what it would do with `plan`, and does `body` else.
  void standInApt(const std::string& body, const std::string& plan = "", int planExit = 1);
  // Calls a script in a folder that isn't the checkout; the log starts anew.
  ProgramResult call(const std::string& script,
                     std::vector<std::string> arguments = {},
                     std::map<std::string, std::string> environment = {});
  std::string logged() const { return readFile(folder_ / "log"); }

  TemporaryFolder folder_;
  std::filesystem::path checkout_;  // its name has blanks and an umlaut
  std::filesystem::path tools_;
};

}  // namespace palpate::testing
