// Pieces of messages about recordings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "palpate/core/escaped_line.h"

namespace palpate {

// Text of a file as shown in a message: in quotes, cut to a bearable length.
inline std::string inQuotes(std::string_view text) {
  constexpr std::size_t kShown = 40;
  return "\"" + escapedLine(beginningOf(text, kShown)) + (text.size() > kShown ? "..\"" : "\"");
}

// "1 frame", "2 frames".
inline std::string counted(std::uint64_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

}  // namespace palpate
