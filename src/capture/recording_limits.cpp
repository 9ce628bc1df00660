#include "palpate/capture/recording_limits.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/number_text.h"

namespace palpate {
void RecordingLimits::validate() const {
  constexpr OptionCheck check{"RecordingLimits"};
  if (stopAfterS) check(kStopAfterS, "stopAfterS", *stopAfterS);
  if (splitMinutes) check(kSplitMinutes, "splitMinutes", *splitMinutes);
  if (splitMb) check(kSplitMb, "splitMb", *splitMb);
}

void RecordingLimits::applyTo(RecordingOptions& options) const {
  validate();
  options.stopAfterS = stopAfterS;
  options.splitS.reset();
  options.splitBytes.reset();
  // Not below the least that a recorder accepts, to which a rounded sixtieth may come close.
  if (splitMinutes) options.splitS = std::max(1.0, *splitMinutes * 60.0);
  if (splitMb) options.splitBytes = std::llround(*splitMb * 1e6);
}

std::string textOf(const RecordingLimits& limits) {
  std::string text;
  if (limits.stopAfterS) text = "stops after " + numberText(*limits.stopAfterS) + " s";
  if (!limits.splitMinutes && !limits.splitMb) return text;
  text += text.empty() ? "a new file every " : ", a new file every ";
  if (limits.splitMinutes) text += numberText(*limits.splitMinutes) + " min";
  if (limits.splitMinutes && limits.splitMb) text += " or ";
  if (limits.splitMb) text += numberText(*limits.splitMb) + " MB";
  return text;
}

}  // namespace palpate
