#include <QLabel>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"

namespace palpate::gui::timeline_test {
namespace {

class TimelineTest : public WindowTest {
 protected:
  TimelineTest() { open({"good.dsa"}); }
  TimelineChart& chart() {
    auto& found = *window().findChild<TimelineChart*>();
    found.replot(QCustomPlot::rpImmediateRefresh);
    return found;
  }
  QPoint pointAt(double seconds) {
    return {static_cast<int>(std::lround(chart().pixelOf(seconds))),
            chart().axisRect()->rect().center().y()};
  }
  void wheel(double seconds, int notches, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    const QPoint at = pointAt(seconds);
    QWheelEvent event(at,
                      chart().mapToGlobal(at),
                      {},
                      QPoint(0, 120 * notches),
                      Qt::NoButton,
                      modifiers,
                      Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(&chart(), &event);
  }
  void drag(const QPointF& at) {
    QMouseEvent move(QEvent::MouseMove,
                     at,
                     chart().mapToGlobal(at),
                     Qt::NoButton,
                     Qt::LeftButton,
                     Qt::NoModifier);
    QApplication::sendEvent(&chart(), &move);
  }
  void select(double from, double to) {
    QTest::mousePress(&chart(), Qt::LeftButton, {}, pointAt(from));
    drag(pointAt((from + to) / 2));
    drag(pointAt(to));
    QTest::mouseRelease(&chart(), Qt::LeftButton, {}, pointAt(to));
  }
  // Seconds per pixel: the accuracy of a click.
  double pixel() { return chart().seen().size() / chart().axisRect()->width(); }
};

TEST_F(TimelineTest, HasAxesWithUnitsAndShowsAllOfIt) {
  EXPECT_EQ(chart().xAxis->label(), "time from the first frame in s");
  EXPECT_TRUE(chart().yAxis->label().endsWith("counts"));
  EXPECT_NEAR(chart().seen().lower, 0.0, 1e-9);
  EXPECT_NEAR(chart().seen().upper, 0.95, 1e-9);
  EXPECT_GE(chart().yAxis->range().upper, 200.0) << "the highest value is inside";
}

TEST_F(TimelineTest, DrawsTheSignalOverTime) {
  const auto data = chart().graph(0)->data();
  ASSERT_EQ(data->size(), 20);
  EXPECT_NEAR(data->at(4)->key, 0.2, 1e-9);
  EXPECT_NEAR(data->at(4)->value, 50.0, 1e-9);
}

TEST_F(TimelineTest, AClickSeeks) {
  QTest::mouseClick(&chart(), Qt::LeftButton, {}, pointAt(0.41));
  EXPECT_NEAR(playback().positionS(), 0.41, pixel());
  EXPECT_EQ(playback().frame(), 8u);
}

TEST_F(TimelineTest, ADragAlongTheAxisScrubsAndStopsAtTheEnds) {
  const int below = chart().axisRect()->rect().bottom() + 6;
  const auto onAxis = [&](double seconds) { return QPoint(pointAt(seconds).x(), below); };
  QTest::mousePress(&chart(), Qt::LeftButton, {}, onAxis(0.2));
  EXPECT_NEAR(playback().positionS(), 0.2, pixel());
  for (const double seconds : {0.3, 0.62}) drag(onAxis(seconds));
  EXPECT_NEAR(playback().positionS(), 0.62, pixel());
  drag(QPoint(5000, below));
  EXPECT_EQ(playback().frame(), 19u);
  QTest::mouseRelease(&chart(), Qt::LeftButton, {}, onAxis(0.9));
  EXPECT_FALSE(chart().selection());
}

TEST_F(TimelineTest, ADragSelectsWithoutSeeking) {
  playback().seekSeconds(0.1);
  select(0.3, 0.6);
  ASSERT_TRUE(chart().selection());
  EXPECT_NEAR(chart().selection()->fromS, 0.3, pixel());
  EXPECT_NEAR(chart().selection()->toS, 0.6, pixel());
  EXPECT_NEAR(playback().positionS(), 0.1, 1e-9);
  auto* words = find<QLabel>("selectionWords");
  EXPECT_TRUE(words->isVisible());
  EXPECT_TRUE(words->text().contains("frames")) << words->text().toStdString();
  select(0.7, 0.5);  // from right to left
  EXPECT_NEAR(chart().selection()->fromS, 0.5, pixel());
  EXPECT_NEAR(chart().selection()->toS, 0.7, pixel());
}

TEST_F(TimelineTest, TheHandlesOfTheSelectionCanBeDragged) {
  select(0.3, 0.6);
  select(0.6, 0.8);
  EXPECT_NEAR(chart().selection()->fromS, 0.3, 1.5 * pixel());
  EXPECT_NEAR(chart().selection()->toS, 0.8, 1.5 * pixel());
  select(0.3, 0.9);  // over the other handle
  EXPECT_NEAR(chart().selection()->fromS, 0.8, 1.5 * pixel());
  EXPECT_NEAR(chart().selection()->toS, 0.9, 1.5 * pixel());
  select(0.9, 30.0);
  EXPECT_NEAR(chart().selection()->toS, 0.95, 1e-9) << "clamped to the recording";
}

TEST_F(TimelineTest, AClickBesideTheSelectionLetsGoOfItAndEscapeDoes) {
  select(0.3, 0.6);
  QTest::mouseClick(&chart(), Qt::LeftButton, {}, pointAt(0.45));
  EXPECT_TRUE(chart().selection()) << "within it: it stays";
  QTest::mouseClick(&chart(), Qt::LeftButton, {}, pointAt(0.1));
  EXPECT_FALSE(chart().selection());
  select(0.3, 0.6);
  press(Qt::Key_Escape);
  EXPECT_FALSE(chart().selection());
}

TEST_F(TimelineTest, TheSelectionByKeys) {
  playback().seekSeconds(0.2);
  press(Qt::Key_BracketLeft);
  EXPECT_EQ(chart().selection(), (TimeSpan{0.2, 0.95}));
  playback().seekSeconds(0.5);
  press(Qt::Key_BracketRight);
  EXPECT_EQ(chart().selection(), (TimeSpan{0.2, 0.5}));
  trigger("zoomSelection");
  EXPECT_NEAR(chart().seen().size(), 0.35, 0.03);
  press(Qt::Key_A, Qt::ControlModifier);
  EXPECT_EQ(chart().selection(), (TimeSpan{0.0, 0.95}));
  trigger("dropSelection");
  EXPECT_FALSE(chart().selection());
}

TEST_F(TimelineTest, TheCursorStandsAtThePosition) {
  for (const double seconds : {0.0, 0.5, 0.95}) {
    playback().seekSeconds(seconds);
    EXPECT_NEAR(chart().cursorPixel(), chart().pixelOf(seconds), 1.0);
  }
}

TEST_F(TimelineTest, TheCursorMovesWithoutRedrawingTheCurves) {
  chart();
  QCoreApplication::processEvents();
  QSignalSpy replots(window().findChild<TimelineChart*>(), &QCustomPlot::afterReplot);
  for (int i = 0; i < 15; ++i) playback().step(1);
  QCoreApplication::processEvents();
  EXPECT_EQ(replots.size(), 0);
}

TEST_F(TimelineTest, TheWheelZoomsAboutTheMouse) {
  wheel(0.3, 4);
  EXPECT_LT(chart().seen().size(), 0.5);
  EXPECT_NEAR(pointAt(0.3).x(), chart().pixelOf(0.3), 1.0);
  EXPECT_TRUE(chart().seen().contains(0.3));
  wheel(0.3, -40);
  EXPECT_NEAR(chart().seen().size(), 0.95, 1e-9) << "never wider than the recording";
}

TEST_F(TimelineTest, ZoomKeepsThePlaceUnderTheMouse) {
  const double before = chart().pixelOf(0.6);
  wheel(0.6, 3);
  EXPECT_NEAR(chart().pixelOf(0.6), before, 1.5);
}

TEST_F(TimelineTest, MiddleButtonAndShiftPan) {
  wheel(0.5, 4);
  for (const auto& [button, modifier] :
       {std::pair(Qt::MiddleButton, Qt::NoModifier), {Qt::LeftButton, Qt::ShiftModifier}}) {
    const QCPRange before = chart().seen();
    const double position = playback().positionS();
    const QPoint from = chart().axisRect()->rect().center();
    QTest::mousePress(&chart(), button, modifier, from);
    const QPointF to = from + QPoint(40, 0);
    QMouseEvent move(
        QEvent::MouseMove, to, chart().mapToGlobal(to), Qt::NoButton, button, modifier);
    QApplication::sendEvent(&chart(), &move);
    QTest::mouseRelease(&chart(), button, modifier, to.toPoint());
    EXPECT_NEAR(chart().seen().lower, before.lower - 40 * pixel(), 0.5 * pixel());
    EXPECT_NEAR(chart().seen().size(), before.size(), 1e-9);
    EXPECT_EQ(playback().positionS(), position) << "panning doesn't seek";
  }
  const double before = chart().seen().lower;
  wheel(0.5, -1, Qt::ShiftModifier);
  EXPECT_GT(chart().seen().lower, before);
}

TEST_F(TimelineTest, ADoubleClickShowsEverything) {
  wheel(0.3, 6);
  QTest::mouseDClick(&chart(), Qt::LeftButton, {}, chart().axisRect()->rect().center());
  EXPECT_NEAR(chart().seen().size(), 0.95, 1e-9);
}

TEST_F(TimelineTest, ZoomedInThePageTurnsWithThePlayback) {
  wheel(0.0, 6);
  ASSERT_LT(chart().seen().upper, 0.5);
  playback().seekSeconds(0.9);
  EXPECT_TRUE(chart().seen().contains(0.9));
  playback().seekSeconds(0.0);
  EXPECT_TRUE(chart().seen().contains(0.0));
}

TEST_F(TimelineTest, AGapIsABreakAndShaded) {
  open({"gap.dsa"});
  const auto data = chart().graph(0)->data();
  int breaks = 0;
  for (const QCPGraphData& point : *data) breaks += std::isnan(point.value) ? 1 : 0;
  EXPECT_EQ(breaks, 1);
  const QCPItemRect* shade = nullptr;
  const QCPItemText* label = nullptr;
  for (int i = 0; i < chart().itemCount(); ++i) {
    if (!shade) shade = qobject_cast<QCPItemRect*>(chart().item(i));
    if (!label) label = qobject_cast<QCPItemText*>(chart().item(i));
  }
  ASSERT_TRUE(shade && label);
  EXPECT_NEAR(shade->topLeft->coords().x(), 0.2, 1e-9);
  EXPECT_NEAR(shade->bottomRight->coords().x(), 10.27, 1e-9);
  EXPECT_EQ(label->text(), "gap 10.1 s");
}

TEST_F(TimelineTest, TheLegendNamesWhatIsPlotted) {
  auto* legend = window().findChild<Legend*>();
  ASSERT_EQ(legend->entries().size(), 1u);
  EXPECT_EQ(legend->entries()[0].name, "finger 0 distal");
  EXPECT_EQ(legend->entries()[0].pen, chart().graph(0)->pen());
  actions().all("plots").last()->trigger();
  ASSERT_EQ(legend->entries().size(), 2u);
  EXPECT_EQ(legend->entries()[1].name, "all");
}

// However narrow it is, "…" tells that there are more curves.
TEST(Legend, TheDotsForFurtherCurvesAlwaysHaveRoom) {
  Legend legend;
  std::vector<Legend::Entry> entries;
  for (int i = 0; i < 6; ++i) entries.push_back({QPen(), "finger " + QString::number(i)});
  legend.setEntries(entries);
  for (int width = 60; width < legend.sizeHint().width() / 2 - 30; width += 3) {
    legend.resize(width, 10);
    legend.resize(width, legend.sizeHint().height());
    legend.show();
    QCoreApplication::processEvents();
    ASSERT_TRUE(legend.isCut());
    EXPECT_TRUE(legend.rect().contains(legend.dotsRect())) << width;
  }
}

// In a low chart no title is cut: the units stand in the corners of the plot.
TEST_F(TimelineTest, ALowChartHasUnitsInsteadOfTitles) {
  TimelineChart low;
  low.setRecording(window().state().displayed.recorded());
  PlottedCurve curve;
  curve.name = "a";
  curve.unit = curve.baseUnit = "counts";
  curve.axis = "mean in counts";
  low.setCurves({curve});
  low.resize(600, 400);
  low.show();
  low.replot();
  EXPECT_EQ(low.yAxis->label(), "mean in counts");
  EXPECT_EQ(low.xAxis->label(), "time from the first frame in s");
  const auto words = [&] {
    QStringList found;
    for (int i = 0; i < low.itemCount(); ++i)
      if (const auto* word = qobject_cast<QCPItemText*>(low.item(i))) found << word->text();
    found.sort();
    return found;
  };
  EXPECT_EQ(words(), QStringList());
  const int line = low.fontMetrics().lineSpacing();
  low.resize(600, 5 * line);
  low.replot();
  EXPECT_EQ(low.xAxis->label(), "");
  EXPECT_GE(low.axisRect()->height(), 2 * line);
  // The unit alone may be whole beside it.
  if (low.yAxis->label().isEmpty())
    EXPECT_EQ(words(), QStringList({"counts", "s"}));
  else
    EXPECT_LT(low.fontMetrics().horizontalAdvance(low.yAxis->label()), low.axisRect()->height());
  low.resize(600, 400);
  low.replot();
  EXPECT_EQ(words(), QStringList());
}

TEST_F(TimelineTest, ClosedItIsEmpty) {
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(chart().graphCount(), 0);
  EXPECT_EQ(chart().itemCount(), 0);
  wheel(0.5, 1);
  QTest::mouseClick(&chart(), Qt::LeftButton, {}, QPoint(100, 50));
}

}  // namespace
}  // namespace palpate::gui::timeline_test
