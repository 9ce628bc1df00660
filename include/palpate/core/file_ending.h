// What kind of file a name says it is.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace palpate {

// The ending of a name in small letters, with its dot; empty: none.
inline std::string lowerEndingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return ending;
}

}  // namespace palpate
