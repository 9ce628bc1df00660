// The dock Spectrum in the real window.
#include <QDockWidget>
#include <QLabel>

#include "palpate/device/sdh2.h"

#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/matrices/matrices_view.h"
#include "gui/spectrum/spectrum_feature.h"
#include "gui/spectrum/spectrum_panel.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"

namespace palpate::gui::spectrum_window_test {
namespace {

class SpectrumWindowTest : public WindowTest {
 protected:
  SpectrumWindowTest() { open({"rich.dsa"}); }
  QDockWidget* dock() { return window().findChild<QDockWidget*>("Spectrum"); }
  SpectrumPanel& panel() { return window().feature<SpectrumFeature>().panel(); }
  TimelineChart& timeline() { return *window().findChild<TimelineChart*>(); }
  void showIt() {
    press(Qt::Key_U, Qt::ControlModifier);
    panel().settle();
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  }
  bool canBeTaken() {
    for (const ExportedView* view : window().feature<ExportFeature>().exportController().present())
      if (view->name == "Spectrum") return true;
    return false;
  }
};

TEST_F(SpectrumWindowTest, ComesAndGoesByItsKey) {
  EXPECT_FALSE(dock()->isVisible());
  EXPECT_FALSE(canBeTaken());
  showIt();
  EXPECT_TRUE(dock()->isVisible());
  EXPECT_TRUE(panel().shown());
  EXPECT_TRUE(canBeTaken());
  press(Qt::Key_U, Qt::ControlModifier);
  EXPECT_FALSE(dock()->isVisible());
}

TEST_F(SpectrumWindowTest, SharesTimeAndCursorWithTheTimeline) {
  showIt();
  const auto same = [&] {
    QCoreApplication::processEvents();
    QCoreApplication::processEvents();
    return panel().chart().xAxis->range() == timeline().seen();
  };
  EXPECT_TRUE(same());
  timeline().setVisibleRange(1.0, 2.5);
  EXPECT_TRUE(same());
  emit panel().chart().zoomRequested(1.5, 2.0);
  EXPECT_NEAR(timeline().seen().size(), 0.75, 1e-9);
  EXPECT_TRUE(same());
  emit panel().chart().fitRequested();
  EXPECT_TRUE(same());
  SpectrumChart& chart = panel().chart();
  const QPoint at(static_cast<int>(chart.xAxis->coordToPixel(2.0)), chart.height() / 2);
  QTest::mouseClick(&chart, Qt::LeftButton, {}, at);
  EXPECT_NEAR(playback().positionS(), 2.0, 0.05);
  const auto* cursor = chart.findChild<QWidget*>("cursor");
  EXPECT_NEAR(cursor->geometry().center().x(), at.x(), 3);
  playback().seekSeconds(1.0);
  EXPECT_NEAR(cursor->geometry().center().x(), chart.xAxis->coordToPixel(1.0), 3);
}

TEST_F(SpectrumWindowTest, FollowsTheChosenTaxels) {
  showIt();
  auto* view = find<MatricesView>("matricesView");
  TaxelSelection chosen(*sdh2().layout);
  chosen.add(5, 6, 2, 7, 3);
  view->select(chosen);
  panel().settle();
  EXPECT_EQ(panel().name(), "mean of 4 taxels");
  view->clearSelection();
  panel().settle();
  EXPECT_TRUE(find<QLabel>("spectrumName")->toolTip().contains("strongest"));
}

TEST_F(SpectrumWindowTest, FollowsTheRecordingThatIsShown) {
  showIt();
  open({"good2.dsa"});
  panel().settle();
  EXPECT_TRUE(panel().emptyText().contains("20 samples")) << panel().emptyText().toStdString();
  press(Qt::Key_W, Qt::ControlModifier);
  panel().settle();
  EXPECT_TRUE(panel().shown()) << "the other one is back";
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_TRUE(panel().emptyText().contains("Open a recording"));
}

TEST_F(SpectrumWindowTest, EscapeGivesItUp) {
  showIt();
  panel().header().setSetting({.window = 64, .overlap = 63});
  ASSERT_TRUE(panel().busy());
  press(Qt::Key_Escape);
  EXPECT_FALSE(panel().busy());
  EXPECT_EQ(panel().emptyText(), "Cancelled.");
}

TEST_F(SpectrumWindowTest, IsTakenAwayAsPictureAndTable) {
  showIt();
  ExportRequest request;
  request.view = "Spectrum";
  request.folder = QString::fromStdString(folder_.path().string());
  request.name = "s";
  for (const ExportFormat form : {ExportFormat::kPng, ExportFormat::kSvg, ExportFormat::kCsv}) {
    request.form = form;
    window().feature<ExportFeature>().exportController().write(request);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return !window().feature<ExportFeature>().exportController().busy(); }, 20'000));
    EXPECT_EQ(bannerText(), "");
  }
  const QImage image(QString::fromStdString((folder_ / "s.png").string()));
  EXPECT_EQ(image.pixelColor(1, 1), QColor(Qt::white));
  std::size_t dark = 0;  // the map's lower end
  for (int y = 0; y < image.height(); y += 4)
    for (int x = 0; x < image.width(); x += 4) dark += image.pixelColor(x, y).lightness() < 40;
  EXPECT_GT(dark, 500u);
  EXPECT_NE(testing::readFile(folder_ / "s.svg").find("Nyquist"), std::string::npos);
  EXPECT_EQ(
      testing::readFile(folder_ / "s.csv").find("segment,time_s,frequency_hz,psd,magnitude\n"), 0u);
  EXPECT_EQ(panel().chart().xAxis->labelColor(),
            colorsOf(resolved(window().state().appearance.view().theme)).muted)
      << "the screen is as before";
}

TEST_F(SpectrumWindowTest, InTheSmallestWindowItStandsBeforeTheTimeline) {
  window().resize(900, 600);
  QCoreApplication::processEvents();
  showIt();
  EXPECT_EQ(window().height(), 600);
  EXPECT_TRUE(
      window().tabifiedDockWidgets(dock()).contains(window().findChild<QDockWidget*>("Timeline")));
  EXPECT_TRUE(panel().shown());
  EXPECT_GE(panel().chart().height(), panel().chart().minimumSizeHint().height());
}

TEST_F(SpectrumWindowTest, InTheUsualOneItStandsAboveTheTimeline) {
  showIt();
  EXPECT_GE(panel().chart().height(), panel().chart().minimumSizeHint().height());
  EXPECT_GT(timeline().visibleRegion().boundingRect().height(), 60);
  const auto* below = window().findChild<QDockWidget*>("Timeline");
  EXPECT_LE(dock()->geometry().bottom(), below->geometry().top());
}

}  // namespace
}  // namespace palpate::gui::spectrum_window_test
