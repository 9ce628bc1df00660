// What `palpate grasp` prints, in parts.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/number_text.h"

namespace palpate::testing {

// The states of the lines "SECONDS STATE[: TEXT]", in order, without those of the hand.
inline std::vector<std::string> statesOf(const std::string& out) {
  std::vector<std::string> states;
  std::istringstream lines(out);
  double before = 0.0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    const auto seconds = parseDouble(line.substr(0, blank));
    EXPECT_TRUE(seconds.has_value()) << line;
    EXPECT_GE(seconds.value_or(-1.0), before) << line;
    before = seconds.value_or(before);
    const std::string rest = line.substr(blank + 1);
    if (!rest.starts_with("hand: ")) states.push_back(rest.substr(0, rest.find(':')));
  }
  return states;
}

// The words of the lines "SECONDS hand: WORD[: TEXT]".
inline std::vector<std::string> handOf(const std::string& out) {
  std::vector<std::string> words;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find(" hand: ");
    if (begin == std::string::npos) continue;
    const std::string rest = line.substr(begin + 7);
    words.push_back(rest.substr(0, rest.find(':')));
  }
  return words;
}

using States = std::vector<std::string>;

}  // namespace palpate::testing
