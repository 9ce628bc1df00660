#include "gui/timeline/live_chart.h"

#include <QApplication>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>
#include <cmath>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "gui/chart/end_names.h"
#include "testing/testing.h"

namespace palpate::gui::live_chart_test {
namespace {

constexpr std::int64_t kStartUs = 1'400'000'000'000'000;

class LiveChartTest : public ::testing::Test {
 protected:
  LiveChartTest() {
    chart_.resize(900, 220);
    chart_.setHistory(&history_, &sdh2());
    plot({0, 1, 2, 3, 4, 5});
    applyTheme(*qApp, Theme::kDark);
    chart_.show();
  }
  void plot(const std::vector<std::size_t>& rows, SignalKind signal = SignalKind::kMean) {
    std::vector<PlottedCurve> curves;
    for (const std::size_t row : rows) curves.push_back(matrixCurve(sdh2(), row, signal));
    chart_.setCurves(curves);
  }
  // A frame in which matrix 2 has this mean.
  void frame(double atS, double mean) {
    auto made = std::make_shared<TactileFrame>(sdh2().layout);
    made->hostUs = kStartUs + std::llround(atS * 1e6);
    LiveResults results;
    results.frame = made;
    results.matrixSignals.resize(6);
    results.matrixSignals[2].mean = mean;
    results.wholeSignals.mean = mean / 2;
    results.angles = Sample{made->hostUs, {10.0, 20.0 + atS, 30.0, 40.0, 50.0, 60.0, 70.0}};
    history_.add(results);
  }
  // One frame in 1/10 s, with its time as the mean.
  void framesTo(double lastS) {
    for (int i = 0; i <= std::lround(lastS * 10); ++i) frame(i / 10.0, i / 10.0);
    chart_.refresh(0.0);
  }
  void send(QEvent& event) { QApplication::sendEvent(&chart_, &event); }
  void wheel(int notches,
             Qt::KeyboardModifiers modifiers = Qt::NoModifier,
             QPointF at = {300, 100}) {
    QWheelEvent event(at,
                      chart_.mapToGlobal(at),
                      {},
                      QPoint(0, notches * 120),
                      Qt::NoButton,
                      modifiers,
                      Qt::NoScrollPhase,
                      false);
    send(event);
  }
  QPoint pointAt(double seconds) {
    return {static_cast<int>(std::lround(chart_.pixelOf(seconds))),
            chart_.axisRect()->rect().center().y()};
  }
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = {}) {
    chart_.replot();
    QTest::mousePress(&chart_, Qt::LeftButton, modifiers, from);
    QMouseEvent move(
        QEvent::MouseMove, to, chart_.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, modifiers);
    send(move);
    QTest::mouseRelease(&chart_, Qt::LeftButton, modifiers, to);
  }
  double lastDrawn(int graph) { return (chart_.graph(graph)->data()->constEnd() - 1)->value; }

  SignalHistory history_;
  LiveChart chart_;
};

// Right of the plot each name has the colour of its curve, and none covers another one.
TEST_F(LiveChartTest, NamesStandAtTheEndsOfTheCurves) {
  chart_.resize(900, 400);
  plot({0, 1, 2});
  framesTo(40.0);
  chart_.replot();
  const QImage image = chart_.grab().toImage();
  const QRect room = chart_.axisRect()->rect();
  ASSERT_GT(chart_.width() - room.right(),
            chart_.fontMetrics().horizontalAdvance(chart_.curves().front().name));
  std::vector<std::pair<int, int>> lines;
  for (const PlottedCurve& curve : chart_.curves()) {
    std::optional<std::pair<int, int>> line;
    for (int y = 0; y < image.height(); ++y)
      for (int x = room.right() + 3; x < image.width(); ++x)
        if (image.pixelColor(x, y) == curve.pen.color()) {
          if (!line) line.emplace(y, y);
          line->second = y;
        }
    ASSERT_TRUE(line) << curve.name.toStdString();
    lines.push_back(*line);
  }
  // Matrix 2 is at the top; the others rest at zero, one below the other.
  EXPECT_LT(lines[2].second, room.center().y());
  EXPECT_GT(lines[0].first, room.center().y());
  EXPECT_TRUE(lines[0].second < lines[1].first || lines[1].second < lines[0].first);
}

// Matrices 0 and 1 are of finger 0, 2 and 3 of finger 1, 4 and 5 of finger 2. Matrix 2 reads the
// seconds, the others 0.
TEST_F(LiveChartTest, EachFingerHasALane) {
  framesTo(20.0);
  const double upper = chart_.yAxis->range().upper;
  const QString values = chart_.valuesAt(10.0);
  chart_.setLanes(true);
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(0.0, 3.0));
  EXPECT_DOUBLE_EQ(lastDrawn(0), 2.0) << "the first finger is at the top";
  EXPECT_DOUBLE_EQ(lastDrawn(5), 0.0);
  EXPECT_DOUBLE_EQ(lastDrawn(3), 1.0);
  EXPECT_NEAR(lastDrawn(2), 1.0 + 0.85 * 20.0 / upper, 1e-9);
  EXPECT_EQ(chart_.valuesAt(10.0), values) << "values are told as they are";
  // A range set by hand is that of each lane.
  chart_.axes().setByHand("counts", AxisRange{0.0, 40.0});
  EXPECT_NEAR(lastDrawn(2), 1.0 + 0.85 * 0.5, 1e-9);
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(0.0, 3.0));
  chart_.axes().setByHand("counts", std::nullopt);
  // Angles have their own axis; one finger needs no lanes.
  std::vector<PlottedCurve> curves = {matrixCurve(sdh2(), 2, SignalKind::kMean),
                                      matrixCurve(sdh2(), 4, SignalKind::kMean),
                                      angleCurve(sdh2(), 1)};
  chart_.setCurves(curves);
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(0.0, 2.0));
  EXPECT_NEAR(lastDrawn(2), 40.0, 1e-9);
  plot({2, 3});
  EXPECT_NEAR(lastDrawn(2 - 2), 20.0, 1e-9);
  plot({0, 1, 2, 3, 4, 5});
  chart_.setLanes(false);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, upper);
  EXPECT_NEAR(lastDrawn(2), 20.0, 1e-9);
}

TEST_F(LiveChartTest, HasNoNamesAtTheEndsWhereTheyHaveNoRoom) {
  chart_.resize(300, 400);
  EXPECT_EQ(roomForEndNames(chart_, chart_.curves()), 0) << "narrow";
  chart_.resize(900, 100);
  EXPECT_EQ(roomForEndNames(chart_, chart_.curves()), 0) << "low";
  chart_.resize(900, 400);
  EXPECT_GT(roomForEndNames(chart_, chart_.curves()), 0);
  std::vector<PlottedCurve> curves = chart_.curves();
  curves.push_back(angleCurve(sdh2(), 1));
  EXPECT_EQ(roomForEndNames(chart_, curves), 0) << "the axis of the angles stands there";
}

TEST_F(LiveChartTest, RollsWithTheNewestFrame) {
  for (int i = 0; i <= 40 * 30; ++i) frame(i / 30.0, 100.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.0, 1e-6);
  EXPECT_NEAR(chart_.xAxis->range().lower, 10.0, 1e-6);
  ASSERT_EQ(chart_.numGraphs(), 6);
  EXPECT_DOUBLE_EQ(lastDrawn(2), 100.0);
  EXPECT_DOUBLE_EQ(lastDrawn(0), 0.0);
}

TEST_F(LiveChartTest, DrawsNoMoreThanThePixelsNeedAndLosesNoPeak) {
  for (int i = 0; i <= 600 * 30; ++i) frame(i / 30.0, i == 7777 ? 900.0 : i % 5);
  chart_.setWindowS(600.0);
  chart_.refresh(0.0);
  EXPECT_LE(chart_.graph(2)->data()->size(), 4 * 900 + 2);
  double largest = 0.0;
  for (const QCPGraphData& point : *chart_.graph(2)->data())
    largest = std::max(largest, point.value);
  EXPECT_DOUBLE_EQ(largest, 900.0);
}

TEST_F(LiveChartTest, MovesOnInStepsThatAreSeenAndLosesNothing) {
  for (int i = 0; i <= 40 * 30; ++i) frame(i / 30.0, 100.0);
  chart_.refresh(0.0);
  frame(40.033, 200.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.0, 1e-6) << "not drawn yet";
  EXPECT_TRUE(chart_.valuesAt(40.033).contains("200 counts")) << "but taken";
  frame(40.067, 100.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.067, 1e-6);
  frame(40.1, 100.0);
  chart_.refresh(0.0);
  chart_.refresh(0.5);
  EXPECT_NEAR(chart_.xAxis->range().upper, 40.6, 1e-6) << "nothing comes any more";
}

TEST_F(LiveChartTest, ALongSpanIsDrawnAsOftenAsItsPixelsChange) {
  for (int i = 0; i <= 400 * 10; ++i) frame(i / 10.0, 100.0);
  chart_.setWindowS(300.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 400.0, 1e-6);
  frame(400.2, 100.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 400.0, 1e-6) << "less than a pixel";
  frame(400.5, 100.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.xAxis->range().upper, 400.5, 1e-6);
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
  // The silence is shaded while it lasts.
  const auto shades = [&] {
    std::vector<std::pair<double, double>> found;
    for (int i = 0; i < chart_.itemCount(); ++i)
      if (const auto* shade = qobject_cast<QCPItemRect*>(chart_.item(i)))
        found.emplace_back(shade->topLeft->key(), shade->bottomRight->key());
    return found;
  };
  ASSERT_EQ(shades().size(), 1U);
  EXPECT_NEAR(shades()[0].first, 31.0, 1e-6);
  EXPECT_NEAR(shades()[0].second, 33.0, 1e-6);
  frame(34.0, 5.0);
  chart_.refresh(0.0);
  ASSERT_EQ(shades().size(), 1U);
  EXPECT_NEAR(shades()[0].second, 34.0, 1e-6);
  EXPECT_EQ(chart_.numEvents(), 1u);
  // No line leads over the gap: a value that is none stands in between.
  bool interrupted = false;
  for (const QCPGraphData& point : *chart_.graph(2)->data())
    interrupted = interrupted || std::isnan(point.value);
  EXPECT_TRUE(interrupted);
  // Once more, with another signal: the gap isn't shaded twice.
  plot({2}, SignalKind::kMaximum);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.numEvents(), 1u);
  EXPECT_TRUE(chart_.valuesAt(33.0).contains("gap of 3.0 s"))
      << chart_.valuesAt(33.0).toStdString();
}

// Events of a recording that is replayed may be of any program: `json` may be empty, or none.
TEST_F(LiveChartTest, AGapThatAnEventTellsInterruptsTheLine) {
  const auto interruptions = [&] {
    int count = 0;
    for (const QCPGraphData& point : *chart_.graph(2)->data())
      count += std::isnan(point.value) ? 1 : 0;
    return count;
  };
  double nextS = 5.0;
  const auto gapAt = [&](double fromS, double seconds, const char* json) {
    const auto fromUs = kStartUs + static_cast<std::int64_t>(1e6 * fromS);
    chart_.addEvent(
        {fromUs, fromUs + static_cast<std::int64_t>(1e6 * seconds), "gap", {}, "lost", json});
    // The curves are drawn anew when they have moved by a pixel.
    for (int i = 0; i < 10; ++i) frame(nextS += 1.0 / 30.0, 5.0);
    chart_.refresh(0.0);
    return interruptions();
  };
  for (int i = 0; i <= 5 * 30; ++i) frame(i / 30.0, 5.0);
  chart_.refresh(0.0);
  EXPECT_EQ(interruptions(), 0);
  EXPECT_EQ(gapAt(1.0, 0.4, R"({"stream": "angles", "lost": 9})"), 0) << "of the joints";
  EXPECT_EQ(gapAt(1.0, 0.05, R"({"lost": 1})"), 0) << "a single frame";
  EXPECT_EQ(gapAt(1.0, 0.4, ""), 1);
  EXPECT_EQ(gapAt(2.0, 0.4, "{not JSON"), 2);
  EXPECT_EQ(gapAt(3.0, 0.4, R"({"stream": "tactile", "lost": 12})"), 3);
}

TEST_F(LiveChartTest, HeightFollowsTheLargestInSight) {
  frame(0.0, 730.0);
  chart_.refresh(0.0);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 1000.0);
  for (int i = 1; i <= 60 * 10; ++i) frame(i / 10.0, 20.0);
  chart_.refresh(0.0);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 50.0);
}

TEST_F(LiveChartTest, TheAxisEndsWhereValuesEnd) {
  frame(0.0, 3400.0);
  chart_.refresh(0.0);
  EXPECT_NEAR(chart_.yAxis->range().upper, 1.06 * 3500.0, 1e-9);
}

TEST_F(LiveChartTest, PlotsWhatIsTickedInTheChosenSignal) {
  frame(0.0, 730.0);
  frame(0.1, 730.0);
  chart_.refresh(0.0);
  plot({2, 6});
  ASSERT_EQ(chart_.numGraphs(), 2);
  EXPECT_DOUBLE_EQ(chart_.graph(0)->data()->at(0)->value, 730.0);
  EXPECT_DOUBLE_EQ(chart_.graph(1)->data()->at(0)->value, 365.0);
  plot({2}, SignalKind::kActive);
  EXPECT_DOUBLE_EQ(chart_.graph(0)->data()->at(0)->value, 0.0);
}

TEST_F(LiveChartTest, JointAnglesHaveAnAxisOfTheirOwn) {
  framesTo(5.0);
  chart_.setCurves({matrixCurve(sdh2(), 2, SignalKind::kMean), angleCurve(sdh2(), 1)});
  ASSERT_EQ(chart_.numGraphs(), 2);
  EXPECT_DOUBLE_EQ(lastDrawn(1), 25.0) << "with all that came before it was chosen";
  EXPECT_NE(chart_.graph(0)->valueAxis(), chart_.graph(1)->valueAxis());
  EXPECT_LE(chart_.graph(1)->valueAxis()->range().lower, 20.0);
  EXPECT_GT(chart_.graph(1)->valueAxis()->range().lower, 10.0) << "angles don't begin at 0";
  EXPECT_EQ(chart_.axes().minExtent("°"), 1.0) << "the noise of a resting joint doesn't fill it";
  EXPECT_EQ(chart_.axes().minExtent("counts"), 0.0);
}

TEST_F(LiveChartTest, TellsTheValuesUnderTheMouse) {
  framesTo(10.0);
  chart_.setCurves({matrixCurve(sdh2(), 2, SignalKind::kMean), angleCurve(sdh2(), 1)});
  const QString text = chart_.valuesAt(4.04);
  EXPECT_TRUE(text.startsWith("4.00 s · 6.0 s before the newest frame")) << text.toStdString();
  EXPECT_TRUE(text.contains("finger 1 proximal  4 counts")) << text.toStdString();
  EXPECT_TRUE(text.contains("24.0 °")) << text.toStdString();
  EXPECT_EQ(chart_.valuesAt(11.0), "") << "not measured yet";
  EXPECT_EQ(chart_.valuesAt(-1.0), "");
}

TEST_F(LiveChartTest, ShowsTheChosenUnitAndWritesTheBaseUnit) {
  framesTo(10.0);
  chart_.setCurves({angleCurve(sdh2(), 1, {.angle = AngleUnit::kRadian})});
  EXPECT_EQ(chart_.axes().units(), std::vector<QString>{"rad"});
  EXPECT_NEAR(lastDrawn(0), 0.5235987755982988, 1e-12) << "30 degrees";
  // The range is that of degrees, 10 of them: a small motion stays visible.
  const QCPRange range = chart_.axes().of("rad")->range();
  EXPECT_LE(range.lower, 20.0 * 0.017453292519943295 + 1e-12);
  EXPECT_GE(range.upper, 0.5235987755982988 - 1e-12);
  EXPECT_LT(range.size(), 0.5);
  EXPECT_TRUE(chart_.valuesAt(4.04).contains("0.419 rad")) << chart_.valuesAt(4.04).toStdString();
  chart_.setTimeCursor(0, 4.0);
  chart_.setTimeCursor(1, 10.0);
  chart_.replot();
  const QString readings = chart_.findChild<QLabel*>("cursorReadings")->text();
  EXPECT_TRUE(readings.endsWith("0.419 rad → 0.524 rad  Δ +0.105 rad")) << readings.toStdString();
  EXPECT_EQ(chart_.cursorTable().row(1)[1], "°");
  EXPECT_EQ(chart_.cursorTable().row(1)[4], "6");
}

TEST_F(LiveChartTest, MarksAndGraspsAreLinesAtTheirMoment) {
  frame(0.0, 1.0);
  frame(1.0, 1.0);
  chart_.refresh(0.0);
  chart_.addEvent({kStartUs + 500'000, kStartUs + 500'000, "mark", {}, "", ""});
  chart_.addEvent({kStartUs + 900'000, kStartUs + 900'000, "label", {}, "slip", ""});
  chart_.addEvent({kStartUs, kStartUs, "link", {}, "connected", ""});
  EXPECT_EQ(chart_.numEvents(), 2u);
  chart_.replot();
  EXPECT_TRUE(chart_.valuesAt(0.9).contains("mark: slip")) << chart_.valuesAt(0.9).toStdString();
  // What is long gone is let go.
  frame(1000.0, 1.0);
  chart_.refresh(0.0);
  EXPECT_LE(chart_.numEvents(), 1u);
}

TEST_F(LiveChartTest, SlipIsALineThenASpan) {
  frame(0.0, 1.0);
  frame(1.0, 1.0);
  chart_.refresh(0.0);
  chart_.addEvent({kStartUs + 400'000, kStartUs + 400'000, "slip", 1, "slip begins", ""});
  EXPECT_EQ(chart_.numEvents(), 1u);
  chart_.addEvent({kStartUs + 400'000, kStartUs + 900'000, "slip", 1, "slip: 2.10 taxels", ""});
  EXPECT_EQ(chart_.numEvents(), 2u);
  EXPECT_TRUE(chart_.valuesAt(0.4).contains("slip: 2.10 taxels"));
  int spans = 0;
  for (int i = 0; i < chart_.itemCount(); ++i)
    if (const auto* span = qobject_cast<QCPItemRect*>(chart_.item(i)))
      spans += std::abs(span->topLeft->coords().x() - 0.4) < 1e-9 &&
               std::abs(span->bottomRight->coords().x() - 0.9) < 1e-9;
  EXPECT_EQ(spans, 1);
}

TEST_F(LiveChartTest, ARecordingIsMarkedWhereItBeganAndEnded) {
  framesTo(10.0);
  chart_.showRecording(kStartUs + 4'000'000, kStartUs + 9'900'000, true);
  EXPECT_EQ(chart_.numRecordingEnds(), 1u) << "its begin";
  chart_.showRecording(kStartUs + 4'000'000, kStartUs + 10'000'000, true);
  EXPECT_EQ(chart_.numRecordingEnds(), 1u);
  chart_.showRecording(kStartUs + 4'000'000, kStartUs + 10'000'000, false);
  EXPECT_EQ(chart_.numRecordingEnds(), 2u) << "and its end";
  chart_.showRecording(kStartUs + 4'000'000, kStartUs + 10'000'000, false);
  EXPECT_EQ(chart_.numRecordingEnds(), 2u);
  EXPECT_EQ(chart_.numEvents(), 0u);
  chart_.replot();
  EXPECT_TRUE(chart_.valuesAt(4.0).contains("the recording begins here"));
  // A recording of which nothing was seen while it ran, and one without a frame.
  chart_.showRecording(kStartUs + 9'950'000, kStartUs + 10'000'000, false);
  EXPECT_EQ(chart_.numRecordingEnds(), 4u);
  chart_.showRecording(0, 0, false);
  EXPECT_EQ(chart_.numRecordingEnds(), 4u);
}

TEST_F(LiveChartTest, TheWheelChangesHowMuchIsSeen) {
  frame(0.0, 1.0);
  chart_.refresh(0.0);
  wheel(1);
  EXPECT_NEAR(chart_.windowS(), LiveChart::kUsualS / 1.25, 1e-9);
  wheel(-50);
  EXPECT_DOUBLE_EQ(chart_.windowS(), LiveChart::kMaxWindowS);
  wheel(100);
  EXPECT_DOUBLE_EQ(chart_.windowS(), LiveChart::kShortestS);
  EXPECT_TRUE(chart_.following());
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
  chart_.setHistory(nullptr);
  EXPECT_EQ(chart_.numGraphs(), 0);
  chart_.refresh(1.0);
  chart_.addEvent({0, 0, "mark", {}, "", ""});
  chart_.showRecording(kStartUs, kStartUs + 1, true);
  chart_.setTimeCursor(0, 0.0);
  chart_.scroll(-1.0);
  EXPECT_EQ(chart_.numEvents(), 0u);
  EXPECT_EQ(chart_.cursorWords(), "");
}

TEST_F(LiveChartTest, FrozenItStaysWhileFramesArrive) {
  framesTo(60.0);
  QSignalSpy changed(&chart_, &LiveChart::followingChanged);
  chart_.setFollowing(false);
  EXPECT_EQ(changed.size(), 1);
  const QCPRange before = chart_.seen();
  for (int i = 601; i <= 700; ++i) frame(i / 10.0, 1.0);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.seen(), before);
  auto* words = chart_.findChild<QLabel*>("behindWords");
  EXPECT_TRUE(words->isVisible());
  EXPECT_TRUE(words->text().contains("10.0 s behind")) << words->text().toStdString();
  EXPECT_FALSE(chart_.valuesAt(65.0).isEmpty()) << "what came meanwhile is known";
  chart_.setFollowing(true);
  EXPECT_NEAR(chart_.seen().upper, 70.0, 1e-9);
  EXPECT_FALSE(words->isVisible());
}

// The axis still ends later than the newest frame.
TEST_F(LiveChartTest, FrozenSoonItTellsHowFarBehindItIs) {
  framesTo(10.0);
  chart_.setFollowing(false);
  for (int i = 101; i <= 150; ++i) frame(i / 10.0, 1.0);
  chart_.refresh(0.0);
  auto* words = chart_.findChild<QLabel*>("behindWords");
  EXPECT_TRUE(words->text().contains("5.0 s behind")) << words->text().toStdString();
}

TEST_F(LiveChartTest, ScrollsBackThroughAllThatIsKept) {
  framesTo(120.0);
  chart_.scroll(-1.0);
  EXPECT_FALSE(chart_.following());
  EXPECT_NEAR(chart_.seen().lower, 60.0, 1e-9);
  EXPECT_DOUBLE_EQ(lastDrawn(2), 90.1) << "with the neighbour beyond the edge";
  chart_.scroll(-10.0);
  EXPECT_NEAR(chart_.seen().lower, 0.0, 1e-9) << "no further than there are data";
  chart_.scroll(1.0);
  EXPECT_NEAR(chart_.seen().lower, 30.0, 1e-9);
  chart_.scroll(10.0);
  EXPECT_TRUE(chart_.following()) << "at the newest frame it follows again";
  EXPECT_NEAR(chart_.seen().upper, 120.0, 1e-9);
  chart_.showOldest();
  EXPECT_NEAR(chart_.seen().lower, 0.0, 1e-9);
  EXPECT_FALSE(chart_.following());
}

TEST_F(LiveChartTest, WheelAndMouseScroll) {
  framesTo(120.0);
  wheel(1, Qt::ShiftModifier);
  EXPECT_NEAR(chart_.seen().lower, 87.0, 1e-9) << "a tenth of what is seen";
  wheel(-2, Qt::ShiftModifier);
  EXPECT_TRUE(chart_.following());
  const QRect plot = chart_.axisRect()->rect();
  drag(plot.center(), plot.center() + QPoint(plot.width() / 3, 0), Qt::ShiftModifier);
  EXPECT_FALSE(chart_.following());
  EXPECT_NEAR(chart_.seen().lower, 80.0, 0.2);
  // The wheel zooms about the mouse now.
  chart_.replot();
  const double under = chart_.secondsAt(300);
  wheel(1);
  EXPECT_NEAR(chart_.secondsAt(300), under, 1e-6);
  EXPECT_NEAR(chart_.windowS(), 24.0, 1e-9);
  QTest::mouseDClick(&chart_, Qt::LeftButton, {}, plot.center());
  EXPECT_TRUE(chart_.following());
}

TEST_F(LiveChartTest, WhatIsForgottenCannotBeScrolledTo) {
  framesTo(1.0);
  for (int i = 11; i <= 7000; ++i) frame(i / 10.0, 1.0);
  chart_.refresh(0.0);
  chart_.showOldest();
  EXPECT_NEAR(chart_.seen().lower, 100.0, 1e-6) << "ten minutes are kept";
}

TEST_F(LiveChartTest, TwoCursorsMeasureDifferences) {
  framesTo(20.0);
  QSignalSpy changed(&chart_, &LiveChart::cursorsChanged);
  drag(pointAt(4.0) + QPoint(1, 0), pointAt(10.0) + QPoint(1, 0));
  ASSERT_TRUE(chart_.cursors()[0] && chart_.cursors()[1]);
  EXPECT_GE(changed.size(), 2);
  EXPECT_NEAR(*chart_.cursors()[0], 4.0, 0.11);
  EXPECT_NEAR(*chart_.cursors()[1], 10.0, 0.11);
  chart_.setTimeCursor(1, 4.0);
  chart_.setTimeCursor(0, 10.0);  // in the other order
  EXPECT_EQ(chart_.cursorWords(), "4.00 – 10.00 s · Δt 6.00 s");
  plot({2});
  chart_.replot();
  auto* readings = chart_.findChild<QLabel*>("cursorReadings");
  EXPECT_TRUE(readings->isVisible());
  EXPECT_EQ(readings->text(),
            "Δt 6.000 s · 0.17 Hz\nfinger 1 proximal  4 counts → 10 counts  Δ +6 counts");
  const TextTable table = chart_.cursorTable();
  ASSERT_EQ(table.numRows, 2u);
  EXPECT_EQ(table.row(0), (std::vector<std::string>{"time", "s", "4", "10", "6"}));
  EXPECT_EQ(table.row(1),
            (std::vector<std::string>{"finger 1 proximal", "counts", "4", "10", "6"}));
}

TEST_F(LiveChartTest, CursorsMoveByFramesAndAreRemovedByAClick) {
  framesTo(20.0);
  chart_.setTimeCursorHere(0);
  EXPECT_EQ(chart_.cursors()[0], 20.0) << "at the newest frame";
  EXPECT_EQ(chart_.cursorWords(), "20.00 s");
  chart_.moveTimeCursor(-5);
  EXPECT_EQ(chart_.cursors()[0], 19.5);
  EXPECT_FALSE(chart_.following()) << "who measures wants it to stay";
  chart_.moveTimeCursor(1);
  EXPECT_EQ(chart_.cursors()[0], 19.6);
  // A cursor can be dragged.
  drag(pointAt(19.6), pointAt(10.0) + QPoint(1, 0));
  EXPECT_NEAR(*chart_.cursors()[0], 10.0, 0.11);
  EXPECT_FALSE(chart_.cursors()[1]);
  QTest::mouseClick(&chart_, Qt::LeftButton, {}, pointAt(2.0));
  EXPECT_FALSE(chart_.cursors()[0]);
  EXPECT_FALSE(chart_.findChild<QLabel*>("cursorReadings")->isVisible());
}

TEST_F(LiveChartTest, ManyCurvesAtTheCursorsAreCutToTheHeight) {
  framesTo(20.0);
  chart_.resize(900, 130);
  chart_.setTimeCursor(0, 4.0);
  chart_.setTimeCursor(1, 5.0);
  chart_.replot();
  auto* readings = chart_.findChild<QLabel*>("cursorReadings");
  EXPECT_TRUE(readings->text().contains(" more")) << readings->text().toStdString();
  EXPECT_LE(readings->geometry().bottom(), chart_.height());
}

TEST_F(LiveChartTest, AnAxisIsSetByHand) {
  framesTo(20.0);
  plot({2});
  QSignalSpy changed(&chart_.axes(), &UnitAxes::byHandChanged);
  chart_.axes().setByHand("counts", AxisRange{5.0, 15.0});
  EXPECT_EQ(changed.size(), 1);
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(5.0, 15.0));
  frame(21.0, 900.0);
  chart_.refresh(0.0);
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(5.0, 15.0)) << "values don't change it";
  plot({2, 3});
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(5.0, 15.0)) << "nor other curves of the unit";
  chart_.axes().setByHand("counts", AxisRange{7.0, 7.0});
  EXPECT_EQ(chart_.yAxis->range(), QCPRange(5.0, 15.0)) << "that is no range";
  chart_.axes().setByHand("counts", std::nullopt);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().lower, 0.0);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 1000.0);
}

TEST_F(LiveChartTest, TheMouseOverAnAxisSetsItsRange) {
  framesTo(20.0);
  plot({2});
  chart_.replot();
  const QRect plot = chart_.axisRect()->rect();
  const QPoint onAxis(plot.left() / 2, plot.center().y());
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 50.0);
  wheel(1, {}, onAxis);
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 40.0) << "0 stays where it is";
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().lower, 0.0);
  EXPECT_DOUBLE_EQ(chart_.windowS(), LiveChart::kUsualS);
  drag(onAxis, onAxis + QPoint(0, plot.height() / 2));
  EXPECT_NEAR(chart_.yAxis->range().lower, 20.0, 0.5);
  EXPECT_NEAR(chart_.yAxis->range().upper, 60.0, 0.5);
  EXPECT_FALSE(chart_.cursors()[0]);
  QTest::mouseDClick(&chart_, Qt::LeftButton, {}, onAxis);
  EXPECT_TRUE(chart_.axes().byHand().empty());
  EXPECT_DOUBLE_EQ(chart_.yAxis->range().upper, 50.0);
}

}  // namespace
}  // namespace palpate::gui::live_chart_test
