// The dock Inspect over the bench: what it shows belongs to the source, and ticks stay as they were
// left.
#include "gui/inspect/inspect_feature.h"

#include "gui/inspect/inspect_panel.h"
#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::inspect_feature_test {
namespace {

class InspectFeatureTest : public WindowStateTest {
 protected:
  InspectFeatureTest() : feature_(*windowState_, &actionsOf_) {}
  MatrixTableModel& table() { return feature_.panel().table(); }
  InspectFeature feature_;
};

TEST_F(InspectFeatureTest, TicksOfWhatIsConnectedOutliveALookAtARecording) {
  connectEmulated();
  table().setPlotted(0, false);
  table().setPlotted(table().numMatrices(), true);
  const std::vector<bool> ticks = table().plotted();
  windowState_->displayed.show(recording("a"));
  EXPECT_NE(table().plotted(), ticks) << "a recording has its own";
  windowState_->displayed.showLive();
  EXPECT_EQ(table().plotted(), ticks);
  EXPECT_EQ(windowState_->selection.plotted(), ticks);
  disconnect();
  connectEmulated();
  EXPECT_NE(table().plotted(), ticks) << "another one was connected";
}

TEST_F(InspectFeatureTest, KeysOfRowsFollowTheTicks) {
  windowState_->displayed.show(recording("a"));
  table().setPlotted(1, false);
  const QList<QAction*>& plots = windowState_->actions.all("plots");
  EXPECT_FALSE(plots[1]->isChecked());
  plots[1]->trigger();
  EXPECT_TRUE(table().plotted()[1]);
}

}  // namespace
}  // namespace palpate::gui::inspect_feature_test
