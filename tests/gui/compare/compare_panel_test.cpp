// What a comparison shows: alignment, cursor, curves, colours, figures.
#include "gui/compare/compare_fixture.h"
#include "testing/time_limit.h"

namespace palpate::gui::compare_panel_test {
namespace {

using ComparePanelTest = CompareWindowFixture;

TEST_F(ComparePanelTest, LaysFirstContactsOnTopOfEachOther) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  EXPECT_EQ(name(compare().a()), "early");
  EXPECT_EQ(name(compare().b()), "late");
  ASSERT_TRUE(compare().offsetS());
  EXPECT_NEAR(*compare().offsetS(), 0.5 - 1.5, 1e-9);
  playback().seekFrame(10);
  EXPECT_EQ(valueIn(CompareGroup::kA), 500.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 300.0F);
  EXPECT_EQ(valueIn(CompareGroup::kDifference), 200.0F);
  playback().seekFrame(9);
  EXPECT_EQ(valueIn(CompareGroup::kA), 0.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 0.0F);
  EXPECT_EQ(compare().notice(), "");
}

// Heat maps and curves are seen at once in a small window.
TEST_F(ComparePanelTest, InASmallWindowTheChartIsSeenBesideTheHeatMaps) {
  open({"early.dsa", "late.dsa"});
  window().setAnimated(false);
  window().resize(1024, 700);
  window().docks().reset();
  compareNow();
  for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
  ASSERT_EQ(window().size(), QSize(1024, 700));
  EXPECT_EQ(compare().chart().visibleRegion().boundingRect().size(), compare().chart().size())
      << compare().chart().height();
}

// On a screen with twice the pixels.
class FineCompareView : public CompareView {
 public:
  int painted = 0;

 protected:
  int metric(PaintDeviceMetric which) const override {
    if (which == PdmDevicePixelRatio) return 2;
    if (which == PdmDevicePixelRatioScaled) return static_cast<int>(2.0 * devicePixelRatioFScale());
    return CompareView::metric(which);
  }
  void paintEvent(QPaintEvent* event) override {
    ++painted;
    CompareView::paintEvent(event);
  }
};

TEST(CompareView, IsPaintedOnceOnAScreenWithMorePixels) {
  FineCompareView view;
  ASSERT_EQ(view.devicePixelRatioF(), 2.0);
  view.resize(900, 400);
  view.setHands({sdh2(), sdh2(), sdh2()});
  view.show();
  for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
  view.painted = 0;
  view.setHands({sdh2(), sdh2(), sdh2()});
  for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
  EXPECT_EQ(view.painted, 1);
}

TEST_F(ComparePanelTest, TheOtherAlignments) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  choose("compareAlignment", "start of both");
  EXPECT_NEAR(*compare().offsetS(), 0.0, 1e-9);
  playback().seekFrame(30);
  EXPECT_EQ(valueIn(CompareGroup::kA), 520.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 300.0F);
  choose("compareAlignment", "clock time");
  EXPECT_NEAR(*compare().offsetS(), 3600.0, 1e-6);
  EXPECT_EQ(valueIn(CompareGroup::kB), -1.0F) << "B begins an hour later";
  EXPECT_TRUE(compare().notice().contains("No common time: B begins"));
  EXPECT_EQ(compare().figures(), "no common time");
  choose("compareAlignment", "first contact");
  EXPECT_NEAR(*compare().offsetS(), -1.0, 1e-9);
}

TEST_F(ComparePanelTest, AnOffsetByHandIsTypedOrDragged) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  auto* field = find<QDoubleSpinBox>("compareOffset");
  EXPECT_NEAR(field->value(), -1.0, 1e-6);
  field->setValue(0.25);
  settle();
  EXPECT_EQ(compare().alignment(), Alignment::kManual);
  EXPECT_EQ(find<QComboBox>("compareAlignment")->currentText(), "by hand");
  EXPECT_NEAR(*compare().offsetS(), 0.25, 1e-9);
  // B's bar, a tenth of the chart to the right.
  CompareChart& chart = compare().chart();
  const double pixels = 0.1 * chart.axisRect()->width();
  const double seconds = 0.1 * chart.xAxis->range().size();
  const QPointF grip = compare().strip().barRect(true).center();
  drag(compare().strip(), grip, grip + QPointF(pixels, 0));
  EXPECT_NEAR(*compare().offsetS(), 0.25 + seconds, 0.02);
  EXPECT_NEAR(field->value(), *compare().offsetS(), 1e-3);
  // With Ctrl in the chart, back again.
  const double before = *compare().offsetS();
  const double perPixel = chart.xAxis->range().size() / chart.axisRect()->width();
  const QPointF middle = chart.axisRect()->rect().center();
  drag(chart, middle, middle - QPointF(60, 0), Qt::ControlModifier);
  EXPECT_NEAR(*compare().offsetS(), before - 60 * perPixel, 0.02);
  // A's bar stays where it is.
  const double now = *compare().offsetS();
  const QPointF ofA = compare().strip().barRect(false).center();
  drag(compare().strip(), ofA, ofA + QPointF(50, 0));
  EXPECT_EQ(*compare().offsetS(), now);
}

TEST_F(ComparePanelTest, TheCursorMovesBothAndTheChartSeeks) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  CompareChart& chart = compare().chart();
  const auto click = [&](double seconds) {
    const QPointF at(chart.pixelOf(seconds), chart.axisRect()->rect().center().y());
    drag(chart, at, at);
  };
  click(1.26);
  EXPECT_EQ(playback().frame(), 25u);
  EXPECT_EQ(valueIn(CompareGroup::kA), 515.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 315.0F);
  press(Qt::Key_Right);
  EXPECT_EQ(valueIn(CompareGroup::kA), 516.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 316.0F);
  EXPECT_NEAR(chart.cursorPixel(), chart.pixelOf(1.30), 2.0);
  // Before A begins there is B alone; the playback waits at A's begin.
  click(-0.5);
  EXPECT_EQ(playback().frame(), 0u);
  EXPECT_EQ(valueIn(CompareGroup::kA), -1.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 0.0F);
  EXPECT_EQ(compare().view().frames()[0].notice, "A begins 0.50 s later");
}

TEST_F(ComparePanelTest, PlayingPlaysBoth) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  playback().play();
  clock_.advanceMs(500);
  playback().tick();
  EXPECT_EQ(valueIn(CompareGroup::kA), 510.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 310.0F);
}

TEST_F(ComparePanelTest, CurvesFollowSignalAndMatrix) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  const auto& curves = compare().chart().curves();
  ASSERT_TRUE(curves.curveA && curves.curveB);
  EXPECT_EQ(curves.curveA->values.size(), 60u);
  EXPECT_NEAR(curves.curveA->values[20], 510.0, 1e-9);
  EXPECT_NEAR(curves.curveB->values[40], 310.0, 1e-9);
  EXPECT_EQ(compare().chart().graph(0)->pen().style(), Qt::SolidLine);
  EXPECT_EQ(compare().chart().graph(1)->pen().style(), Qt::DashLine);
  // From 0 to 2.95 s 60 moments; B is 200 counts below A in the last 50 of them.
  const QString figures = compare().figures();
  EXPECT_TRUE(figures.contains("mean +166.7, rms 182.6, largest +200.0 counts at 0.50 s"))
      << figures.toStdString();
  EXPECT_TRUE(figures.endsWith("over 2.95 s in common")) << figures.toStdString();
  // 60 pairs (0, 0) x 10, (500 + k, 300 + k), k = 0..49: computed by hand from the sums.
  EXPECT_TRUE(figures.startsWith("correlation 0.999")) << figures.toStdString();
  choose("compareSignal", "active taxels");
  EXPECT_EQ(window().state().appearance.view().signal, PlottedSignal::kActive);
  EXPECT_NEAR(compare().chart().curves().curveA->values[20], 12.0, 1e-9);
  choose("compareMatrix", "finger 0 proximal");
  EXPECT_NEAR(compare().chart().curves().curveA->values[20], 0.0, 1e-9);
  EXPECT_TRUE(compare().figures().contains("correlation not defined"));
}

TEST_F(ComparePanelTest, RangesAreSharedAndSymmetric) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  const ComparePictureOptions whole = compare().view().options();
  EXPECT_EQ(whole.look.rangeMin, 0.0);
  EXPECT_EQ(whole.look.rangeMax, 549.0);  // A's last frame: 500 + 49
  EXPECT_EQ(whole.largestDifference, 200.0);
  WindowTest::choose("ranges", 1);
  EXPECT_EQ(compare().view().options().look.rangeMax, 500.0);
  WindowTest::choose("ranges", 2);
  EXPECT_EQ(compare().view().options().look.rangeMax, 4095.0);
  EXPECT_EQ(compare().view().options().largestDifference, 4095.0);
  trigger("values");
  EXPECT_TRUE(compare().view().options().look.values);
  trigger("interpolated");
  EXPECT_TRUE(compare().view().options().look.interpolated);
}

TEST_F(ComparePanelTest, HoverTellsAllThree) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  CompareView& view = compare().view();
  for (const CompareGroup group : kAllCompareGroups) {
    const QPointF at = view.geometryOfGroups().group(group).taxelRect(1, 6, 2).center();
    QMouseEvent event(
        QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&view, &event);
    EXPECT_EQ(view.hoverText(), "finger 0 distal · x 2, y 6 · A 500 · B 300 · A − B +200 counts");
  }
}

TEST_F(ComparePanelTest, IsTakenAwayAsPictureAndTables) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(10);
  QImage image(1000, 700, QImage::Format_RGB32);
  image.fill(Qt::magenta);
  QPainter painter(&image);
  PictureLook look;
  look.size = image.size();
  look.forPrint = true;
  compare().paint(painter, look);
  painter.end();
  int left = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      left += image.pixelColor(x, y) == QColor(Qt::magenta) ? 1 : 0;
  EXPECT_EQ(left, 0);
  const TextTable differences = compare().differenceTable();
  ASSERT_EQ(differences.numRows, 7u);
  EXPECT_EQ(differences.row(1),
            (std::vector<std::string>{"finger 0 distal", "12", "200", "200", "200", "5", "1"}));
  const TextTable curves = compare().curveTable();
  ASSERT_EQ(curves.numRows, 60u);
  EXPECT_EQ(curves.row(10), (std::vector<std::string>{"0.5", "10", "500", "30", "300"}));
}

TEST_F(ComparePanelTest, OpensAtTheCommonContact) {
  open({"early.dsa", "late.dsa"});
  ASSERT_EQ(playback().frame(), 0u);
  compareNow();
  EXPECT_EQ(playback().frame(), 10u) << "A's contact";
  EXPECT_EQ(valueIn(CompareGroup::kA), 500.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 300.0F);
  // A moment that was chosen before stays.
  press(Qt::Key_Escape);
  playback().seekFrame(33);
  compareNow();
  EXPECT_EQ(playback().frame(), 33u);
}

TEST_F(ComparePanelTest, AlignsAGraspOfAWithAGraspOfB) {
  open({"three.dsa", "two.dsa"});
  compareNow();
  EXPECT_FALSE(find<QComboBox>("compareGraspA")->isVisible());
  choose("compareAlignment", "grasps");
  ASSERT_EQ(find<QComboBox>("compareGraspA")->count(), 3);
  ASSERT_EQ(find<QComboBox>("compareGraspB")->count(), 2);
  EXPECT_NEAR(*compare().offsetS(), 0.0, 1e-9) << "the first grasps";
  choose("compareGraspA", "grasp 3");
  choose("compareGraspB", "grasp 2");
  // Grasp n begins with frame 35 (n - 1) + 10.
  EXPECT_NEAR(*compare().offsetS(), (80 - 45) * 0.05, 1e-9);
  playback().seekFrame(80);
  EXPECT_EQ(valueIn(CompareGroup::kA), 700.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 400.0F);
  EXPECT_EQ(compare().notice(), "");
  choose("compareB", "three.dsa");
  choose("compareAlignment", "first contact");
  EXPECT_FALSE(find<QComboBox>("compareGraspB")->isVisible());
}

// Every moment of grasp 3 of A is 300 counts above grasp 2 of B; the rest of the recordings differs
// in other ways.
TEST_F(ComparePanelTest, TheFiguresOfGraspsAreOverWhatBothHave) {
  open({"three.dsa", "two.dsa"});
  compareNow();
  choose("compareAlignment", "grasps");
  choose("compareGraspA", "grasp 3");
  choose("compareGraspB", "grasp 2");
  const QString figures = compare().figures();
  // The grasp is frames 80 to 104 of A.
  EXPECT_TRUE(
      figures.startsWith("correlation 1.000 · A − B: mean +300.0, rms 300.0, largest "
                         "+300.0 counts"))
      << figures.toStdString();
  EXPECT_TRUE(figures.endsWith("over what both grasps have, 4.00 to 5.20 s"))
      << figures.toStdString();
  choose("compareOverlay", "grasps of A");
  EXPECT_TRUE(compare().figures().endsWith(
      "A and B: correlation 1.000 over what both grasps have, 4.00 to 5.20 s"))
      << compare().figures().toStdString();
  choose("compareAlignment", "start of both");
  EXPECT_TRUE(compare().figures().endsWith(" s in common")) << compare().figures().toStdString();
}

TEST_F(ComparePanelTest, TheSameRecordingTwiceBeginsWithItsFirstTwoGrasps) {
  open({"three.dsa"});
  compareNow();
  QTest::mouseClick(find<QPushButton>("compareItself"), Qt::LeftButton);
  settle();
  choose("compareAlignment", "grasps");
  EXPECT_NEAR(*compare().offsetS(), -35 * 0.05, 1e-9);
  playback().seekFrame(12);
  EXPECT_EQ(valueIn(CompareGroup::kA), 502.0F);
  EXPECT_EQ(valueIn(CompareGroup::kB), 602.0F);
}

TEST_F(ComparePanelTest, SwapKeepsTheChosenGrasps) {
  open({"three.dsa", "two.dsa"});
  compareNow();
  choose("compareAlignment", "grasps");
  choose("compareGraspA", "grasp 3");
  find<QToolButton>("compareSwap")->click();
  settle();
  EXPECT_EQ(find<QComboBox>("compareGraspA")->currentText(), "grasp 1");
  EXPECT_EQ(find<QComboBox>("compareGraspB")->currentText(), "grasp 3");
  EXPECT_NEAR(*compare().offsetS(), (10 - 80) * 0.05, 1e-9);
}

TEST_F(ComparePanelTest, AmongAllRecordingsARecordingComparedWithItselfCountsOnce) {
  open({"three.dsa", "two.dsa", "early.dsa"});
  compareNow();
  choose("compareB", "three.dsa");
  choose("compareAlignment", "grasps");
  choose("compareBand", "mean ± sd");
  const ComparedCurves& overlaid = compare().chart().curves().overlaid;
  EXPECT_EQ(overlaid.curves.size(), 2u) << "A and B";
  choose("compareOverlay", "all recordings");
  QStringList names;
  for (const OverlaidCurve& each : overlaid.curves) names.append(each.name);
  EXPECT_EQ(names.count("three.dsa"), 1) << names.join(", ").toStdString();
  EXPECT_FALSE(names.contains("B"));
}

TEST_F(ComparePanelTest, WithoutGraspsTheStartsAreUsedAndSaid) {
  open({"three.dsa", "third.dsa"});
  compareNow();
  choose("compareAlignment", "grasps");
  EXPECT_EQ(compare().notice(), "No grasp in B: the recordings are aligned at their starts");
  EXPECT_EQ(*compare().offsetS(), 0.0);
}

TEST_F(ComparePanelTest, OverlaysGraspsAndTheirAverage) {
  open({"three.dsa", "two.dsa", "third.dsa"});
  compareNow();
  choose("compareMatrix", "finger 0 distal");
  choose("compareOverlay", "grasps of A");
  const auto& overlaid = [&]() -> const ComparedCurves& {
    return compare().chart().curves().overlaid;
  };
  ASSERT_EQ(overlaid().curves.size(), 3u);
  EXPECT_EQ(overlaid().curves[1].name, "three.dsa, grasp 2");
  EXPECT_NEAR(overlaid().curves[1].curve.zeroS, 45 * 0.05, 1e-9);
  EXPECT_TRUE(overlaid().averages.empty());
  EXPECT_EQ(compare().chart().graphCount(), 2 + 3);
  EXPECT_NEAR(overlaid().zeroS, 0.5, 1e-9) << "where A's first grasp begins";
  choose("compareBand", "mean ± sd");
  ASSERT_EQ(overlaid().averages.size(), 1u);
  // At the contact 500, 600 and 700: mean 600, standard deviation 100 (n - 1).
  const AverageCurve average = *overlaid().averages[0].curve;
  const auto zero = static_cast<std::size_t>(
      std::find(average.timeS.begin(), average.timeS.end(), 0.0) - average.timeS.begin());
  ASSERT_LT(zero, average.timeS.size());
  EXPECT_NEAR(average.middle[zero], 600.0, 1e-9);
  EXPECT_NEAR(average.high[zero], 700.0, 1e-9);
  EXPECT_EQ(average.count[zero], 3u);
  EXPECT_TRUE(compare().figures().startsWith("3 grasps, mean ± sd · "))
      << compare().figures().toStdString();
  choose("compareOverlay", "all grasps");
  EXPECT_EQ(overlaid().curves.size(), 5u);
  EXPECT_EQ(compare().notice(), "Left out: third.dsa has no grasp");
  // One average for each object: 500, 600, 700 and 300, 400.
  ASSERT_EQ(overlaid().averages.size(), 2u);
  EXPECT_TRUE(compare().figures().startsWith("5 grasps, mean ± sd of each recording · "))
      << compare().figures().toStdString();
  choose("compareBand", "median, 10–90 %");
  const auto atContact = [&](std::size_t which, const char* of) {
    const OverlaidAverage& found = overlaid().averages.at(which);
    EXPECT_EQ(found.of, of);
    const auto& timeS = found.curve->timeS;
    const auto at =
        static_cast<std::size_t>(std::find(timeS.begin(), timeS.end(), 0.0) - timeS.begin());
    return std::array{
        found.curve->middle.at(at), found.curve->low.at(at), found.curve->high.at(at)};
  };
  // Ranks 0.2 and 1.8 of three, 0.1 and 0.9 of two.
  const auto three = atContact(0, "three.dsa"), two = atContact(1, "two.dsa");
  EXPECT_NEAR(three[0], 600.0, 1e-9);
  EXPECT_NEAR(three[1], 520.0, 1e-9);
  EXPECT_NEAR(three[2], 680.0, 1e-9);
  EXPECT_NEAR(two[0], 350.0, 1e-9);
  EXPECT_NEAR(two[1], 310.0, 1e-9);
  EXPECT_NEAR(two[2], 390.0, 1e-9);
  const TextTable table = compare().averageTable();
  EXPECT_EQ(table.header.at(3), "three.dsa median [counts]");
  EXPECT_EQ(table.header.at(6), "two.dsa curves");
  ASSERT_EQ(table.header.size(), 2u + 2u * 4u + 5u);
  for (std::size_t i = 0; i < table.numRows; ++i)
    if (table.row(i).at(1) == "0") {
      EXPECT_EQ(table.row(i).at(2), "3");
      EXPECT_EQ(table.row(i).at(3), "600");
      EXPECT_EQ(table.row(i).at(6), "2");
      EXPECT_EQ(table.row(i).at(7), "350");
    }
}

TEST_F(ComparePanelTest, OverlaysAllOpenRecordings) {
  open({"early.dsa", "late.dsa", "third.dsa", "untouched.dsa"});
  compareNow();
  choose("compareOverlay", "all recordings");
  const ComparedCurves& overlaid = compare().chart().curves().overlaid;
  ASSERT_EQ(overlaid.curves.size(), 3u);
  EXPECT_EQ(compare().notice(), "Left out: untouched.dsa has no contact");
  // Contacts at 0.5, 1.5 and 0.25 s.
  EXPECT_NEAR(overlaid.zeroS, 0.5, 1e-9);
  EXPECT_NEAR(overlaid.curves[1].curve.zeroS, 1.5, 1e-9);
  EXPECT_NEAR(overlaid.curves[2].curve.zeroS, 0.25, 1e-9);
  EXPECT_EQ(compare().chart().graphCount(), 3) << "A and B are drawn once";
  choose("compareBand", "mean ± sd");
  EXPECT_EQ(compare().chart().graphCount(), 6);
  choose("compareOverlay", "A and B");
  EXPECT_TRUE(compare().figures().startsWith("2 curves, mean ± sd"));
  // The choice is remembered.
  window().close();
  start();
  EXPECT_EQ(compare().band(), CompareBand::kStandardDeviation);
  EXPECT_EQ(compare().overlay(), CompareOverlay::kPair);
}

TEST_F(ComparePanelTest, MovingTheCursorIsQuick) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  std::vector<double> times;
  for (int i = 0; i < 40; ++i) {
    QElapsedTimer clock;
    clock.start();
    playback().seekFrame(static_cast<std::size_t>(i));
    compare().view().repaint();
    times.push_back(static_cast<double>(clock.nsecsElapsed()) / 1e6);
  }
  std::sort(times.begin(), times.end());
  RecordProperty("median_us", static_cast<int>(1000 * times[20]));
  EXPECT_LT(times[20], testing::timeLimit(16.0)) << "ms, the median of 40";
}

TEST_F(ComparePanelTest, ColumnsOfFurtherSeriesAreComparedByName) {
  open({"wrist.palpate", "other_wrist.palpate", "early.dsa"});
  compareNow();
  choose("compareMatrix", "wrist fx");
  EXPECT_FALSE(find<QComboBox>("compareSignal")->isEnabled());
  const auto& curves = compare().chart().curves();
  ASSERT_TRUE(curves.curveA && curves.curveB);
  ASSERT_EQ(curves.curveA->values.size(), 40u) << "its own samples";
  EXPECT_NEAR(curves.curveA->timeS[20], 0.03 + 20 * 0.05, 1e-9);
  EXPECT_EQ(curves.curveA->values[20], 20.5);
  EXPECT_EQ(curves.curveB->values[20], 20.5);
  EXPECT_TRUE(compare().figures().contains(" N at ")) << compare().figures().toStdString();
  EXPECT_EQ(compare().curveTable().header[2], "a wrist fx [N]");
  EXPECT_EQ(compare().curveTable().header[1], "sample_a");
  EXPECT_EQ(compare().curveTable().numRows, 40u);
  choose("compareMatrix", "wrist fz");
  EXPECT_LT(compare().chart().yAxis->range().lower, -78.0) << "it has negative values";
  choose("compareMatrix", "all matrices");
  EXPECT_TRUE(find<QComboBox>("compareSignal")->isEnabled());
  EXPECT_EQ(compare().chart().yAxis->range().lower, 0.0);
  compare().setB(window().state().recordings.all().back());
  settle();
  choose("compareMatrix", "wrist fx");
  EXPECT_EQ(compare().figures(), "the other recording has no such series");
}

}  // namespace
}  // namespace palpate::gui::compare_panel_test
