// Every action of the window has its effect, by its key.
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QSpinBox>
#include <set>

#include <palpate/model/profile_builder.h>
#include <palpate/model/touch.h>

#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/help/help_feature.h"
#include "gui/help/keys_dialog.h"
#include "gui/matrices/matrices_view.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui::main_window_test {
namespace {

class MainWindowTest : public WindowTest {
 protected:
  MainWindowTest() { open({"good.dsa"}); }
  const MatricesLook& look() { return find<MatricesView>("matricesView")->look(); }
  const Status& status() { return find<StatusStrip>("statusStrip")->status(); }
  TimelineChart& timeline() { return *window().findChild<TimelineChart*>(); }
  void pass(std::int64_t ms) {
    clock_.advanceMs(ms);
    playback().tick();
  }
};

TEST_F(MainWindowTest, SpacePlaysAndPauses) {
  press(Qt::Key_Space);
  EXPECT_TRUE(playback().playing());
  EXPECT_EQ(status().lamp, Status::Lamp::kGood);
  EXPECT_TRUE(status().state.contains("playing 1×"));
  pass(100);
  EXPECT_EQ(playback().frame(), 2u);
  press(Qt::Key_Space);
  EXPECT_FALSE(playback().playing());
  EXPECT_TRUE(status().state.contains("paused"));
}

TEST_F(MainWindowTest, ArrowsStepAndWithShiftTen) {
  press(Qt::Key_Right);
  press(Qt::Key_Right);
  EXPECT_EQ(playback().frame(), 2u);
  press(Qt::Key_Left);
  EXPECT_EQ(playback().frame(), 1u);
  press(Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_EQ(playback().frame(), 11u);
  press(Qt::Key_Left, Qt::ShiftModifier);
  press(Qt::Key_Left);
  EXPECT_EQ(playback().frame(), 0u) << "frame 0 can be reached";
}

TEST_F(MainWindowTest, HomeAndEnd) {
  press(Qt::Key_End);
  EXPECT_EQ(playback().frame(), 19u);
  press(Qt::Key_Home);
  EXPECT_EQ(playback().frame(), 0u);
}

TEST_F(MainWindowTest, UpDownPlusMinusChangeTheSpeed) {
  press(Qt::Key_Up);
  EXPECT_EQ(playback().speed(), 2.0);
  press(Qt::Key_Plus);
  EXPECT_EQ(playback().speed(), 4.0);
  EXPECT_EQ(find<QComboBox>("speedBox")->currentText(), "4×");
  press(Qt::Key_Minus);
  press(Qt::Key_Down);
  press(Qt::Key_Down);
  EXPECT_EQ(playback().speed(), 0.5);
  EXPECT_EQ(find<QComboBox>("speedBox")->currentText(), "0.5×");
}

TEST_F(MainWindowTest, TheSpeedBoxAndItsMenuSetTheSpeed) {
  auto* box = find<QComboBox>("speedBox");
  ASSERT_EQ(box->count(), 8);
  emit box->activated(7);
  EXPECT_EQ(playback().speed(), 16.0);
  actions().group("speeds")->actions().at(0)->trigger();
  EXPECT_EQ(playback().speed(), 0.1);
  EXPECT_EQ(box->currentIndex(), 0);
}

TEST_F(MainWindowTest, LoopAndSkipGaps) {
  trigger("loop");
  EXPECT_TRUE(playback().loop());
  EXPECT_TRUE(actions().at("loop")->isChecked());
  trigger("skipGaps");
  EXPECT_TRUE(playback().skipGaps());
  trigger("loop");
  trigger("skipGaps");
  EXPECT_FALSE(playback().loop() || playback().skipGaps());
}

TEST_F(MainWindowTest, GoToFramePutsTheKeyboardIntoTheField) {
  press(Qt::Key_G, Qt::ControlModifier);
  auto* field = find<QSpinBox>("frameField");
  ASSERT_TRUE(field->hasFocus());
  QTest::keyClicks(field, "13");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(playback().frame(), 13u);
  EXPECT_FALSE(field->hasFocus()) << "the keys belong to the playback again";
}

TEST_F(MainWindowTest, LooksOfTheHeatMaps) {
  trigger("interpolated");
  EXPECT_TRUE(look().interpolated);
  trigger("values");
  EXPECT_TRUE(look().values);
  trigger("interpolated");
  trigger("values");
  EXPECT_FALSE(look().interpolated || look().values);
}

TEST_F(MainWindowTest, ColourMapsByBoxAndMenu) {
  auto* box = find<QComboBox>("mapBox");
  emit box->activated(4);
  EXPECT_EQ(look().map, ColorMapName::kCividis);
  EXPECT_TRUE(actions().group("maps")->actions().at(4)->isChecked());
  choose("maps", 6);
  EXPECT_EQ(look().map, ColorMapName::kGrey);
  EXPECT_EQ(box->currentText(), "grey");
}

TEST_F(MainWindowTest, RangesByBoxMenuAndFields) {
  // Frame i holds 10 * (i + 1) counts; 200 in the whole recording.
  press(Qt::Key_Right);
  EXPECT_EQ(look().range, (ValueRange{0, 200}));
  choose("ranges", 1);
  EXPECT_EQ(look().range, (ValueRange{0, 20})) << "this frame";
  press(Qt::Key_Right);
  EXPECT_EQ(look().range, (ValueRange{0, 30})) << "follows the frame";
  choose("ranges", 2);
  EXPECT_EQ(look().range, (ValueRange{0, 4095})) << "full scale";
  choose("ranges", 3);
  auto* low = find<QDoubleSpinBox>("rangeMinimum");
  auto* high = find<QDoubleSpinBox>("rangeMaximum");
  ASSERT_TRUE(low->isVisible());
  low->setValue(50);
  high->setValue(150);
  EXPECT_EQ(look().range, (ValueRange{50, 150}));
  low->setValue(400);
  EXPECT_EQ(look().range, (ValueRange{400, 401})) << "never empty";
  emit find<QComboBox>("rangeBox")->activated(0);
  EXPECT_EQ(look().range, (ValueRange{0, 200}));
  EXPECT_FALSE(low->isVisible());
  actions().group("ranges")->actions().at(2)->trigger();
  EXPECT_EQ(look().range, (ValueRange{0, 4095}));
}

TEST_F(MainWindowTest, SignalsByBoxAndMenu) {
  window().resize(1400, 1300);  // high enough for the whole label
  trigger("resetLayout");
  QCoreApplication::processEvents();
  choose("signalsPlotted", 1);
  EXPECT_EQ(window().state().appearance.view().signal, PlottedSignal::kFilteredMean);
  EXPECT_EQ(timeline().yAxis->label(), "filtered mean in counts");
  emit find<QComboBox>("signalBox")->activated(6);
  EXPECT_EQ(timeline().yAxis->label(), "active area in mm²");
  actions().group("signalsPlotted")->actions().at(5)->trigger();
  EXPECT_EQ(timeline().yAxis->label(), "active taxels");
  EXPECT_EQ(find<QComboBox>("signalBox")->currentText(), "active taxels");
  window().resize(900, 600);
  trigger("resetLayout");
  QCoreApplication::processEvents();
  EXPECT_EQ(timeline().yAxis->label(), "taxels") << "a low chart names the unit alone";
}

TEST_F(MainWindowTest, ZoomKeysChangeWhatIsSeen) {
  const double all = timeline().seen().size();
  press(Qt::Key_Plus, Qt::ControlModifier);
  EXPECT_LT(timeline().seen().size(), all);
  press(Qt::Key_Minus, Qt::ControlModifier);
  EXPECT_NEAR(timeline().seen().size(), all, 1e-9);
  press(Qt::Key_Equal, Qt::ControlModifier);
  press(Qt::Key_Equal, Qt::ControlModifier);
  press(Qt::Key_0, Qt::ControlModifier);
  EXPECT_NEAR(timeline().seen().size(), all, 1e-9);
}

TEST_F(MainWindowTest, TheMenuPlotsMatrices) {
  ASSERT_EQ(timeline().graphCount(), 1) << "only finger 0 distal ever felt anything";
  actions().all("plots")[0]->trigger();
  EXPECT_EQ(timeline().graphCount(), 2);
  actions().all("plots").last()->trigger();
  EXPECT_EQ(timeline().graphCount(), 3);
  actions().all("plots")[1]->trigger();
  EXPECT_EQ(timeline().graphCount(), 2);
  EXPECT_EQ(actions().all("plots")[1]->text(), "Plot finger 0 distal");
  EXPECT_FALSE(actions().all("plots")[1]->isChecked());
  EXPECT_FALSE(actions().all("plots")[6]->isVisible()) << "there is no seventh matrix";
}

TEST_F(MainWindowTest, ThemeTogglesAndCanBeChosen) {
  window().state().appearance.setTheme(ThemeChoice::kDark);
  press(Qt::Key_T, Qt::ControlModifier);
  EXPECT_EQ(window().state().appearance.view().theme, ThemeChoice::kLight);
  EXPECT_EQ(look().theme, Theme::kLight);
  EXPECT_GT(qApp->palette().color(QPalette::Window).lightness(), 200);
  press(Qt::Key_T, Qt::ControlModifier);
  EXPECT_EQ(look().theme, Theme::kDark);
  EXPECT_LT(qApp->palette().color(QPalette::Window).lightness(), 60);
  actions().group("themes")->actions().at(0)->trigger();
  EXPECT_EQ(window().state().appearance.view().theme, ThemeChoice::kSystem);
  EXPECT_EQ(look().theme, systemTheme());
}

TEST_F(MainWindowTest, FullScreenAndBack) {
  press(Qt::Key_F11);
  EXPECT_TRUE(window().isFullScreen());
  EXPECT_TRUE(actions().at("fullScreen")->isChecked());
  press(Qt::Key_Escape);
  EXPECT_FALSE(window().isFullScreen());
  EXPECT_FALSE(actions().at("fullScreen")->isChecked());
}

TEST_F(MainWindowTest, CopyPutsTheFrameOnTheClipboard) {
  QApplication::clipboard()->clear();
  playback().seekFrame(19);
  press(Qt::Key_C, Qt::ControlModifier);
  window().feature<ExportFeature>().exportController().settle();
  const QImage copied = QApplication::clipboard()->image();
  ASSERT_FALSE(copied.isNull());
  // The taxel of 200 counts, the recording's maximum, has the highest colour.
  const QRgb highest = colorTable(look().map)[255];
  int found = 0;
  for (int y = 0; y < copied.height(); ++y)
    for (int x = 0; x < copied.width(); ++x) found += copied.pixel(x, y) == highest ? 1 : 0;
  EXPECT_GT(found, 500);
  EXPECT_EQ(status().notice, "copied: Matrices as picture");
}

TEST_F(MainWindowTest, ExportWritesThePictureThatWasAskedFor) {
  QString suggested;
  window().feature<ExportFeature>().exportController().ask = [&](const ExportRequest& suggestion) {
    suggested = suggestion.name + endingOf(suggestion.form);
    ExportRequest request = suggestion;
    request.form = ExportFormat::kSvg;
    request.folder = QString::fromStdString(folder_.path().string());
    request.name = "frame";
    return request;
  };
  playback().seekFrame(7);
  QSignalSpy written(&window().feature<ExportFeature>().exportController(),
                     &ExportController::written);
  press(Qt::Key_E, Qt::ControlModifier);
  ASSERT_TRUE(written.size() == 1 || written.wait(10'000));
  EXPECT_EQ(suggested, "good_frame_00007.png");
  const std::string text = testing::readFile(folder_ / "frame.svg");
  EXPECT_NE(text.find("good.dsa"), std::string::npos);
  EXPECT_NE(text.find("frame 7"), std::string::npos);
  EXPECT_TRUE(status().notice.startsWith("written: "));
}

TEST_F(MainWindowTest, ExportThatFailsSaysWhy) {
  window().feature<ExportFeature>().exportController().ask = [&](const ExportRequest& suggestion) {
    ExportRequest request = suggestion;
    request.folder = QString::fromStdString((folder_ / "no" / "such").string());
    return request;
  };
  press(Qt::Key_E, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bannerText().isEmpty(); }, 10'000));
  EXPECT_TRUE(bannerText().contains("no/such"));
}

TEST_F(MainWindowTest, ExportCancelledDoesNothing) {
  window().feature<ExportFeature>().exportController().ask = [](const ExportRequest&) {
    return std::nullopt;
  };
  press(Qt::Key_E, Qt::ControlModifier);
  window().feature<ExportFeature>().exportController().settle();
  EXPECT_EQ(bannerText(), "");
}

TEST_F(MainWindowTest, KeysAndAboutOpen) {
  press(Qt::Key_F1);
  EXPECT_NE(window().findChild<KeysDialog*>(), nullptr);
  actions().at("about")->trigger();
  EXPECT_NE(window().findChild<AboutDialog*>(), nullptr);
  for (const char* part : {"General Public License", "version 3", "Qt 6", "QCustomPlot"})
    EXPECT_TRUE(AboutDialog::text().contains(part)) << part;
}

TEST_F(MainWindowTest, DocksHideAndShow) {
  auto* inspect = window().findChild<QDockWidget*>("Inspect");
  auto* timelineDock = window().findChild<QDockWidget*>("Timeline");
  ASSERT_TRUE(!inspect->isVisible() && timelineDock->isVisible());
  press(Qt::Key_I, Qt::ControlModifier);
  EXPECT_TRUE(inspect->isVisible());
  press(Qt::Key_L, Qt::ControlModifier);
  EXPECT_FALSE(timelineDock->isVisible());
  press(Qt::Key_I, Qt::ControlModifier);
  press(Qt::Key_L, Qt::ControlModifier);
  EXPECT_TRUE(!inspect->isVisible() && timelineDock->isVisible());
}

TEST_F(MainWindowTest, QuitCloses) {
  press(Qt::Key_Q, Qt::ControlModifier);
  EXPECT_FALSE(window().isVisible());
}

TEST_F(MainWindowTest, StatusNamesFrameTimeAndFigures) {
  playback().seekFrame(7);
  EXPECT_EQ(status().right, "frame 7, last 19   0.35 s");
  EXPECT_EQ(status().figures, (QStringList{"active 1", "max 80", "saturated 0"}));
}

TEST_F(MainWindowTest, StatusNamesTheBaselineOfReadings) {
  MatrixLayout matrix = MatrixLayout::full(1, 2, 2.0);
  matrix.touch = {.isSigned = true};
  const auto padWith = [&](const std::vector<Event>& events) {
    ProfileBuilder builder(std::make_shared<const SensorLayout>(std::vector{matrix}));
    const std::vector<float> readings = {30, -40};
    builder.addReadings(1'000'000, readings);
    Recording pad{.profile = builder.finish({})};
    pad.events = events;
    return makeOpenedRecording("pad", std::move(pad));
  };
  window().state().displayed.show(padWith({}));
  EXPECT_EQ(status().figures.last(), "no baseline");
  const Baseline rest{{10.0F, 10.0F}, {1.0F, 1.0F}};
  window().state().displayed.show(padWith({baselineEvent(rest, 1'000'000)}));
  EXPECT_EQ(status().figures.last(), "baseline of the recording");
}

// O-A19: the cursor can stand between two frames.
TEST_F(MainWindowTest, StatusTellsTheTimeOfTheFrameAndOfTheCursor) {
  playback().seekSeconds(0.38);
  EXPECT_EQ(status().right, "frame 7, last 19   0.35 s, cursor 0.38 s");
  playback().seekFrame(19);
  EXPECT_EQ(status().right, "frame 19, last 19   0.95 s");
}

TEST_F(MainWindowTest, AGapIsSaidInTheStatus) {
  open({"gap.dsa"});
  EXPECT_EQ(status().notice, "1 gap");
  playback().seekSeconds(5.0);
  EXPECT_TRUE(status().notice.contains("nothing was recorded"));
  EXPECT_EQ(status().lamp, Status::Lamp::kWarning);
}

// Of two with the same key (the space bar plays, or marks the moment) one at most can be asked for.
TEST_F(MainWindowTest, NoKeyMeansTwoThingsAtOnce) {
  const auto check = [&](const char* where) {
    std::set<QString> seen;
    for (const QAction* action : window().actions())
      for (const QKeySequence& key :
           action->isEnabled() ? action->shortcuts() : QList<QKeySequence>())
        EXPECT_TRUE(seen.insert(key.toString()).second) << key.toString().toStdString() << where;
    EXPECT_GT(seen.size(), 20u);
  };
  check(" on the start page");
  open({"good.dsa"});
  check(" with a recording");
}

TEST_F(MainWindowTest, EveryActionOfTheToolbarHasIconAndToolTip) {
  for (const QAction* action : {actions().at("open"),
                                actions().at("exportPicture"),
                                actions().at("toStart"),
                                actions().at("stepBack"),
                                actions().at("play"),
                                actions().at("stepForward"),
                                actions().at("loop"),
                                actions().at("skipGaps"),
                                actions().at("keys")}) {
    EXPECT_FALSE(action->icon().isNull()) << action->text().toStdString();
    EXPECT_EQ(action->toolTip().contains('('), !action->shortcuts().isEmpty())
        << action->text().toStdString();
  }
}

// Titles of the entries of `menu` and of its submenus whose access key another entry has as well.
QStringList sharedAccessKeys(const QList<QAction*>& entries, const QString& menu) {
  QStringList shared;
  QHash<QKeySequence, QString> taken;
  for (const QAction* entry : entries) {
    if (entry->menu())
      shared += sharedAccessKeys(entry->menu()->actions(), menu + " > " + entry->text());
    const QKeySequence accessKey = QKeySequence::mnemonic(entry->text());
    if (accessKey.isEmpty()) continue;
    if (taken.contains(accessKey))
      shared.append(menu + ": " + taken[accessKey] + ", " + entry->text());
    taken[accessKey] = entry->text();
  }
  return shared;
}

// No single letter moves the hand, also where a menu has the keyboard.
TEST_F(MainWindowTest, MotionsOfTheHandHaveNoAccessKey) {
  const QList<QAction*>& motions = window().state().handCommands.motions;
  EXPECT_GE(motions.size(), 5);
  for (const QAction* motion : motions)
    EXPECT_TRUE(QKeySequence::mnemonic(motion->text()).isEmpty()) << motion->text().toStdString();
}

// Letters typed after an entry was chosen by keys don't choose further ones.
TEST_F(MainWindowTest, AfterAnEntryOfAMenuTheKeyboardBelongsToTheWindow) {
  QMenuBar* menus = window().menuBar();
  menus->setFocus(Qt::MenuBarFocusReason);
  ASSERT_TRUE(menus->hasFocus());
  emit menus->triggered(actions().at("values"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !menus->hasFocus(); }));
}

TEST_F(MainWindowTest, NoTwoEntriesOfAMenuShareAnAccessKey) {
  const QStringList shared = sharedAccessKeys(window().menuBar()->actions(), "menu bar");
  EXPECT_TRUE(shared.isEmpty()) << shared.join("\n").toStdString();
}

}  // namespace
}  // namespace palpate::gui::main_window_test
