#include "gui/timeline/live_chart.h"

#include <QApplication>
#include <QTest>
#include <QWheelEvent>
#include <cmath>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::gui::live_chart_test {
namespace {

constexpr std::int64_t kStartUs = 1'400'000'000'000'000;

class LiveChartTest : public ::testing::Test {
 protected:
  LiveChartTest() {
    chart_.resize(900, 220);
    chart_.setHistory(&history_, 6);
    chart_.setTheme(Theme::kDark);
    chart_.show();
  }
  // A frame in which matrix 2 has this mean.
  void frame(double atS, double mean) {
    auto made = std::make_shared<TactileFrame>(sdh2().layout);
    made->hostUs = kStartUs + static_cast<std::int64_t>(atS * 1e6);
    LiveResults results;
    results.frame = made;
    results.matrixSignals.resize(6);
    results.matrixSignals[2].mean = mean;
    results.wholeSignals.mean = mean / 2;
    history_.add(results);
  }
  SignalHistory history_;
  LiveChart chart_;
};

TEST_F(LiveChartTest, RollsWithTheNewestFrame) {
  for (int i = 0; i <= 40 * 30; ++i) frame(i / 30.0, 100.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.0, 1e-6);
  EXPECT_NEAR(chart_.xAxis->range().lower, 10.0, 1e-6);
  ASSERT_EQ(chart_.numGraphs(), 6);
  EXPECT_EQ(chart_.graph(2)->data()->size(), 40 * 30 + 1);
  EXPECT_DOUBLE_EQ((chart_.graph(2)->data()->constEnd() - 1)->value, 100.0);
  EXPECT_DOUBLE_EQ((chart_.graph(0)->data()->constEnd() - 1)->value, 0.0);
}

TEST_F(LiveChartTest, MovesOnInStepsThatAreSeenAndLosesNothing) {
  for (int i = 0; i <= 40 * 30; ++i) frame(i / 30.0, 100.0);
  chart_.refresh(0.0);
  frame(40.033, 200.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.0, 1e-6) << "not drawn yet";
  EXPECT_EQ((chart_.graph(2)->data()->constEnd() - 1)->value, 200.0) << "but taken";
  frame(40.067, 100.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.067, 1e-6);
  EXPECT_EQ(chart_.graph(2)->data()->size(), 40 * 30 + 3);
  frame(40.1, 100.0);
  chart_.refresh(0.0);
  chart_.refresh(0.5);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.6, 1e-6) << "nothing comes any more";
}

TEST_F(LiveChartTest, StartsFullAndGrowsFromTheLeft) {
  frame(0.0, 10.0);
  frame(2.0, 10.0);
  chart_.refresh(0.0);
  EXPECT_DOUBLE_EQ(chart_.xAxis->range().lower, 0.0);
  EXPECT_DOUBLE_EQ(chart_.xAxis->range().upper, LiveChart::kUsualS);
}

TEST_F(LiveChartTest, RollsOnBySilenceAndShadesTheGap) {
  for (int i = 0; i <= 31 * 30; ++i) frame(i / 30.0, 5.0);
  chart_.refresh(0.0);
  chart_.refresh(2.0);  // nothing came for 2 s
  EXPECT_NEAR(chart_.xAxis->range().upper, 33.0, 1e-6);
  EXPECT_EQ(chart_.numEvents(), 0u);
  frame(34.0, 5.0);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.numEvents(), 1u);
  // No line leads over the gap: a value that is none stands in between.
  const auto data = chart_.graph(2)->data();
  EXPECT_TRUE(std::isnan((data->constEnd() - 2)->value));
  // Once more, with another signal: the gap isn't shaded twice.
  chart_.setSignal(PlottedSignal::kMaximum);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.numEvents(), 1u);
}

TEST_F(LiveChartTest, HeightFollowsTheLargestInSight) {
  frame(0.0, 730.0);
  chart_.refresh(0.0);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 1000.0);
  for (int i = 1; i <= 60 * 10; ++i) frame(i / 10.0, 20.0);
  chart_.refresh(0.0);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 50.0);
}

TEST_F(LiveChartTest, PlotsWhatIsTickedInTheChosenSignal) {
  frame(0.0, 730.0);
  frame(0.1, 730.0);
  chart_.setPlotted({false, false, true, false, false, false, true});
  ASSERT_EQ(chart_.numGraphs(), 2);
  EXPECT_DOUBLE_EQ(chart_.graph(0)->data()->at(0)->value, 730.0);
  EXPECT_DOUBLE_EQ(chart_.graph(1)->data()->at(0)->value, 365.0);
  chart_.setSignal(PlottedSignal::kActive);
  EXPECT_DOUBLE_EQ(chart_.graph(0)->data()->at(0)->value, 0.0);
}

TEST_F(LiveChartTest, MarksAndGraspsAreLinesAtTheirMoment) {
  frame(0.0, 1.0);
  chart_.refresh(0.0);
  chart_.addEvent({kStartUs + 500'000, kStartUs + 500'000, "mark", {}, "", ""});
  chart_.addEvent({kStartUs + 900'000, kStartUs + 900'000, "label", {}, "slip", ""});
  chart_.addEvent({kStartUs, kStartUs, "link", {}, "connected", ""});
  EXPECT_EQ(chart_.numEvents(), 2u);
  // What is long gone is let go.
  frame(1000.0, 1.0);
  chart_.refresh(0.0);
  EXPECT_LE(chart_.numEvents(), 1u);
}

TEST_F(LiveChartTest, TheWheelChangesHowMuchIsSeen) {
  frame(0.0, 1.0);
  const auto wheel = [&](int notches) {
    QWheelEvent event(QPointF(300, 100),
                      chart_.mapToGlobal(QPointF(300, 100)),
                      {},
                      QPoint(0, notches * 120),
                      Qt::NoButton,
                      Qt::NoModifier,
                      Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(&chart_, &event);
  };
  wheel(1);
  EXPECT_NEAR(chart_.windowS(), LiveChart::kUsualS / 1.25, 1e-9);
  wheel(-50);
  EXPECT_DOUBLE_EQ(chart_.windowS(), LiveChart::kMaxWindowS);
  wheel(100);
  EXPECT_DOUBLE_EQ(chart_.windowS(), LiveChart::kShortestS);
}

TEST_F(LiveChartTest, HeldNothingMovesAndNothingIsLost) {
  frame(0.0, 1.0);
  chart_.refresh(0.0);
  chart_.setHeld(true);
  frame(1.0, 2.0);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.graph(2)->data()->size(), 1);
  chart_.setHeld(false);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.graph(2)->data()->size(), 2);
}

TEST_F(LiveChartTest, WithoutASourceItIsEmpty) {
  frame(0.0, 1.0);
  chart_.refresh(0.0);
  chart_.setHistory(nullptr, 0);
  EXPECT_EQ(chart_.numGraphs(), 0);
  chart_.refresh(1.0);
  chart_.addEvent({0, 0, "mark", {}, "", ""});
  EXPECT_EQ(chart_.numEvents(), 0u);
}

}  // namespace
}  // namespace palpate::gui::live_chart_test
