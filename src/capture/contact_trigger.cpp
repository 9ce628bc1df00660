#include "palpate/capture/contact_trigger.h"

#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr int kMostContactCount = 1'000'000;

void requireContactOption(bool right, const char* rule) {
  if (!right) throw std::invalid_argument(std::string("ContactTriggerOptions: ") + rule);
}

}  // namespace

void ContactTriggerOptions::validate() const {
  requireContactOption(threshold >= 0.0 && threshold <= 1e9, "threshold must be 0..1e9");
  requireContactOption(taxels >= 1 && taxels <= kMostContactCount, "taxels must be 1..1000000");
  requireContactOption(frames >= 1 && frames <= kMostContactCount, "frames must be 1..1000000");
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
