// Ways to open a recording, and what happens when it can't be opened.
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QMouseEvent>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QStackedWidget>
#include <QToolButton>
#include <fstream>
#include <set>
#include <utility>

#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_panel.h"
#include "gui/library/library_feature.h"
#include "gui/library/library_panel.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/open/start_page.h"
#include "gui/open/thumbnails.h"
#include "gui/record/plan_controller.h"
#include "gui/record/plan_dialog.h"
#include "gui/testing/window_fixture.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/opening_strip.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui::opening_test {
namespace {

class OpeningTest : public WindowTest {
 protected:
  std::string currentName() {
    return window().state().displayed.unfilteredRecording()
               ? window().state().displayed.unfilteredRecording()->path.filename().string()
               : "";
  }
  bool onStartPage() { return window().findChild<StartPage*>()->isVisible(); }
  QMenu* recentMenu() {
    for (QMenu* menu : window().findChildren<QMenu*>())
      if (menu->title().contains("recent")) return menu;
    return nullptr;
  }
  // Drags and drops files onto the window; true when it takes them.
  bool drop(const QList<QUrl>& urls) {
    QMimeData data;
    data.setUrls(urls);
    QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &enter);
    if (!enter.isAccepted()) return false;
    QDropEvent event(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &event);
    return true;
  }
  QUrl url(const std::string& name) {
    return QUrl::fromLocalFile(QString::fromStdString(file(name)));
  }
};

TEST_F(OpeningTest, StartsOnTheStartPageWithoutDocks) {
  EXPECT_TRUE(onStartPage());
  for (const QString& name : window().docks().names())
    EXPECT_FALSE(window().findChild<QDockWidget*>(name)->isVisible());
  EXPECT_FALSE(actions().at("play")->isEnabled());
  EXPECT_EQ(find<StatusStrip>("statusStrip")->status().state, "nothing open");
}

TEST_F(OpeningTest, ShowsTheRecordingAtItsFirstFrame) {
  open({"good.dsa"});
  EXPECT_FALSE(onStartPage());
  EXPECT_EQ(currentName(), "good.dsa");
  EXPECT_EQ(playback().frame(), 0u);
  EXPECT_FALSE(playback().playing());
  EXPECT_TRUE(actions().at("play")->isEnabled());
  EXPECT_EQ(window().windowTitle(), "good.dsa – Palpate");
}

TEST_F(OpeningTest, ByTheDialog) {
  const std::string path = file("good.dsa");
  ask_.files = {QString::fromStdString(path)};
  press(Qt::Key_O, Qt::ControlModifier);
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good.dsa");
  ask_.files = {QString()};
  press(Qt::Key_O, Qt::ControlModifier);
  EXPECT_EQ(currentName(), "good.dsa") << "cancelled";
}

TEST_F(OpeningTest, ByTheButtonOfTheStartPage) {
  const std::string path = file("good.dsa");
  ask_.files = {QString::fromStdString(path)};
  QTest::mouseClick(find<QPushButton>("startOpen"), Qt::LeftButton);
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good.dsa");
}

TEST_F(OpeningTest, ByDragAndDrop) {
  EXPECT_TRUE(drop({url("good.dsa")}));
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good.dsa");
  EXPECT_TRUE(drop({url("good2.dsa"), url("good3.dsa")}));
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good2.dsa");
  EXPECT_EQ(window().state().recordings.all().size(), 3u);
}

TEST_F(OpeningTest, AFolderOpensTheLibraryOnIt) {
  std::filesystem::create_directories(folder_ / "runs");
  const QString folder = QString::fromStdString((folder_ / "runs").string());
  EXPECT_TRUE(drop({QUrl::fromLocalFile(folder)}));
  LibraryPanel& library = window().feature<LibraryFeature>().panel();
  EXPECT_EQ(library.folder(), folder);
  EXPECT_TRUE(library.isVisible());
  EXPECT_EQ(bannerText(), "");
  EXPECT_TRUE(onStartPage());
  // Beside files of the same call.
  EXPECT_TRUE(drop({QUrl::fromLocalFile(folder), url("good.dsa")}));
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good.dsa");
}

TEST_F(OpeningTest, TheStartPageOffersTheLastConnection) {
  const auto* again = find<QPushButton>("startAgain");
  EXPECT_FALSE(again->isVisible()) << "there was none";
  window().close();
  QSettings settings(settingsFile(), QSettings::IniFormat);
  Connection connection;
  connection.kind = Connection::Kind::kPorts;
  connection.dsaPort = "/dev/ttyUSB0";
  connection.sdhPort = "/dev/ttyUSB1";
  saveConnection(connection, settings);
  settings.sync();
  start();
  again = find<QPushButton>("startAgain");
  EXPECT_TRUE(again->isVisible());
  EXPECT_EQ(again->text(), "Connect again: hand on ttyUSB0 and ttyUSB1, today");
}

TEST_F(OpeningTest, TheStartPageShowsTheLibrary) {
  LibraryPanel& library = window().feature<LibraryFeature>().panel();
  ASSERT_FALSE(library.isVisible());
  QTest::mouseClick(find<QPushButton>("startLibrary"), Qt::LeftButton);
  EXPECT_TRUE(library.isVisible());
}

TEST_F(OpeningTest, WhatIsNoLocalFileIsNotTaken) {
  EXPECT_FALSE(drop({QUrl("https://example.org/a.dsa")}));
  EXPECT_FALSE(drop({}));
}

TEST_F(OpeningTest, OfSeveralTheFirstIsShownAndTheOthersAreReached) {
  open({"good1.dsa", "good2.dsa", "good3.dsa"});
  EXPECT_EQ(currentName(), "good1.dsa");
  auto* box = find<QComboBox>("recordingsBox");
  ASSERT_EQ(box->count(), 3);
  EXPECT_EQ(box->itemText(1), "good2.dsa · 2014-05-13");
  playback().seekFrame(5);
  press(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_EQ(currentName(), "good2.dsa");
  EXPECT_EQ(playback().frame(), 0u);
  press(Qt::Key_Tab, Qt::ControlModifier);
  press(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_EQ(currentName(), "good1.dsa") << "around";
  EXPECT_EQ(playback().frame(), 5u) << "where it was left";
  // Shift+Tab arrives as Backtab from a keyboard.
  actions().at("previousRecording")->trigger();
  EXPECT_EQ(currentName(), "good3.dsa");
  emit box->activated(1);
  EXPECT_EQ(currentName(), "good2.dsa");
}

TEST_F(OpeningTest, CloseGoesToTheNextAndAtLastToTheStartPage) {
  open({"good1.dsa", "good2.dsa"});
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(currentName(), "good2.dsa");
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_TRUE(onStartPage());
  EXPECT_FALSE(actions().at("play")->isEnabled());
  EXPECT_EQ(window().windowTitle(), "Palpate");
  open({"good1.dsa"});
  EXPECT_EQ(currentName(), "good1.dsa");
}

TEST_F(OpeningTest, TheSameFileAgainIsReadAgainButListedOnce) {
  open({"good.dsa"});
  playback().seekFrame(7);
  open({"good.dsa"});
  EXPECT_EQ(reads_, 2);
  EXPECT_EQ(window().state().recordings.all().size(), 1u);
  EXPECT_EQ(playback().frame(), 0u);
}

// By a symbolic link, a hard link, and a path with a detour.
TEST_F(OpeningTest, AFileThatIsOpenByAnotherPathIsShownAndListedOnce) {
  namespace fs = std::filesystem;
  const fs::path file = this->file("good.dsa");
  fs::create_directories(folder_ / "runs");
  fs::create_symlink(file, folder_ / "good_link.dsa");
  fs::create_hard_link(file, folder_ / "good_hard.dsa");
  open({"good.dsa"});
  playback().seekFrame(7);
  for (const char* other : {"good_link.dsa", "good_hard.dsa", "runs/../good.dsa"}) {
    open({"good2.dsa"});
    const int reads = reads_;
    window().state().open({folder_ / other});
    waitUntilOpened();
    EXPECT_EQ(currentName(), "good.dsa") << other;
    EXPECT_EQ(window().state().recordings.all().size(), 2u) << other;
    EXPECT_EQ(playback().frame(), 7u) << "as it was left";
    EXPECT_EQ(reads_, reads) << other;
    const std::string name = fs::path(other).filename();
    EXPECT_EQ(window().state().messages.flashed().toStdString(),
              name + " is open already" + (name == "good.dsa" ? "" : " as good.dsa"));
  }
  // Both paths in one request.
  start();
  window().state().open({folder_ / "good_link.dsa", file});
  waitUntilOpened();
  EXPECT_EQ(window().state().recordings.all().size(), 1u);
  EXPECT_EQ(window().state().recordings.at(file), window().state().recordings.all()[0]);
}

TEST_F(OpeningTest, AFailureIsSaidAndLosesNothing) {
  open({"good.dsa"});
  playback().seekFrame(7);
  open({"bad.dsa"});
  EXPECT_EQ(bannerText().toStdString(),
            file("bad.dsa") + ": is not a recording: <b>no frames</b> (at byte 17)");
  EXPECT_EQ(currentName(), "good.dsa");
  EXPECT_EQ(playback().frame(), 7u);
  press(Qt::Key_Escape);
  EXPECT_EQ(bannerText(), "");
}

TEST_F(OpeningTest, TheBannerClosesByItsButtonAndByTheNextOpening) {
  open({"bad.dsa"});
  EXPECT_TRUE(onStartPage());
  QTest::mouseClick(find<QToolButton>("bannerClose"), Qt::LeftButton);
  EXPECT_EQ(bannerText(), "");
  open({"bad.dsa"});
  open({"good.dsa"});
  EXPECT_EQ(bannerText(), "");
}

TEST_F(OpeningTest, AmongSeveralTheBadOnesAreNamedAndTheFirstGoodIsShown) {
  open({"bad1.dsa", "good.dsa", "bad2.dsa"});
  EXPECT_EQ(currentName(), "good.dsa");
  EXPECT_TRUE(bannerText().contains("bad1.dsa"));
  EXPECT_TRUE(bannerText().contains("bad2.dsa"));
}

TEST_F(OpeningTest, CancelLeavesWhatIsOpen) {
  open({"good.dsa"});
  window().state().open({file("slow.dsa"), file("good2.dsa")});
  const QWidget* strip = find<QPushButton>("cancelOpening")->parentWidget();
  ASSERT_TRUE(QTest::qWaitFor([&] { return strip->isVisible(); }, 10'000));
  QTest::mouseClick(find<QPushButton>("cancelOpening"), Qt::LeftButton);
  waitUntilOpened();
  EXPECT_FALSE(strip->isVisible());
  EXPECT_EQ(currentName(), "good.dsa");
  EXPECT_EQ(window().state().recordings.all().size(), 1u);
  EXPECT_EQ(bannerText(), "");
  EXPECT_TRUE(find<StatusStrip>("statusStrip")->status().notice.contains("cancelled"));
}

TEST_F(OpeningTest, EscapeCancelsToo) {
  window().state().open({file("slow.dsa")});
  press(Qt::Key_Escape);
  waitUntilOpened();
  EXPECT_TRUE(onStartPage());
}

TEST_F(OpeningTest, TheWindowClosesWhileItOpens) {
  window().state().open({file("slow.dsa")});
  window().close();
  start();
  EXPECT_TRUE(onStartPage());
}

TEST_F(OpeningTest, AnEmptyRecordingIsSaidToBeEmpty) {
  open({"empty.dsa"});
  EXPECT_TRUE(bannerText().contains("no frame"));
  EXPECT_FALSE(actions().at("play")->isEnabled());
  press(Qt::Key_Space);
  press(Qt::Key_Right);
  press(Qt::Key_E, Qt::ControlModifier);
  EXPECT_FALSE(playback().playing());
}

TEST_F(OpeningTest, RecentFilesAreListedAndOpened) {
  open({"good1.dsa"});
  open({"good2.dsa"});
  open({"bad.dsa"});
  emit recentMenu()->aboutToShow();
  auto entries = recentMenu()->actions();
  EXPECT_EQ(entries[0]->text(), "good2.dsa") << "newest first, failures not at all";
  EXPECT_EQ(entries[1]->text(), "good1.dsa");
  EXPECT_EQ(entries[1]->toolTip().toStdString(), file("good1.dsa"));
  entries[1]->trigger();
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good1.dsa");
}

TEST_F(OpeningTest, MissingRecentFilesAreMarkedAndCanBeForgotten) {
  open({"good1.dsa", "good2.dsa"});
  std::filesystem::remove(folder_ / "good1.dsa");
  emit recentMenu()->aboutToShow();
  window().state().recent.settle();
  emit recentMenu()->aboutToShow();
  const auto entryOf = [&](const QString& start) -> QAction* {
    for (QAction* entry : recentMenu()->actions())
      if (entry->text().startsWith(start)) return entry;
    return nullptr;
  };
  ASSERT_NE(entryOf("good1.dsa"), nullptr);
  EXPECT_EQ(entryOf("good1.dsa")->text(), "good1.dsa (missing)");
  EXPECT_FALSE(entryOf("good1.dsa")->isEnabled());
  entryOf("Forget missing")->trigger();
  emit recentMenu()->aboutToShow();
  EXPECT_EQ(entryOf("good1.dsa"), nullptr);
  EXPECT_NE(entryOf("good2.dsa"), nullptr);
  entryOf("Forget all")->trigger();
  emit recentMenu()->aboutToShow();
  EXPECT_NE(entryOf("good2.dsa"), nullptr) << "cancelled";
  ask_.choices = {"Forget all"};
  entryOf("Forget all")->trigger();
  emit recentMenu()->aboutToShow();
  EXPECT_EQ(entryOf("good2.dsa"), nullptr);
}

TEST_F(OpeningTest, TheStartPageListsRecentFilesAfterARestart) {
  open({"good1.dsa", "good2.dsa"});
  std::filesystem::remove(folder_ / "good1.dsa");
  window().close();
  start();
  window().state().recent.settle();
  auto rows = window().findChildren<QPushButton*>("RecentRow");
  ASSERT_EQ(rows.size(), 2);
  EXPECT_EQ(rows[0]->accessibleName().toStdString(), file("good2.dsa"));
  EXPECT_TRUE(rows[0]->isEnabled());
  EXPECT_FALSE(rows[1]->isEnabled()) << "missing";
  QTest::mouseClick(window().findChildren<QToolButton*>("removeRecent").at(1), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().findChildren<QPushButton*>("RecentRow").size() == 1; }, 10'000));
  QTest::mouseClick(window().findChildren<QPushButton*>("RecentRow").at(0), Qt::LeftButton);
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good2.dsa");
}

TEST_F(OpeningTest, TheStartPageHasAPictureOfEachRecentRecording) {
  const std::filesystem::path kept = folder_ / "cache" / "thumbnails";
  const auto pictures = [&] {
    std::vector<std::filesystem::path> found;
    if (std::filesystem::exists(kept))
      for (const auto& each : std::filesystem::directory_iterator(kept)) found.push_back(each);
    return found;
  };
  open({"good1.dsa", "good2.dsa"});
  ASSERT_TRUE(QTest::qWaitFor([&] { return pictures().size() == 2; }, 10'000));
  window().close();
  // What is no picture is not shown.
  std::ofstream(pictures().front()) << "no picture";
  start();
  int shown = 0;
  for (const QPushButton* row : window().findChildren<QPushButton*>("RecentRow"))
    for (const QLabel* label : row->findChildren<QLabel*>()) {
      if (label->pixmap().isNull()) continue;
      ++shown;
      const QImage image = label->pixmap().toImage();
      EXPECT_EQ(image.size(), kThumbnailSize * window().devicePixelRatio());
      std::set<QRgb> colors;
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) colors.insert(image.pixel(x, y));
      EXPECT_GT(colors.size(), 3U) << "ground, taxels at rest, and those that are pressed";
    }
  EXPECT_EQ(shown, 1);
  window().state().recent.clear();
  EXPECT_TRUE(pictures().empty()) << "nothing is kept of a recording that is forgotten";
}

TEST_F(OpeningTest, TheStartPageTellsWhatThePlanHasLeft) {
  EXPECT_FALSE(find<QPushButton>("startPlan")->isVisible());
  window().close();
  {
    QSettings settings(settingsFile(), QSettings::IniFormat);
    PlanController plan(settings);
    plan.addRow({.object = "ball", .run = "left", .repetitions = 3});
  }
  start();
  const auto* button = find<QPushButton>("startPlan");
  EXPECT_TRUE(button->isVisible());
  EXPECT_EQ(button->text(), "Plan of recordings: 0 of 3 takes · next: ball, left, 1 of 3");
  QTest::mouseClick(find<QPushButton>("startPlan"), Qt::LeftButton);
  EXPECT_TRUE(window().findChild<PlanDialog*>()->isVisible());
}

TEST_F(OpeningTest, TenRecentFilesFitIntoTheSmallestWindow) {
  for (int i = 0; i < 12; ++i) open({"good" + std::to_string(i) + ".dsa"});
  window().close();
  start();
  window().resize(900, 600);
  QCoreApplication::processEvents();
  EXPECT_EQ(window().size(), QSize(900, 600));
  EXPECT_EQ(window().findChildren<QPushButton*>("RecentRow").size(), 10);
  auto* scroll = window().findChild<StartPage*>()->findChild<QScrollArea*>();
  EXPECT_GT(scroll->verticalScrollBar()->maximum(), 0);
}

TEST_F(OpeningTest, WhatIsAskedForWhileOthersOpenIsShownWhenItComes) {
  QStringList shown;
  QObject::connect(&window().state().displayed, &DisplayedSource::shown, &window(), [&] {
    shown.append(QString::fromStdString(currentName()));
  });
  bool asked = false;
  QObject::connect(&window().state().opener, &RecordingOpener::opened, &window(), [&] {
    if (!std::exchange(asked, true)) window().state().open({file("good3.dsa")});
  });
  open({"good1.dsa", "good2.dsa"});
  EXPECT_EQ(shown, QStringList({"good1.dsa", "good3.dsa"}));
  EXPECT_EQ(window().state().recordings.all().size(), 3u);
}

TEST_F(OpeningTest, WhatIsAskedForIsShownWhateverIsComparedMeanwhile) {
  open({"good1.dsa"});
  window().state().open({file("good2.dsa")});
  emit window().feature<LibraryFeature>().panel().compareRequested(
      QString::fromStdString(file("good3.dsa")));
  waitUntilOpened();
  EXPECT_EQ(currentName(), "good2.dsa");
  EXPECT_TRUE(window().state().comparison.on());
  ASSERT_NE(window().feature<CompareFeature>().panel().b(), nullptr);
  EXPECT_EQ(window().feature<CompareFeature>().panel().b()->path.filename(), "good3.dsa");
}

// The mouse rests on a taxel: what it says of it is asked for while recordings change.
TEST_F(OpeningTest, AShorterRecordingIsShownUnderTheMouse) {
  open({"good1.dsa", "gap2.dsa"});
  playback().seekFrame(19);
  MatricesView& view = window().feature<MatricesFeature>().panel().view();
  const QPointF at = view.geometryOfMatrices().taxelRect(1, 7, 2).center();
  QMouseEvent move(
      QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &move);
  ASSERT_FALSE(view.hoverText().isEmpty());
  press(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_EQ(currentName(), "gap2.dsa");
  EXPECT_EQ(playback().numFrames(), 10u);
  EXPECT_EQ(playback().frame(), 0u);
}

TEST_F(OpeningTest, TheDemoIsOfferedOnlyWhereItsFileIs) {
  EXPECT_EQ(find<QPushButton>("startDemo"), nullptr);
  EXPECT_FALSE(actions().at("openDemo")->isVisible());
}

// With the real reader and the recording that comes with the program.
TEST(Demo, PlaysInALoopThatIsNotRemembered) {
  const testing::TemporaryFolder folder;
  const QString ini = QString::fromStdString((folder / "a.ini").string());
  {
    MainWindow window({.dataFolder = testing::dataFolder(), .settingsPath = ini});
    window.show();
    QSignalSpy finished(&window.state().opener, &RecordingOpener::finished);
    QTest::mouseClick(window.findChild<QPushButton*>("startDemo"), Qt::LeftButton);
    ASSERT_TRUE(finished.wait(30'000));
    ASSERT_NE(window.state().displayed.unfilteredRecording(), nullptr);
    EXPECT_TRUE(window.state().playback.playing());
    EXPECT_TRUE(window.state().playback.loop());
    window.close();
  }
  MainWindow again({.dataFolder = testing::dataFolder(), .settingsPath = ini});
  EXPECT_FALSE(again.state().playback.loop());
}

TEST(Demo, PlaysWhateverElseIsOpenedMeanwhile) {
  const testing::TemporaryFolder folder;
  MainWindow window({.dataFolder = testing::dataFolder(),
                     .settingsPath = QString::fromStdString((folder / "a.ini").string())});
  window.show();
  QSignalSpy finished(&window.state().opener, &RecordingOpener::finished);
  window.state().actions.at("openDemo")->trigger();
  window.state().open({folder / "nothing.dsa"});
  ASSERT_TRUE(finished.wait(30'000));
  ASSERT_NE(window.state().displayed.unfilteredRecording(), nullptr);
  EXPECT_TRUE(window.state().playback.playing());
  EXPECT_TRUE(window.state().playback.loop());
}

TEST(RealRecording, OpensAndShowsTheFrameOfTheSketch) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const testing::TemporaryFolder folder;
  MainWindow window({.dataFolder = folder.path(),
                     .settingsPath = QString::fromStdString((folder / "a.ini").string())});
  window.show();
  QSignalSpy finished(&window.state().opener, &RecordingOpener::finished);
  window.state().open({*recordings / "grasps/foam_ball.dsa"});
  ASSERT_TRUE(finished.wait(60'000));
  window.state().playback.seekFrame(2411);
  // window.png: 36 active taxels of mean 500 and maximum 1013 in finger 0 distal; 24, 184, 338 in
  // finger 2 distal.
  const OpenedRecording& recording = *window.state().displayed.unfilteredRecording();
  EXPECT_EQ(recording.profile.numFrames(), 3289u);
  EXPECT_EQ(recording.at(2411, 1).active, 36);
  EXPECT_NEAR(recording.at(2411, 1).mean, 500, 0.5);
  EXPECT_EQ(recording.at(2411, 1).maximum, 1013);
  EXPECT_EQ(recording.at(2411, 5).active, 24);
  EXPECT_NEAR(recording.at(2411, 5).mean, 184, 0.5);
  EXPECT_EQ(recording.at(2411, 5).maximum, 338);
  EXPECT_NEAR(window.state().playback.positionS(), 76.15, 0.005);
  EXPECT_NEAR(window.state().playback.durationS(), 103.8, 0.05);
}

}  // namespace
}  // namespace palpate::gui::opening_test
