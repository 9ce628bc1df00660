#include "commands/picture_size.h"

#include "palpate/core/number_text.h"

#include "commands/command_line.h"

namespace palpate::commands {

QSize parsedSize(const std::string& text) {
  constexpr std::int64_t kSmallestSide = 320;
  constexpr std::int64_t kLargestSide = 8192;
  const auto cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parseInteger(text.substr(0, cross));
    const auto height = parseInteger(text.substr(cross + 1));
    const auto fits = [](const auto& side) {
      return side && *side >= kSmallestSide && *side <= kLargestSide;
    };
    if (fits(width) && fits(height)) return {static_cast<int>(*width), static_cast<int>(*height)};
  }
  throw UsageError("--size must be WIDTHxHEIGHT in pixels, 320..8192 each, not '" + text + "'");
}

}  // namespace palpate::commands
