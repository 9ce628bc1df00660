#include "gui/chart/chart.h"

#include <QApplication>
#include <QMouseEvent>
#include <QWheelEvent>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "gui/appearance/theme.h"
#include "testing/testing.h"

namespace palpate::gui::chart_test {
namespace {

// 0 to 10 s, with a second chart below.
class PlainChart : public Chart {
 public:
  explicit PlainChart(double origin = 0.0) {
    addBelow(0.5);
    addCursor();
    setOrigin(origin);
    resize(400, 300);
    restyle();
    setVisibleRange(0.0, 10.0);
    replot();
    connect(this, &Chart::seekRequested, [this](double at) { asked.push_back(at); });
  }
  using Chart::pageWith;
  using Chart::zoomed;
  QWidget& bar() const { return cursor(); }
  QString readingAt(const QPointF& at) const override { return QString::number(secondsAt(at.x())); }
  void style() override { ++styled; }
  void panBy(double seconds) override { panned = seconds; }
  void zoomAbout(double seconds, double factor) override { zoomedBy = {seconds, factor}; }
  QCPRange belowRange() const { return axisRects().at(1)->axis(QCPAxis::atBottom)->range(); }

  int styled = 0;
  double panned = 0.0;
  std::pair<double, double> zoomedBy;
  std::vector<double> asked;
};

void turnWheel(PlainChart& chart, double x, Qt::KeyboardModifiers with) {
  QWheelEvent event(
      {x, 50.0}, {x, 50.0}, {}, {0, 120}, Qt::NoButton, with, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&chart, &event);
}

TEST(Chart, TheCursorStandsAtItsPositionAcrossBothCharts) {
  PlainChart chart;
  chart.setPosition(5.0);
  EXPECT_EQ(chart.cursorPixel(), qRound(chart.pixelOf(5.0)));
  EXPECT_FALSE(chart.bar().isHidden());
  EXPECT_GT(chart.bar().height(), chart.axisRect()->height());
  for (const double nowhere : {-1.0, 11.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    chart.setPosition(nowhere);
    EXPECT_TRUE(chart.bar().isHidden()) << nowhere;
  }
}

TEST(Chart, BothChartsShowOneRangeAndAnEmptyOneIsIgnored) {
  PlainChart chart;
  chart.setVisibleRange(2.0, 4.0);
  EXPECT_EQ(chart.xAxis->range(), chart.belowRange());
  chart.setVisibleRange(4.0, 4.0);
  chart.setVisibleRange(0.0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(chart.xAxis->range(), QCPRange(2.0, 4.0));
}

TEST(Chart, TheMouseSeeksFromTheOrigin) {
  PlainChart chart(100.0);
  const QPoint at(qRound(chart.pixelOf(5.0)), 50);
  QMouseEvent press(QEvent::MouseButtonPress, at, at, Qt::LeftButton, Qt::LeftButton, {});
  QApplication::sendEvent(&chart, &press);
  QMouseEvent other(QEvent::MouseButtonPress, at, at, Qt::RightButton, Qt::RightButton, {});
  QApplication::sendEvent(&chart, &other);
  ASSERT_EQ(chart.asked.size(), 1u);
  EXPECT_NEAR(chart.asked[0], 105.0, 10.0 / chart.axisRect()->width());
}

TEST(Chart, TheWheelZoomsAndPansWithShift) {
  PlainChart chart;
  const double at = chart.pixelOf(4.0);
  turnWheel(chart, at, Qt::NoModifier);
  EXPECT_NEAR(chart.zoomedBy.first, 4.0, 1e-6);
  EXPECT_DOUBLE_EQ(chart.zoomedBy.second, 1.25);
  turnWheel(chart, at, Qt::ShiftModifier);
  EXPECT_DOUBLE_EQ(chart.panned, -1.0) << "a tenth of what is visible, to earlier times";
}

TEST(Chart, ZoomingKeepsThePlaceUnderTheMouseWithinLimits) {
  PlainChart chart;
  const QCPRange range = chart.zoomed(4.0, 2.0, 0.1, 10.0);
  EXPECT_DOUBLE_EQ(range.lower, 2.0);
  EXPECT_DOUBLE_EQ(range.upper, 7.0);
  EXPECT_NEAR(chart.zoomed(4.0, 1e6, 0.1, 10.0).size(), 0.1, 1e-9);
  EXPECT_NEAR(chart.zoomed(4.0, 1e-6, 0.1, 10.0).size(), 10.0, 1e-9);
}

TEST(Chart, ThePageAfterThePositionThatLeftTheView) {
  PlainChart chart;
  EXPECT_FALSE(chart.pageWith(10.0));
  EXPECT_EQ(chart.pageWith(12.0), QCPRange(11.0, 21.0));
  EXPECT_EQ(chart.pageWith(-2.0), QCPRange(-11.0, -1.0));
}

TEST(Chart, TakesTheColoursOfEachTheme) {
  PlainChart chart;
  for (const Theme theme : {Theme::kLight, Theme::kDark, Theme::kLight}) {
    const int before = chart.styled;
    applyTheme(*qApp, theme);
    EXPECT_GT(chart.styled, before);
    EXPECT_EQ(chart.xAxis->labelColor(), colorsOf(theme).muted);
    EXPECT_EQ(chart.axisRects().at(1)->axis(QCPAxis::atLeft)->labelColor(), colorsOf(theme).muted);
    EXPECT_EQ(chart.grab().toImage().pixelColor(2, 2), colorsOf(theme).window);
  }
}

}  // namespace
}  // namespace palpate::gui::chart_test
