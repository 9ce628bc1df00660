// The order of names with numbers, and the ending of a file name.
#pragma once

#include <algorithm>
#include <cctype>
#include <compare>
#include <filesystem>
#include <string>
#include <string_view>

namespace palpate {

// Orders names with numbers by the value of the numbers ("run_2" before "run_10"), for lists of
// ports and recordings. Compares byte by byte, but consecutive digits as one number of any length.
// Leading zeros matter only when everything else is equal. The comparison is case-sensitive; pass
// lower-case names to ignore case.
std::strong_ordering naturalOrder(std::string_view left, std::string_view right) noexcept;

// Returns the ending of a name in lower-case letters, with its dot, from which the kind of a file
// follows; empty when there is none.
inline std::string lowerEndingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return ending;
}

}  // namespace palpate
