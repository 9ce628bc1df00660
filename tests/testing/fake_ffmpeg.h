// Replaces ffmpeg in tests by a shell script that does what the test needs.
#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "testing/testing.h"

namespace palpate::testing {

// As long as this object exists, findFfmpeg() finds the script.
class FakeFfmpeg {
 public:
  // Reads all pictures and writes a movie with the content "whole".
  static constexpr const char* kGood = "cat > \"$here/pixels\"; printf whole > /proc/self/fd/3";

  // `body`: the commands of a shell script, where $here is a folder of its own. `encoders`: the
  // encoders that the script lists.
  explicit FakeFfmpeg(const std::string& body = kGood,
                      const std::string& encoders = " V....D libx264 x\\n V.S... mpeg4 y\\n") {
    if (const char* before = std::getenv(kVariable)) before_ = before;
    const auto program = folder_ / "a fake 'ffmpeg'";
    writeFile(program,
              "#!/bin/sh\nhere='" + folder_.path().string() +
                  "'\n"
                  "case \"$*\" in *-encoders*) printf '" +
                  encoders +
                  "'; exit 0;; esac\n"
                  "printf '%s\\0' \"$@\" > \"$here/words\"; echo $$ > \"$here/pid\"\n" +
                  body + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ::setenv(kVariable, program.c_str(), 1);
  }
  ~FakeFfmpeg() {
    if (before_)
      ::setenv(kVariable, before_->c_str(), 1);
    else
      ::unsetenv(kVariable);
  }
  FakeFfmpeg(const FakeFfmpeg&) = delete;
  FakeFfmpeg& operator=(const FakeFfmpeg&) = delete;

  std::filesystem::path file(std::string_view name) const { return folder_ / name; }
  bool wasCalled() const { return std::filesystem::exists(file("pid")); }
  // The arguments that it was called with.
  std::vector<std::string> words() const {
    std::vector<std::string> all;
    std::istringstream text(readFile(file("words")));
    for (std::string word; std::getline(text, word, '\0');) all.push_back(word);
    return all;
  }
  // The argument after `option`.
  std::string wordAfter(const std::string& option) const {
    const auto all = words();
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (all[i] == option) return all[i + 1];
    return {};
  }
  // Whether the process whose number the script wrote into the file `name` still runs (a zombie
  // does not).
  bool runs(std::string_view name) const {
    std::string pid = readFile(file(name));
    pid.erase(pid.find_last_not_of(" \n") + 1);
    std::ifstream status("/proc/" + pid + "/stat");
    std::string text;
    if (!std::getline(status, text)) return false;
    const auto behindName = text.rfind(')');  // "1234 (sh) S 1 .."
    return text.substr(behindName + 2, 1) != "Z";
  }
  // Waits until a killed process that nobody waits for is gone; returns whether it is.
  bool ends(std::string_view name) const {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (runs(name) && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
    return !runs(name);
  }

 private:
  static constexpr const char* kVariable = "PALPATE_FFMPEG";
  TemporaryFolder folder_;
  std::optional<std::string> before_;
};

}  // namespace palpate::testing
