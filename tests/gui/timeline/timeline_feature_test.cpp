// The dock Timeline over the bench: what is plotted of a recording and of what is live.
#include "gui/timeline/timeline_feature.h"

#include "gui/bench/bench_fixture.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_panel.h"

namespace palpate::gui::timeline_feature_test {
namespace {

class TimelineFeatureTest : public BenchTest {
 protected:
  TimelineFeatureTest() : feature_(*bench_, &actionsOf_) {}
  TimelineFeature feature_;
};

TEST_F(TimelineFeatureTest, BackAtLiveTheChartPlotsWhatIsTickedNow) {
  connectEmulated();
  const std::size_t rows = bench_->subject.hand()->layout->numMatrices() + 1;
  const std::vector<bool> all(rows, true);
  std::vector<bool> fewer = all;
  fewer[0] = false;
  bench_->selection.setPlotted(all);
  const int graphs = feature_.liveChart().numGraphs();
  bench_->selection.setPlotted(fewer);
  EXPECT_EQ(feature_.liveChart().numGraphs(), graphs - 1);
  bench_->subject.show(recording("a"));
  bench_->selection.setPlotted(all);
  bench_->subject.showLive();
  EXPECT_EQ(feature_.liveChart().numGraphs(), graphs);
}

TEST_F(TimelineFeatureTest, TheSpanIsOneWithTheModel) {
  bench_->subject.show(recording("a"));
  feature_.panel().chart().setSelection(TimeSpan{0.1, 0.3});
  EXPECT_EQ(bench_->selection.span(), (TimeSpan{0.1, 0.3}));
  bench_->selection.setSpan(std::nullopt);
  EXPECT_EQ(feature_.panel().chart().selection(), std::nullopt);
}

TEST_F(TimelineFeatureTest, WhatIsInSightIsKnownAtOnce) {
  bench_->subject.show(recording("a"));
  feature_.panel().chart().setSeen(0.2, 0.4);
  EXPECT_NEAR(bench_->selection.inSight().fromS, 0.2, 1e-9);
  EXPECT_NEAR(bench_->selection.inSight().toS, 0.4, 1e-9);
}

}  // namespace
}  // namespace palpate::gui::timeline_feature_test
