// The dock Calibrate in the real window.
#include <QDockWidget>
#include <QPushButton>

#include <palpate/calibration/calibration.h>

#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/source/event_editor.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"

namespace palpate::gui::calibrate_window_test {
namespace {

class CalibrateWindowTest : public WindowTest {
 protected:
  CalibrateWindowTest() { open({"rich.dsa"}); }
  QDockWidget* dock() { return window().findChild<QDockWidget*>("Calibrate"); }
  CalibratePanel& panel() { return *find<CalibratePanel>("CalibratePanel"); }
  TimelineChart& timeline() { return *window().findChild<TimelineChart*>(); }
  void showIt(const char* page) {
    if (!dock()->isVisible()) press(Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
    panel().showPage(page);
    panel().settle();
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  }
  std::size_t eventsOf(const std::string& kind) {
    std::size_t count = 0;
    for (const Event& event : window().state().events.editor()->events())
      count += event.kind == kind;
    return count;
  }
};

TEST_F(CalibrateWindowTest, ComesAndGoesByItsKey) {
  EXPECT_FALSE(dock()->isVisible());
  showIt("Steps");
  EXPECT_TRUE(dock()->isVisible());
  EXPECT_GE(dock()->width(), 600);
  EXPECT_TRUE(window().docks().names().contains("Calibrate"));
  press(Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(dock()->isVisible());
}

TEST_F(CalibrateWindowTest, AChosenStepIsSeenInTheTimeline) {
  showIt("Steps");
  StepPage& steps = panel().steps();
  ASSERT_TRUE(steps.shown()) << steps.emptyText().toStdString();
  const double whole = timeline().seen().size();
  EXPECT_FALSE(timeline().selection()) << "nobody chose one";
  emit steps.spanChosen(1.0, 2.0);
  EXPECT_LT(timeline().seen().size(), whole);
  ASSERT_TRUE(timeline().selection());
  EXPECT_NEAR(timeline().selection()->fromS, 1.0, 0.05);
  EXPECT_NEAR(playback().positionS(), 1.0, 0.05);
}

TEST_F(CalibrateWindowTest, TheZeroIsAnEventThatCanBeUndone) {
  showIt("Tare");
  ASSERT_NE(panel().tare().found(), nullptr);
  EXPECT_EQ(eventsOf("tare"), 0u);
  emit panel().tare().keepRequested();
  EXPECT_EQ(eventsOf("tare"), 1u);
  EXPECT_TRUE(find<QPushButton>("tareRemove")->isVisible());
  EXPECT_TRUE(window().state().messages.flashed().contains("tare added"));
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(eventsOf("tare"), 0u);
  EXPECT_FALSE(window().state().messages.flashed().contains("tare added"));
  emit panel().tare().keepRequested();
  emit panel().tare().keepRequested();
  EXPECT_EQ(eventsOf("tare"), 1u) << "instead of the first";
  emit panel().tare().removeRequested();
  EXPECT_EQ(eventsOf("tare"), 0u);
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(eventsOf("tare"), 1u);
  EXPECT_TRUE(find<QPushButton>("tareRemove")->isVisible());
}

TEST_F(CalibrateWindowTest, TheSensorsSettingsAreKeptAsAnEvent) {
  showIt("Force");
  emit panel().force().keepRequested(0.5, 150.0);
  ASSERT_EQ(eventsOf("sensor_settings"), 1u);
  for (const Event& event : window().state().events.editor()->events())
    if (event.kind == "sensor_settings") {
      EXPECT_EQ(event.text, "sensitivity 0.5, threshold 150");
      EXPECT_EQ(Json::parse(event.json).at("sensitivity").asDouble(), 0.5);
    }
  EXPECT_NO_THROW(window().state().events.editor()->save()) << "such events are a person's";
  window().state().events.editor()->undoStack().undo();
  EXPECT_EQ(eventsOf("sensor_settings"), 0u);
}

TEST_F(CalibrateWindowTest, AnAppliedCalibrationIsRememberedForTheHand) {
  showIt("Force");
  EXPECT_TRUE(panel().force().emptyText().contains("No calibration"));
  Calibration calibration;
  for (const double t : {28.0, 36.0, 44.0})
    for (double k = 50.0; k <= 850.0; k += 100.0)
      calibration.samples.push_back({.file = "a",
                                     .sha256 = "",
                                     .pressureKpa = 0.1 * k + t / 100.0,
                                     .staticResponseCounts = k,
                                     .driftCountsPerS = 0.0,
                                     .nearestDegC = t});
  calibration.pressure = fitPressureModel(calibration.samples, {});
  const QString path = QString::fromStdString((folder_ / "c.json").string());
  saveCalibration(calibration, folder_ / "c.json");
  ask_.files = {path};
  find<QPushButton>("forceChoose")->click();
  panel().settle();
  EXPECT_TRUE(panel().force().shown()) << panel().force().emptyText().toStdString();
  start();
  open({"rich.dsa"});
  showIt("Force");
  EXPECT_TRUE(panel().force().shown()) << panel().force().emptyText().toStdString();
}

TEST_F(CalibrateWindowTest, IsTakenAwayAsPictureAndTable) {
  showIt("Steps");
  ExportRequest request;
  request.view = "Calibrate";
  request.folder = QString::fromStdString(folder_.path().string());
  request.name = "c";
  for (const ExportFormat form : {ExportFormat::kPng, ExportFormat::kCsv}) {
    request.form = form;
    window().feature<ExportFeature>().exportController().write(request);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return !window().feature<ExportFeature>().exportController().busy(); }, 20'000));
    EXPECT_EQ(bannerText(), "");
  }
  EXPECT_EQ(QImage(QString::fromStdString((folder_ / "c.png").string())).pixelColor(1, 1),
            QColor(Qt::white));
  EXPECT_EQ(testing::readFile(folder_ / "c.csv").find("step,begin_frame,end_frame"), 0u);
}

TEST_F(CalibrateWindowTest, FollowsTheRecordingThatIsShown) {
  showIt("Steps");
  open({"empty2.dsa"});
  panel().settle();
  EXPECT_TRUE(panel().page().emptyText().contains("no frame"));
  press(Qt::Key_W, Qt::ControlModifier);
  panel().settle();
  EXPECT_TRUE(panel().page().shown());
}

}  // namespace
}  // namespace palpate::gui::calibrate_window_test
