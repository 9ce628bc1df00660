#include "palpate/control/tactile_settings_history.h"

#include <algorithm>

namespace palpate {

void TactileSettingsHistory::changing(const TactileSettings& now) {
  redo_.clear();
  if (now.empty() || (!undo_.empty() && undo_.back() == now)) return;
  if (undo_.size() == kMaxSteps) undo_.erase(undo_.begin());
  undo_.push_back(now);
}

bool TactileSettingsHistory::differs(const Steps& steps, const TactileSettings& now) {
  return std::any_of(steps.begin(), steps.end(), [&](const TactileSettings& each) {
    return each != now && each.size() == now.size();
  });
}

std::optional<TactileSettings> TactileSettingsHistory::take(Steps& from,
                                                            Steps& to,
                                                            const TactileSettings& now) {
  if (!differs(from, now)) return std::nullopt;
  // A change that was refused left its settings behind without having changed anything.
  while (from.back() == now || from.back().size() != now.size()) from.pop_back();
  TactileSettings wanted = std::move(from.back());
  from.pop_back();
  to.push_back(now);
  return wanted;
}

std::optional<TactileSettings> TactileSettingsHistory::undo(const TactileSettings& now) {
  return take(undo_, redo_, now);
}

std::optional<TactileSettings> TactileSettingsHistory::redo(const TactileSettings& now) {
  return take(redo_, undo_, now);
}

void TactileSettingsHistory::clear() {
  undo_.clear();
  redo_.clear();
}

}  // namespace palpate
