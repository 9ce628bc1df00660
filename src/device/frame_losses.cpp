#include "palpate/device/frame_losses.h"

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {

std::string textOf(const FrameLosses& losses) {
  std::string text;
  const auto add = [&](std::int64_t count, const std::string& part, const std::string& last) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + part;
    if (!last.empty()) text += " (the last: " + escapedLine(last) + ")";
  };
  const auto frames = [](std::int64_t count) {
    return counted(static_cast<std::uint64_t>(count), "frame");
  };
  add(losses.lost, frames(losses.lost) + " lost on the way", "");
  add(losses.refused, std::to_string(losses.refused) + " refused", losses.lastRefused);
  add(losses.outOfRange,
      frames(losses.outOfRange) + " with values outside the hand's range",
      losses.lastOutOfRange);
  return text;
}

}  // namespace palpate
