// The dock Timeline over the bench: what is plotted of a recording and of what is live.
#include "gui/timeline/timeline_feature.h"

#include <QCheckBox>
#include <QDoubleSpinBox>

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

TEST_F(TimelineFeatureTest, LiveThereAreTheSameCurvesAsOfARecording) {
  connectEmulated();
  LiveChart& chart = feature_.liveChart();
  const HandDescription& hand = *windowState_->displayed.hand();
  windowState_->selection.setPlotted(std::vector<bool>(hand.layout->numMatrices() + 1, false));
  EXPECT_EQ(chart.numGraphs(), 0);
  EXPECT_TRUE(feature_.signalTree().setTicked("motor 1", true));
  EXPECT_TRUE(feature_.signalTree().setTicked("finger 0 distal", true));
  EXPECT_EQ(chart.numGraphs(), 2);
  EXPECT_FALSE(feature_.signalTree().setTicked("force on", true)) << "no calibration is applied";
  TaxelSelection chosen(*hand.layout);
  chosen.add(1, 5, 1, 8, 4);
  windowState_->selection.setTaxels(chosen);
  EXPECT_EQ(chart.numGraphs(), 3);
  ASSERT_TRUE(QTest::qWaitFor([&] { return chart.graph(2)->data()->size() > 0; }, 20'000));
  EXPECT_EQ(chart.curves()[0].name, "16 chosen taxels");
  EXPECT_GT((chart.graph(2)->data()->constEnd() - 1)->value, 10.0) << "a motor is warm";
}

TEST_F(TimelineFeatureTest, KeysFreezeScrollAndMeasureLive) {
  connectEmulated();
  LiveChart& chart = feature_.liveChart();
  windowState_->selection.setPlotted(std::vector<bool>(7, true));
  ASSERT_TRUE(QTest::qWaitFor([&] { return chart.graph(0)->data()->size() > 0; }, 20'000));
  windowState_->actionEnabler.refresh();
  ActionRegistry& actions = windowState_->actions;
  EXPECT_FALSE(actions.at("zoomSelection")->isEnabled());
  actions.at("selectFrom")->trigger();
  EXPECT_TRUE(chart.cursors()[0]);
  EXPECT_TRUE(actions.at("dropSelection")->isEnabled());
  actions.at("freezeLive")->trigger();
  EXPECT_FALSE(chart.following());
  EXPECT_EQ(actions.at("freezeLive")->iconText(), "To the newest");
  actions.at("liveNewest")->trigger();
  EXPECT_TRUE(chart.following());
  EXPECT_FALSE(actions.at("freezeLive")->isChecked());
  actions.at("liveOldest")->trigger();
  EXPECT_FALSE(chart.following());
  actions.at("cursorBack")->trigger();
  actions.at("dropSelection")->trigger();
  EXPECT_FALSE(chart.cursors()[0]);
}

TEST_F(TimelineFeatureTest, RangesByHandAreRemembered) {
  feature_.panel().chart().axes().setByHand("counts", AxisRange{0.0, 250.0});
  feature_.liveChart().axes().setByHand("°C", AxisRange{20.0, 60.5});
  const QSettings& settings = windowState_->settings;
  EXPECT_EQ(settings.value("plotted/axes").toStringList(), QStringList{"0 250 counts"});
  EXPECT_EQ(settings.value("live/axes").toStringList(), QStringList{"20 60.5 °C"});
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  EXPECT_EQ(feature_.panel().chart().yAxis->range(), QCPRange(0.0, 250.0));
  feature_.panel().chart().axes().setByHand("counts", std::nullopt);
  EXPECT_TRUE(settings.value("plotted/axes").toStringList().isEmpty());
}

TEST_F(TimelineFeatureTest, TheEndsOfAnAxisAreTyped) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setPlotted({true, true});
  windowState_->actions.at("verticalAxes")->trigger();
  auto* editor = actionsOf_.findChild<QFrame*>("AxisEditor");
  ASSERT_NE(editor, nullptr);
  EXPECT_TRUE(editor->isVisible());
  const QCPAxis& axis = *feature_.panel().chart().yAxis;
  auto* automatic = editor->findChild<QCheckBox*>("automaticAxis");
  EXPECT_TRUE(automatic->isChecked());
  const QCPRange before = axis.range();
  editor->findChild<QDoubleSpinBox*>("axisTo")->setValue(1234.5);
  EXPECT_FALSE(automatic->isChecked());
  EXPECT_DOUBLE_EQ(axis.range().upper, 1234.5);
  EXPECT_TRUE(axis.label().contains("by hand")) << axis.label().toStdString();
  editor->findChild<QDoubleSpinBox*>("axisFrom")->setValue(2000.0);
  EXPECT_DOUBLE_EQ(axis.range().upper, 1234.5) << "that is no range";
  automatic->setChecked(true);
  EXPECT_EQ(axis.range(), before);
  editor->hide();
}

}  // namespace
}  // namespace palpate::gui::timeline_feature_test
