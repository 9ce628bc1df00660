// The window fits small screens: nothing is cut off and nothing lies over something else. Every
// size, theme, dock, page and size of text: window_fits_slow_test.cpp.
#include <QComboBox>
#include <QLineEdit>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QTableView>

#include "gui/shell/window_fits_fixture.h"
#include "gui/timeline/event_rows.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"
#include "gui/widgets/dock.h"

namespace palpate::gui::window_fits_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Sizes,
                         TextSizeFitsTest,
                         ::testing::Values(kMaxInterfaceTextPt),
                         ::testing::PrintToStringParamName());

TEST_P(TextSizeFitsTest, EveryDockInTheLargestText) {
  open({"rich.dsa"});
  window().settle();
  window().setAnimated(false);
  window().resize(sizes().front());
  for (const QString& name : window().docks().names()) {
    window().docks().reset();
    window().docks().show(name);
    expectNoFaults(name);
    EXPECT_EQ(window().size(), sizes().front()) << name.toStdString();
  }
}

TEST_F(WindowFitsTest, ARecordingWithEveryDockOnASmallScreen) {
  open({"rich.dsa"});
  window().settle();
  window().setAnimated(false);
  window().resize(kSizes[0]);
  for (const QString& name : window().docks().names()) {
    window().docks().reset();
    window().docks().show(name);
    expectNoFaults(name);
    EXPECT_EQ(window().size(), kSizes[0]) << name.toStdString();
  }
}

TEST_F(WindowFitsTest, ALiveHandOnASmallScreen) {
  connectEmulated();
  window().setAnimated(false);
  window().resize(kSizes[0]);
  window().docks().reset();
  expectNoFaults("live");
  EXPECT_EQ(window().size(), kSizes[0]);
}

TEST_F(WindowFitsTest, APageThatIsChosenHasTheWidthThatItNeeds) {
  window().resize(1440, 900);
  window().setAnimated(false);
  connectEmulated();
  window().docks().reset();
  window().docks().show("Calibrate");
  auto& panel = window().feature<CalibrateFeature>().panel();
  const auto* dock = find<Dock>("Calibrate");
  for (const QString& page : panel.pageNames()) {
    panel.showPage(page);
    window().settle();
    processAll();
    EXPECT_GE(dock->width(), dock->contentWidth()) << page.toStdString();
  }
}

TEST_P(TextSizeFitsTest, TheStartPage) {
  window().resize(kSizes[0]);
  expectNoFaults(QString("start page, text of %1 pt").arg(GetParam()));
  EXPECT_EQ(window().size(), kSizes[0]);
}

TEST_F(WindowFitsTest, ARecordingBesideALiveHand) {
  connectEmulated();
  open({"rich_recording_with_quite_a_long_name_of_an_object_2026-11-22_run_0123.dsa"});
  window().settle();
  for (const QSize size : {QSize(1280, 800), QSize(1024, 700)}) {
    window().resize(size);
    window().docks().reset();
    expectNoFaults(QString("%1x%2").arg(size.width()).arg(size.height()));
  }
}

TEST_F(WindowFitsTest, AllDocksAtOnceAreScrolledNotCut) {
  open({"rich.dsa"});
  window().resize(1280, 800);
  window().setAnimated(false);
  for (const QString& name : window().docks().names()) {
    window().docks().show(name);
    processAll();
  }
  EXPECT_EQ(window().size(), QSize(1280, 800));
  expectNoFaults("all docks");
}

TEST_F(WindowFitsTest, AHandBesideManyOpenDocksDoesNotEnlargeTheWindow) {
  const QSize size(1280, 764);
  window().resize(size);
  window().setAnimated(false);
  open({"rich.dsa"});
  for (const char* name : {"Spectrum", "Library", "Calibrate", "Slip", "Log", "Inspect"})
    window().docks().show(name);
  processAll();
  connectEmulated();
  processAll();
  EXPECT_EQ(window().size(), size);
  EXPECT_FALSE(find<QDockWidget>("Hand")->visibleRegion().isEmpty()) << "its Stop can be pressed";
  window().docks().show("Library");
  processAll();
  EXPECT_EQ(window().size(), size);
  EXPECT_FALSE(find<QDockWidget>("Library")->visibleRegion().isEmpty());
}

// Compare takes the place of the views in the centre: what lies around it has its size again after
// each visit.
TEST_F(WindowFitsTest, AfterTheComparisonEverythingHasItsSizeAgain) {
  const QSize size(1280, 740);
  window().resize(size);
  window().setAnimated(false);
  open({"rich.dsa"});
  for (const char* name : {"Inspect", "Library", "Spectrum"}) window().docks().show(name);
  processAll();
  ASSERT_EQ(window().size(), size);
  std::map<std::string, QSize> before;
  for (const QString& name : window().docks().names())
    if (auto* dock = find<QDockWidget>(name.toUtf8()); !dock->visibleRegion().isEmpty())
      before[name.toStdString()] = dock->size();
  for (int visit = 0; visit < 3; ++visit) {
    actions().at("compare")->trigger();
    processAll();
    EXPECT_EQ(window().size(), size) << "comparing, visit " << visit;
    actions().at("compare")->trigger();
    processAll();
    EXPECT_EQ(window().size(), size) << "visit " << visit;
    for (const auto& [name, was] : before) {
      EXPECT_NEAR(find<QDockWidget>(name.c_str())->width(), was.width(), 2) << name;
      EXPECT_NEAR(find<QDockWidget>(name.c_str())->height(), was.height(), 2) << name;
    }
  }
}

// A dock that needs more than the window has makes it grow; without the dock it has its size again,
// also when the dock was opened beside the comparison.
TEST_F(WindowFitsTest, AWindowThatHadToGrowHasItsSizeAgain) {
  const QSize size(1000, 600);
  QDockWidget* log = growForLog(size);
  log->close();
  processAll();
  EXPECT_TRUE(hasSizeAgain(size)) << "closed";
  actions().at("compare")->trigger();
  window().docks().show("Log");
  processAll();
  ASSERT_GT(window().height(), size.height());
  actions().at("compare")->trigger();
  processAll();
  EXPECT_TRUE(hasSizeAgain(size)) << "after the comparison";
  // It grows twice.
  auto* library = find<QDockWidget>("Library");
  library->widget()->setMinimumHeight(700);
  window().docks().show("Library");
  processAll();
  const int once = window().height();
  ASSERT_GT(once, size.height());
  window().docks().show("Log");
  processAll();
  ASSERT_GT(window().height(), once);
  log->close();
  library->close();
  processAll();
  EXPECT_TRUE(hasSizeAgain(size)) << "after both";
}

TEST_F(WindowFitsTest, AWindowThatHadToGrowHasItsSizeAgainWhenItsContentNeedsLess) {
  const QSize size(1000, 600);
  QDockWidget* log = growForLog(size);
  log->widget()->setMinimumHeight(0);
  processAll();
  EXPECT_TRUE(hasSizeAgain(size));
}

TEST_F(WindowFitsTest, TheWindowIsNoLargerThanTheScreen) {
  const QSize screen = QGuiApplication::primaryScreen()->availableSize();
  MainWindow fresh({.dataFolder = folder_.path(),
                    .settingsPath = QString::fromStdString((folder_ / "fresh.ini").string()),
                    .clock = &clock_,
                    .read = {}});
  fresh.show();
  QCoreApplication::processEvents();
  EXPECT_LE(fresh.frameGeometry().width(), screen.width());
  EXPECT_LE(fresh.frameGeometry().height(), screen.height());
}

TEST_F(WindowFitsTest, TheKeyOfADockBehindAnotherBringsItToTheFront) {
  open({"rich.dsa"});
  window().setAnimated(false);
  auto* inspect = find<QDockWidget>("Inspect");
  window().docks().show("Inspect");
  for (const char* name : {"Link", "Filter", "Log", "Slip", "Calibrate", "Recognise", "Hand"}) {
    auto* dock = find<QDockWidget>(name);
    const QKeySequence key = dock->toggleViewAction()->shortcut();
    press(key);
    processAll();
    EXPECT_FALSE(dock->visibleRegion().isEmpty()) << name << ", closed before";
    inspect->raise();
    processAll();
    ASSERT_TRUE(dock->visibleRegion().isEmpty()) << name;
    press(key);
    processAll();
    EXPECT_FALSE(dock->visibleRegion().isEmpty()) << name << ", behind Inspect before";
    EXPECT_TRUE(dock->toggleViewAction()->isChecked()) << name;
    press(key);
    processAll();
    EXPECT_TRUE(dock->isHidden()) << name << ", in front before";
    EXPECT_FALSE(dock->toggleViewAction()->isChecked()) << name;
  }
}

TEST_F(WindowFitsTest, ADockThatTookRoomGivesItBack) {
  open({"rich.dsa"});
  window().resize(1440, 900);
  window().setAnimated(false);
  window().docks().reset();
  processAll();
  const auto* timeline = find<QDockWidget>("Timeline");
  const auto* inspect = find<QDockWidget>("Inspect");
  const QSize timelineBefore = timeline->size(), inspectBefore = inspect->size();
  for (const char* name : {"Spectrum", "Slip"}) {
    const QKeySequence key = find<QDockWidget>(name)->toggleViewAction()->shortcut();
    press(key);
    processAll();
    press(key);
    processAll();
    EXPECT_NEAR(timeline->height(), timelineBefore.height(), 2) << name;
    EXPECT_EQ(inspect->width(), inspectBefore.width()) << name;
  }
}

// Between the docks of both sides there is too little room: what the one at the other side lost, it
// has again.
TEST_F(WindowFitsTest, ADockThatTookRoomFromTheOtherSideGivesItBack) {
  open({"rich.dsa"});
  window().resize(1024, 700);
  window().setAnimated(false);
  window().docks().reset();
  processAll();
  const auto* calibrate = find<QDockWidget>("Calibrate");
  const auto* library = find<QDockWidget>("Library");
  press(calibrate->toggleViewAction()->shortcut());
  processAll();
  const int before = calibrate->width();
  press(library->toggleViewAction()->shortcut());
  processAll();
  ASSERT_LT(calibrate->width(), before);
  press(library->toggleViewAction()->shortcut());
  processAll();
  ASSERT_TRUE(library->isHidden());
  EXPECT_EQ(calibrate->width(), before);
}

// Curves can be read whatever rows of events stand below them: those are scrolled.
TEST_P(TextSizeFitsTest, TheTimelineLeavesItsChartRoomBesideTheRowsOfEvents) {
  open({"rich.dsa"});
  window().setAnimated(false);
  window().resize(1280, 800);
  window().docks().reset();
  const auto& chart = *window().findChild<TimelineChart*>();
  auto& rows = *window().findChild<EventRows*>();
  std::vector<EventMark> marks;
  for (const EventLane lane : {EventLane::kGrasps, EventLane::kLabels, EventLane::kNotes}) {
    EventMark mark;
    mark.lane = lane;
    mark.fromS = 0.1;
    mark.toS = 0.2;
    marks.push_back(mark);
  }
  rows.setMarks(marks);
  processAll();
  window().resizeDocks({find<QDockWidget>("Timeline")}, {10}, Qt::Vertical);
  processAll();
  const int line = chart.fontMetrics().lineSpacing();
  EXPECT_GE(chart.height(), 5 * line);
  EXPECT_GE(chart.axisRect()->height(), 2 * line);
  EXPECT_FALSE(rows.visibleRegion().isEmpty());
  const auto& scroll = *find<QScrollArea>("eventRowsScroll");
  EXPECT_GE(scroll.height(), rows.heightOfOne());
  // The row of the chosen mark is brought into sight.
  rows.choose(2);
  EXPECT_TRUE(rows.visibleRegion().contains(rows.barOf(2).toRect().center()));
}

// The width before is that of the tab that was seen, not that of a tab behind it.
TEST_F(WindowFitsTest, AClosedDockLeavesTheColumnAsWideAsBefore) {
  open({"rich.dsa"});
  window().resize(1600, 900);
  window().setAnimated(false);
  window().docks().reset();
  processAll();
  window().docks().show("Link");
  processAll();
  auto* link = find<QDockWidget>("Link");
  window().resizeDocks({link}, {640}, Qt::Horizontal);
  processAll();
  const int before = link->width();
  ASSERT_GT(before, find<QDockWidget>("Inspect")->width()) << "which is behind";
  const QKeySequence key = find<QDockWidget>("Slip")->toggleViewAction()->shortcut();
  press(key);
  processAll();
  ASSERT_FALSE(find<QDockWidget>("Slip")->visibleRegion().isEmpty());
  press(key);
  processAll();
  ASSERT_TRUE(find<QDockWidget>("Slip")->isHidden());
  EXPECT_EQ(find<QDockWidget>("Link")->width(), before);
}

// All six matrices are named, and Inspect isn't scrolled sideways.
TEST_F(WindowFitsTest, TheLegendOfTheTimelineIsWhole) {
  open({"rich.dsa"});
  window().setAnimated(false);
  for (QAction* plot : window().findChildren<QAction*>())
    if (plot->text().startsWith("Plot finger") && !plot->isChecked()) plot->trigger();
  for (const QSize size : {QSize(1024, 700), kSizes[0], kSizes[1], kSizes[2]}) {
    window().resize(size);
    window().docks().reset();
    expectNoFaults(QString("legend at %1").arg(size.width()));
    const auto* legend = window().findChild<Legend*>();
    ASSERT_TRUE(legend->isVisible());
    ASSERT_EQ(legend->entries().size(), 6u);
    EXPECT_FALSE(legend->isCut()) << size.width();
    EXPECT_GE(legend->height(), legend->sizeHint().height()) << size.width();
  }
}

// The bar that scrolls its height has room beside its content.
TEST_F(WindowFitsTest, SlipOfALiveHandIsNotScrolledSideways) {
  connectEmulated();
  window().setAnimated(false);
  window().resize(1366, 768);
  window().docks().reset();
  auto* slip = find<QDockWidget>("Slip");
  press(slip->toggleViewAction()->shortcut());
  processAll();
  const auto* scroll = qobject_cast<QScrollArea*>(slip->widget());
  ASSERT_NE(scroll, nullptr);
  EXPECT_EQ(scroll->horizontalScrollBar()->maximum(), 0);
}

// The dock Hand takes the width that larger text needs, and gives it back.
TEST_F(WindowFitsTest, TheDockHandHasItsWidthAgainAfterLargerText) {
  connectEmulated();
  window().setAnimated(false);
  window().resize(1440, 900);
  window().docks().reset();
  processAll();
  auto* dock = find<QDockWidget>("Hand");
  const auto hints = [&] {
    std::map<std::string, int> widths;
    for (const QComboBox* box : dock->findChildren<QComboBox*>())
      widths[box->objectName().toStdString()] = box->minimumSizeHint().width();
    return widths;
  };
  const int before = dock->width();
  const auto hintsBefore = hints();
  applyTextPt(kMaxInterfaceTextPt);
  ASSERT_TRUE(QTest::qWaitFor([&] { return dock->width() > before; }));
  applyTextPt(0);
  EXPECT_TRUE(QTest::qWaitFor([&] { return dock->width() == before; }))
      << dock->width() << " instead of " << before << ", least " << dock->minimumSizeHint().width();
  EXPECT_EQ(hints(), hintsBefore);
}

// The style would draw it white in the dark theme.
TEST_F(WindowFitsTest, TabsOfDocksHaveNoLineBelowThem) {
  connectEmulated();
  window().docks().reset();
  for (const char* name : {"Inspect", "Link"}) window().docks().show(name);
  processAll();
  window().grab();
  int bars = 0;
  for (const QTabBar* bar :
       window().findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    if (!bar->isVisible() || bar->count() == 0) continue;
    ++bars;
    EXPECT_FALSE(bar->drawBase());
  }
  EXPECT_GT(bars, 0);
}

TEST_F(WindowFitsTest, TheLogShowsItsTimesInFull) {
  open({"rich.dsa"});
  window().resize(1366, 768);
  window().docks().show("Log");
  processAll();
  auto* table = find<QTableView>("logTable");
  ASSERT_GT(table->model()->rowCount(), 0);
  for (const int column : {0, 1})
    // Beside the text Qt leaves three pixels on both sides.
    EXPECT_GE(
        table->columnWidth(column),
        table->fontMetrics().horizontalAdvance(table->model()->index(0, column).data().toString()) +
            6);
}

TEST_F(WindowFitsTest, KeysOfTheWindowWorkWhileAFieldHasTheFocus) {
  open({"rich.dsa"});
  press(QKeySequence("Ctrl+Shift+L"));
  processAll();
  auto* search = find<QLineEdit>("librarySearch");
  ASSERT_TRUE(search->isVisible());
  auto* spectrum = find<QDockWidget>("Spectrum");
  ASSERT_TRUE(spectrum->isHidden());
  QTest::keyClick(search, Qt::Key_U, Qt::ControlModifier);
  EXPECT_FALSE(spectrum->isHidden());
}

TEST_F(WindowFitsTest, KeysOfGreyedActionsSayWhy) {
  open({"rich.dsa"});
  const auto said = [this](const char* keys) {
    const QKeyCombination key = QKeySequence(keys)[0];
    QTest::keyClick(&window(), key.key(), key.keyboardModifiers());
    return window().state().messages.flashed();
  };
  EXPECT_TRUE(said("Ctrl+S").contains("No recording with an unsaved label"));
  EXPECT_TRUE(said("Ctrl+2").startsWith("Grasp: with the controls of the hand: No hand"));
  EXPECT_TRUE(said("Ctrl+R").startsWith("Record: No hand is connected"));
}

}  // namespace
}  // namespace palpate::gui::window_fits_test
