#include "commands/picture_size.h"

#include "palpate/core/number_text.h"

#include "commands/command_line.h"

namespace palpate::commands {

QSize parsedSize(const std::string& text, const QSize& smallest) {
  constexpr int kLargestSide = 8192;
  const auto cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parseInteger(text.substr(0, cross));
    const auto height = parseInteger(text.substr(cross + 1));
    const auto fits = [](const auto& side, int least) {
      return side && *side >= least && *side <= kLargestSide;
    };
    if (fits(width, smallest.width()) && fits(height, smallest.height()))
      return {static_cast<int>(*width), static_cast<int>(*height)};
  }
  throw UsageError("--size must be WIDTHxHEIGHT in pixels, " + std::to_string(smallest.width()) +
                   "x" + std::to_string(smallest.height()) + " to 8192x8192, not '" + text + "'");
}

}  // namespace palpate::commands
