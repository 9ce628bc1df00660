#include "palpate/capture/contact_trigger.h"

namespace palpate {
void ContactTriggerOptions::validate() const {
  constexpr OptionCheck check{"ContactTriggerOptions"};
  constexpr OptionRange kCount{1, 1e6};
  check(kThreshold, "threshold", threshold);
  check(kCount, "taxels", taxels);
  check(kCount, "frames", frames);
}

ContactTrigger::ContactTrigger(const ContactTriggerOptions& options) : options_(options) {
  options_.validate();
}

bool ContactTrigger::touches(const TactileFrame& frame) const noexcept {
  int touching = 0;
  for (const float value : frame.values)
    if (static_cast<double>(value) > options_.threshold && ++touching >= options_.taxels)
      return true;
  return false;
}

void ContactTrigger::add(const TactileFrame& frame) {
  if (!touches(frame)) {
    inRow_ = 0;
    touchingSinceUs_.reset();
    if (firstContactUs_ && !releasedUs_) releasedUs_ = frame.hostUs;
    return;
  }
  if (!touchingSinceUs_) touchingSinceUs_ = frame.hostUs;
  if (inRow_ < options_.frames) ++inRow_;
  if (inRow_ < options_.frames) return;
  if (!firstContactUs_) firstContactUs_ = touchingSinceUs_;
  releasedUs_.reset();
}

}  // namespace palpate
