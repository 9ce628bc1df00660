// Undo and redo of changes to sensitivities and thresholds: keeps what the controller had before
// each change. It sends nothing; the caller applies the returned settings with the same checks as
// any others (GraspControl::change).
#pragma once

#include <optional>
#include <vector>

#include <palpate/control/tactile_settings.h>

namespace palpate {

class TactileSettingsHistory {
 public:
  static constexpr std::size_t kMaxSteps = 100;

  // Call this before a change, with the settings that the controller has. What could be redone is
  // forgotten.
  void changing(const TactileSettings& now);
  // The settings before the last change that differ from `now`; nothing when there are none.
  std::optional<TactileSettings> undo(const TactileSettings& now);
  std::optional<TactileSettings> redo(const TactileSettings& now);
  bool canUndo(const TactileSettings& now) const { return differs(undo_, now); }
  bool canRedo(const TactileSettings& now) const { return differs(redo_, now); }
  // Another hand: its settings must not be restored on this one.
  void clear();

 private:
  using Steps = std::vector<TactileSettings>;
  static bool differs(const Steps& steps, const TactileSettings& now);
  static std::optional<TactileSettings> take(Steps& from, Steps& to, const TactileSettings& now);

  Steps undo_;  // the oldest first
  Steps redo_;
};

}  // namespace palpate
