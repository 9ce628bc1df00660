#include <QApplication>
#include <QStyle>
#include <QTableView>
#include <set>

#include "palpate/device/sdh2.h"
#include <palpate/emulator/synthetic_profile.h>
#include <palpate/model/hand_description.h>
#include <palpate/recording/palpate_writer.h>

#include "gui/inspect/inspect_panel.h"
#include "gui/testing/sample_profiles.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/facts_view.h"
#include "testing/wrist_profile.h"

namespace palpate::gui::inspect_test {
namespace {

class InspectTest : public WindowTest {
 protected:
  InspectPanel& panel() { return *window().findChild<InspectPanel*>(); }
  MatrixTableModel& table() { return panel().table(); }
  QString cell(int row, int column) {
    return table().index(row, column).data(Qt::DisplayRole).toString();
  }
  QString fact(const char* view, const QString& name) {
    for (const Fact& each : find<FactsView>(view)->facts())
      if (each.name == name) return each.value;
    return "no such fact";
  }
};

TEST_F(InspectTest, HasARowPerMatrixAndOneForAll) {
  open({"good.dsa"});
  ASSERT_EQ(table().rowCount(), 7);
  EXPECT_EQ(cell(0, MatrixTableModel::kName), "0 proximal");
  EXPECT_EQ(cell(1, MatrixTableModel::kName), "0 distal");
  EXPECT_EQ(cell(6, MatrixTableModel::kName), "all");
}

TEST_F(InspectTest, ShowsTheSignalsOfTheFrame) {
  open({"good.dsa"});
  playback().seekFrame(7);  // one taxel of 80 counts; its area is 3.4 mm squared: 11.56
  for (const int row : {1, 6}) {
    EXPECT_EQ(cell(row, MatrixTableModel::kActive), "1");
    EXPECT_EQ(cell(row, MatrixTableModel::kMean), "80");
    EXPECT_EQ(cell(row, MatrixTableModel::kMaximum), "80");
    EXPECT_EQ(cell(row, MatrixTableModel::kMinimum), "80");
    EXPECT_EQ(cell(row, MatrixTableModel::kSum), "80");
    EXPECT_EQ(cell(row, MatrixTableModel::kArea), "12");
  }
  EXPECT_EQ(cell(0, MatrixTableModel::kActive), "0");
  EXPECT_EQ(cell(0, MatrixTableModel::kMean), "–");
  press(Qt::Key_Right);
  EXPECT_EQ(cell(1, MatrixTableModel::kMean), "90");
}

TEST_F(InspectTest, NoNumberIsElided) {
  open({"good.dsa"});
  auto* view = find<QTableView>("matrixTable");
  table().showForces(std::vector<MatrixTableModel::Force>(
                         7, {.newtons = 112.99, .sd = 1.0, .inRange = true, .areaKnown = false}),
                     {});
  ASSERT_EQ(cell(1, MatrixTableModel::kForce), "≤ 112.99");
  const int margin = 2 * (view->style()->pixelMetric(QStyle::PM_FocusFrameHMargin) + 1);
  for (int column = 1; column < table().columnCount(); ++column) {
    if (view->isColumnHidden(column)) continue;
    for (int row = 0; row < table().rowCount(); ++row)
      EXPECT_EQ(view->fontMetrics().elidedText(
                    cell(row, column), Qt::ElideRight, view->columnWidth(column) - margin),
                cell(row, column));
  }
}

TEST_F(InspectTest, ARecordingWhoseTimesCountFromZeroHasNoDate) {
  open({"undated.csv"});
  EXPECT_EQ(fact("recordingFacts", "start (UTC)"), "no date is known");
}

TEST_F(InspectTest, OnlyWhatChangedIsToldToTheTable) {
  open({"good.dsa"});
  QSignalSpy changed(&table(), &QAbstractItemModel::dataChanged);
  press(Qt::Key_Right);
  EXPECT_EQ(changed.size(), 2) << "matrix 1 and all";
}

TEST_F(InspectTest, LiveValuesAreShownAtAReadableRateAndTheNewestOnesWhenNoneFollow) {
  InspectPanel panel;
  panel.setHand(sdh2());
  const auto mean = [&] {
    return panel.table().index(0, MatrixTableModel::kMean).data(Qt::DisplayRole).toString();
  };
  const auto show = [&](std::int64_t hostUs, double counts) {
    auto frame = std::make_shared<TactileFrame>(sdh2().layout);
    frame->hostUs = hostUs;
    LiveResults results;
    results.frame = frame;
    results.matrixSignals.resize(6);
    results.matrixSignals[0].mean = results.matrixSignals[0].sum = counts;
    results.matrixSignals[0].maximum = counts;
    results.matrixSignals[0].active = 1;
    panel.showLive(results);
    return mean();
  };
  EXPECT_EQ(show(1'000'000, 10.0), "10");
  EXPECT_EQ(show(1'033'000, 20.0), "10");
  EXPECT_EQ(show(1'066'000, 30.0), "10");
  EXPECT_EQ(show(1'100'000, 40.0), "40");
  EXPECT_EQ(show(1'133'000, 50.0), "40");
  panel.showLatest();
  EXPECT_EQ(mean(), "50");
  panel.showLatest();
  EXPECT_EQ(mean(), "50");
}

TEST_F(InspectTest, AClickOnATickPlotsTheRow) {
  open({"good.dsa"});
  auto* chart = window().findChild<TimelineChart*>();
  ASSERT_EQ(chart->graphCount(), 1);
  auto* view = find<MatrixTable>("matrixTable");
  const QRect row = view->visualRect(table().index(4, MatrixTableModel::kName));
  QTest::mouseClick(
      view->viewport(), Qt::LeftButton, {}, QPoint(row.left() + 10, row.center().y()));
  EXPECT_TRUE(table().plotted()[4]);
  EXPECT_EQ(chart->graphCount(), 2);
  EXPECT_TRUE(actions().all("plots")[4]->isChecked());
  QTest::mouseClick(
      view->viewport(), Qt::LeftButton, {}, QPoint(row.left() + 10, row.center().y()));
  EXPECT_EQ(chart->graphCount(), 1);
}

TEST_F(InspectTest, TicksHaveTheColoursOfTheCurves) {
  open({"good.dsa"});
  const QColor square = table().index(1, 0).data(Qt::DecorationRole).value<QColor>();
  EXPECT_EQ(window().findChild<TimelineChart*>()->graph(0)->pen().color(), square);
  std::set<QRgb> colors;
  for (const Theme theme : {Theme::kDark, Theme::kLight})
    for (std::size_t m = 0; m < 6; ++m) colors.insert(matrixColor(m, theme).rgb());
  EXPECT_EQ(colors.size(), 12u);
}

TEST_F(InspectTest, TellsWhatIsInTheRecording) {
  open({"gap.dsa"});
  EXPECT_EQ(fact("recordingFacts", "file"), "gap.dsa");
  EXPECT_EQ(fact("recordingFacts", "format"), "test, counts");
  EXPECT_EQ(fact("recordingFacts", "serial"), "1D9B0057");
  EXPECT_EQ(fact("recordingFacts", "start (UTC)"), "2014-05-13 16:53:20");
  EXPECT_EQ(fact("recordingFacts", "frames"), "10");
  EXPECT_EQ(fact("recordingFacts", "duration"), "10.47 s");
  EXPECT_EQ(fact("recordingFacts", "rate"), "20.0 Hz (mean 0.86)");
  EXPECT_EQ(fact("recordingFacts", "gaps"), "1, longest 10.1 s");
  EXPECT_EQ(fact("recordingFacts", "taxels"), "456");
  EXPECT_EQ(fact("recordingFacts", "largest value"), "100 counts");
}

TEST_F(InspectTest, SaysWhereThereAreNoAnglesAndTemperatures) {
  open({"good.dsa"});
  EXPECT_EQ(fact("angleFacts", "none in this recording"), "");
  EXPECT_EQ(fact("temperatureFacts", "none in this recording"), "");
}

TEST_F(InspectTest, ShowsAnglesAndTemperaturesAtTheCursor) {
  open({"rich.dsa"});
  const Profile& profile = window().state().displayed.unfilteredRecording()->profile;
  for (const std::size_t frame : {std::size_t{0}, profile.numFrames() / 2}) {
    playback().seekFrame(frame);
    const auto angles = profile.anglesAtFrame(frame);
    const auto temperatures = profile.temperaturesAtFrame(frame);
    ASSERT_TRUE(angles && temperatures);
    for (std::size_t i = 0; i < angles->values.size(); ++i) {
      const QString shown = fact("angleFacts", QString::fromStdString(profile.hand().axes[i].name));
      ASSERT_TRUE(shown.endsWith("°")) << shown.toStdString();
      EXPECT_NEAR(shown.chopped(1).toDouble(), angles->values[i], 0.051);
    }
    const QString motor = fact("temperatureFacts", "motor 0");
    ASSERT_TRUE(motor.endsWith(" °C")) << motor.toStdString();
    EXPECT_NEAR(motor.chopped(3).toDouble(), temperatures->values[0], 0.051);
  }
}

TEST_F(InspectTest, IsEmptyAfterTheLastRecordingIsClosed) {
  open({"good.dsa"});
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(table().rowCount(), 0);
  EXPECT_TRUE(find<FactsView>("recordingFacts")->facts().empty());
}

TEST_F(InspectTest, SaysWhoRecordedWhatAndWhatWasNoted) {
  // The frames are those that the fixture gives for the name; what was said and noted is read from
  // the file.
  const std::string path = (folder_ / "good_noted.palpate").string();
  const std::int64_t us = twentyFrames().frameTimeUs(0);
  {
    PalpateWriter writer(
        path, sdh2().layout, {{"operator", "Ada"}, {"object", "ball"}, {"run", "7"}});
    for (int i = 0; i < 10; ++i) {
      TactileFrame frame(sdh2().layout);
      frame.hostUs = us + i * 30'000;
      writer.addFrame(frame);
    }
    writer.addEvent({us + 60'000, us + 60'000, "label", {}, "touched", ""});
    writer.finish();
  }
  open({"good_noted.palpate"});
  EXPECT_EQ(fact("recordingFacts", "operator"), "Ada");
  EXPECT_EQ(fact("recordingFacts", "object"), "ball");
  EXPECT_EQ(fact("recordingFacts", "run"), "7");
  EXPECT_EQ(fact("recordingFacts", "notes"), "no such fact");
  EXPECT_EQ(fact("eventFacts", "0.06 s"), "label: touched");
  EXPECT_FALSE(find<FactsView>("eventFacts")->isHidden());
  open({"good.dsa"});
  EXPECT_EQ(fact("recordingFacts", "operator"), "no such fact");
  EXPECT_TRUE(find<FactsView>("eventFacts")->isHidden());
}

TEST_F(InspectTest, ShowsTheValuesOfFurtherSeries) {
  const auto recording = makeOpenedRecording(
      "x.palpate", testing::withWrist(synthesize({.durationS = 1.0, .grasps = 0}), 10));
  InspectPanel panel;
  panel.setRecording(recording, recording);
  auto& view = *panel.findChild<FactsView*>("seriesFacts");
  panel.showFrame(0, {}, {});
  ASSERT_EQ(view.facts().size(), 3u);
  EXPECT_EQ(view.facts()[0].name, "wrist fx");
  EXPECT_EQ(view.facts()[0].value, "–") << "before its first sample";
  panel.showFrame(recording->profile.numFrames() - 1, {}, {});
  EXPECT_EQ(view.facts()[0].value, "9.5 N");
  EXPECT_EQ(view.facts()[1].value, "-18 N");
  EXPECT_FALSE(view.isHidden());
  const auto without = makeOpenedRecording("y.dsa", twentyFrames());
  panel.setRecording(without, without);
  panel.showFrame(0, {}, {});
  EXPECT_TRUE(view.isHidden());
}

}  // namespace
}  // namespace palpate::gui::inspect_test
