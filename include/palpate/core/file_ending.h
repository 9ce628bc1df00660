// The ending of a file name, from which the kind of a file follows.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace palpate {

// Returns the ending of a name in lower-case letters, with its dot; empty when there is none.
inline std::string lowerEndingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return ending;
}

}  // namespace palpate
