// The dock Timeline over the bench: what is plotted of a recording and of what is live.
#include "gui/timeline/timeline_feature.h"

#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::timeline_feature_test {
namespace {

class TimelineFeatureTest : public WindowStateTest {
 protected:
  TimelineFeatureTest() : feature_(*windowState_, &actionsOf_) {}
  TimelineFeature feature_;
};

TEST_F(TimelineFeatureTest, BackAtLiveTheChartPlotsWhatIsTickedNow) {
  connectEmulated();
  const std::size_t rows = windowState_->displayed.hand()->layout->numMatrices() + 1;
  const std::vector<bool> all(rows, true);
  std::vector<bool> fewer = all;
  fewer[0] = false;
  windowState_->selection.setPlotted(all);
  const int graphs = feature_.liveChart().numGraphs();
  windowState_->selection.setPlotted(fewer);
  EXPECT_EQ(feature_.liveChart().numGraphs(), graphs - 1);
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted(all);
  windowState_->displayed.showLive();
  EXPECT_EQ(feature_.liveChart().numGraphs(), graphs);
}

TEST_F(TimelineFeatureTest, TheSpanIsOneWithTheModel) {
  windowState_->displayed.show(recording("a"));
  feature_.panel().chart().setSelection(TimeSpan{0.1, 0.3});
  EXPECT_EQ(windowState_->selection.span(), (TimeSpan{0.1, 0.3}));
  windowState_->selection.setSpan(std::nullopt);
  EXPECT_EQ(feature_.panel().chart().selection(), std::nullopt);
}

TEST_F(TimelineFeatureTest, WhatIsInSightIsKnownAtOnce) {
  windowState_->displayed.show(recording("a"));
  feature_.panel().chart().setVisibleRange(0.2, 0.4);
  EXPECT_NEAR(windowState_->selection.visibleSpan().fromS, 0.2, 1e-9);
  EXPECT_NEAR(windowState_->selection.visibleSpan().toS, 0.4, 1e-9);
}

}  // namespace
}  // namespace palpate::gui::timeline_feature_test
