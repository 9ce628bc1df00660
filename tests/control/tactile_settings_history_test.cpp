#include "palpate/control/tactile_settings_history.h"

#include <gtest/gtest.h>

namespace palpate::tactile_settings_history_test {
namespace {

TactileSettings threshold(int counts) { return TactileSettings(6, {0.5, counts}); }

TEST(TactileSettingsHistory, GoesBackAndForthThroughWhatTheControllerHad) {
  TactileSettingsHistory history;
  EXPECT_FALSE(history.canUndo(threshold(150)));
  history.changing(threshold(150));  // to 200
  history.changing(threshold(200));  // to 300
  EXPECT_EQ(history.undo(threshold(300)), threshold(200));
  EXPECT_EQ(history.undo(threshold(200)), threshold(150));
  EXPECT_EQ(history.undo(threshold(150)), std::nullopt);
  EXPECT_EQ(history.redo(threshold(150)), threshold(200));
  EXPECT_EQ(history.redo(threshold(200)), threshold(300));
  EXPECT_FALSE(history.canRedo(threshold(300)));
}

TEST(TactileSettingsHistory, ANewChangeForgetsWhatCouldBeRedone) {
  TactileSettingsHistory history;
  history.changing(threshold(150));
  EXPECT_EQ(history.undo(threshold(200)), threshold(150));
  EXPECT_TRUE(history.canRedo(threshold(150)));
  history.changing(threshold(150));
  EXPECT_FALSE(history.canRedo(threshold(400)));
  EXPECT_EQ(history.undo(threshold(400)), threshold(150));
}

// A refused change left everything as it was: its step would undo nothing.
TEST(TactileSettingsHistory, SkipsWhatChangedNothing) {
  TactileSettingsHistory history;
  history.changing(threshold(100));
  history.changing(threshold(150));  // refused
  EXPECT_TRUE(history.canUndo(threshold(150)));
  EXPECT_EQ(history.undo(threshold(150)), threshold(100));
}

TEST(TactileSettingsHistory, IsBoundedAndKeepsNothingOfAnotherHand) {
  TactileSettingsHistory history;
  for (int i = 0; i < 1000; ++i) history.changing(threshold(i));
  std::size_t steps = 0;
  for (TactileSettings now = threshold(4000); history.canUndo(now); ++steps)
    now = *history.undo(now);
  EXPECT_EQ(steps, TactileSettingsHistory::kMaxSteps);
  history.changing(threshold(1));
  EXPECT_FALSE(history.canUndo(TactileSettings(2, {0.5, 9}))) << "another number of matrices";
  history.clear();
  EXPECT_FALSE(history.canUndo(threshold(4000)));
}

}  // namespace
}  // namespace palpate::tactile_settings_history_test
