// What the window remembers, and how it is put back.
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QSplitter>
#include <QToolButton>
#include <cstdlib>

#include "gui/appearance/settings_file.h"
#include "gui/inspect/matrix_table.h"
#include "gui/matrices/matrices_view.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::window_layout_test {
namespace {

class WindowLayoutTest : public WindowTest {
 protected:
  QDockWidget* dock(const char* name) { return window().findChild<QDockWidget*>(name); }
};

TEST_F(WindowLayoutTest, LookSpeedAndLoopAreRemembered) {
  open({"good.dsa"});
  window().state().appearance.setTheme(ThemeChoice::kLight);
  for (const char* group : {"maps", "ranges", "signalsPlotted"}) choose(group, 1);
  for (const char* action : {"values", "interpolated", "loop", "skipGaps", "faster"})
    trigger(action);
  window().close();
  start();
  const ViewSettings& view = window().state().appearance.view();
  EXPECT_EQ(view.theme, ThemeChoice::kLight);
  EXPECT_EQ(view.map, ColorMapName::kViridis);
  EXPECT_EQ(view.range, RangeMode::kFrame);
  EXPECT_TRUE(view.values && view.interpolated);
  EXPECT_EQ(view.signal, PlottedSignal::kFilteredMean);
  EXPECT_EQ(playback().speed(), 2.0);
  EXPECT_TRUE(playback().loop() && playback().skipGaps());
  EXPECT_TRUE(actions().at("loop")->isChecked() && actions().at("values")->isChecked());
  open({"good.dsa"});
  const MatricesLook& look = find<MatricesView>("matricesView")->look();
  EXPECT_EQ(look.map, ColorMapName::kViridis);
  EXPECT_EQ(look.theme, Theme::kLight);
}

TEST_F(WindowLayoutTest, SizeIsRemembered) {
  window().resize(1111, 777);
  QCoreApplication::processEvents();
  const QSize size = window().size();
  window().close();
  start();
  EXPECT_EQ(window().size(), size);
}

TEST_F(WindowLayoutTest, ShownAndMovedDocksAreRemembered) {
  open({"good.dsa"});
  press(Qt::Key_I, Qt::ControlModifier);
  window().addDockWidget(Qt::TopDockWidgetArea, dock("Timeline"));
  QCoreApplication::processEvents();
  window().close();
  start();
  open({"good.dsa"});
  EXPECT_TRUE(dock("Inspect")->isVisible());
  EXPECT_TRUE(dock("Timeline")->isVisible());
  EXPECT_EQ(window().dockWidgetArea(dock("Timeline")), Qt::TopDockWidgetArea);
}

TEST_F(WindowLayoutTest, SizesOfTheViewsAreRememberedAlsoWhenOneIsHidden) {
  open({"good.dsa"});
  actions().at("matricesShown")->setChecked(true);
  auto* views = find<QSplitter>("views");
  actions().at("handShown")->trigger();
  QCoreApplication::processEvents();
  if (views->sizes().contains(0)) actions().at("handShown")->trigger();
  QCoreApplication::processEvents();
  ASSERT_FALSE(views->sizes().contains(0));
  // As with the mouse.
  QSplitterHandle* handle = views->handle(1);
  QTest::mousePress(handle, Qt::LeftButton, {}, handle->rect().center());
  QTest::mouseMove(handle, handle->rect().center() + QPoint(80, 0));
  QTest::mouseRelease(handle, Qt::LeftButton, {}, handle->rect().center() + QPoint(80, 0));
  QCoreApplication::processEvents();
  const QList<int> chosen = views->sizes();
  ASSERT_GT(std::abs(chosen[0] - chosen[1]), 60);
  actions().at("handShown")->trigger();
  QCoreApplication::processEvents();
  ASSERT_TRUE(views->sizes().contains(0));
  window().close();
  const QSettings kept(settingsFile(), QSettings::IniFormat);
  EXPECT_EQ(storedNumbers(kept, "window/views", 2, 1, 100'000), chosen);
}

TEST_F(WindowLayoutTest, TheStartPageBetweenDoesNotLoseTheLayout) {
  open({"good.dsa"});
  press(Qt::Key_I, Qt::ControlModifier);
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_FALSE(dock("Timeline")->isVisible());
  window().close();  // from the start page
  start();
  open({"good.dsa"});
  EXPECT_TRUE(dock("Inspect")->isVisible());
  EXPECT_TRUE(dock("Timeline")->isVisible());
}

TEST_F(WindowLayoutTest, ResetPutsEverythingBack) {
  open({"good.dsa"});
  press(Qt::Key_I, Qt::ControlModifier);
  window().addDockWidget(Qt::TopDockWidgetArea, dock("Timeline"));
  trigger("resetLayout");
  EXPECT_FALSE(dock("Inspect")->isVisible());
  EXPECT_EQ(window().dockWidgetArea(dock("Inspect")), Qt::RightDockWidgetArea);
  EXPECT_EQ(window().dockWidgetArea(dock("Timeline")), Qt::BottomDockWidgetArea);
}

TEST_F(WindowLayoutTest, ResetGivesTheLibraryItsWidthBack) {
  window().docks().show("Library");
  QCoreApplication::processEvents();
  const int usual = dock("Library")->width();
  window().resizeDocks({dock("Library")}, {usual + 250}, Qt::Horizontal);
  QCoreApplication::processEvents();
  ASSERT_EQ(dock("Library")->width(), usual + 250);
  trigger("resetLayout");
  QCoreApplication::processEvents();
  EXPECT_EQ(dock("Library")->width(), usual);
}

TEST_F(WindowLayoutTest, EachPresetIsRestoredAsItWasLeft) {
  open({"good.dsa"});
  EXPECT_EQ(window().docks().preset(), "Watch");
  EXPECT_FALSE(dock("Inspect")->isVisible());
  press(Qt::Key_4, Qt::ControlModifier);
  EXPECT_EQ(window().docks().preset(), "Analyse");
  EXPECT_TRUE(dock("Inspect")->isVisible() && dock("Timeline")->isVisible());
  dock("Timeline")->close();
  press(Qt::Key_1, Qt::ControlModifier);
  EXPECT_TRUE(dock("Timeline")->isVisible());
  EXPECT_FALSE(dock("Inspect")->isVisible());
  press(Qt::Key_4, Qt::ControlModifier);
  window().close();
  start();
  open({"good.dsa"});
  EXPECT_EQ(window().docks().preset(), "Analyse");
  EXPECT_TRUE(dock("Inspect")->isVisible());
  EXPECT_FALSE(dock("Timeline")->isVisible()) << "as it was left";
  trigger("resetLayout");
  EXPECT_TRUE(dock("Timeline")->isVisible());
  press(Qt::Key_1, Qt::ControlModifier);
  EXPECT_FALSE(dock("Inspect")->isVisible());
}

// The comparison hides all docks.
TEST_F(WindowLayoutTest, ALayoutThatIsChosenWhileComparingIsWhole) {
  open({"good.dsa"});
  trigger("compare");
  ASSERT_FALSE(dock("Timeline")->isVisible());
  press(Qt::Key_4, Qt::ControlModifier);
  EXPECT_TRUE(dock("Timeline")->isVisible() && dock("Inspect")->isVisible());
  press(Qt::Key_1, Qt::ControlModifier);
  EXPECT_TRUE(dock("Timeline")->isVisible());
}

TEST_F(WindowLayoutTest, OwnPresetsHaveNames) {
  open({"good.dsa"});
  const auto* button = find<QToolButton>("layoutButton");
  EXPECT_TRUE(button->toolTip().startsWith("Layout: Watch"));
  press(Qt::Key_I, Qt::ControlModifier);
  ask_.texts = {"two sensors"};
  trigger("keepLayout");
  EXPECT_TRUE(button->toolTip().startsWith("Layout: two sensors"));
  press(Qt::Key_I, Qt::ControlModifier);
  press(Qt::Key_1, Qt::ControlModifier);
  EXPECT_EQ(window().docks().ownPresets(), QStringList("two sensors"));
  window().close();
  start();
  open({"good.dsa"});
  const auto own = [this] {
    for (QAction* action : window().state().menus.layout->actions())
      if (action->text() == "two sensors") return action;
    return static_cast<QAction*>(nullptr);
  };
  ASSERT_TRUE(own());
  own()->trigger();
  QCoreApplication::processEvents();
  EXPECT_FALSE(dock("Inspect")->isVisible()) << "as it was left";
  EXPECT_TRUE(own()->isChecked());
  trigger("removeLayout");
  EXPECT_FALSE(own());
  EXPECT_EQ(window().docks().preset(), "Watch");
  EXPECT_FALSE(actions().at("removeLayout")->isVisible());
  for (const char* name : {"watch", "a/b", "", " x", "0123456789012345678901234567890"})
    EXPECT_FALSE(window().docks().keepAs(name).isEmpty()) << name;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(window().docks().keepAs("own " + QString::number(i)), "");
  EXPECT_TRUE(window().docks().keepAs("one more").startsWith("There are 10"));
}

TEST_F(WindowLayoutTest, WithoutAHandItsPresetsAndMenusAreNotOffered) {
  EXPECT_FALSE(actions().at("presetWatch")->isEnabled()) << "on the start page";
  EXPECT_FALSE(actions().at("play")->isEnabled());
  open({"good.dsa"});
  EXPECT_FALSE(actions().at("presetGrasp")->isEnabled());
  EXPECT_EQ(whyGreyed(*actions().at("presetRecord")),
            "No hand is connected: connect one first (Ctrl+K)");
  const auto shown = [this](const QString& title) {
    for (const QAction* menu : window().menuBar()->actions())
      if (menu->text().remove('&') == title) return menu->isVisible();
    ADD_FAILURE() << title.toStdString();
    return false;
  };
  EXPECT_TRUE(shown("Playback"));
  EXPECT_FALSE(shown("Record") || actions().at("record")->isVisible());
  for (const QAction* menu : window().menuBar()->actions()) {
    qsizetype entries = 0;
    for (const QAction* each : menu->menu()->actions()) entries += !each->isSeparator();
    EXPECT_LE(entries, 15) << menu->text().toStdString();
  }
}

TEST_F(WindowLayoutTest, ABrokenSettingsFileDoesNotStopTheProgram) {
  window().close();
  window_.reset();
  testing::writeFile(
      folder_ / "palpate.ini",
      "[window]\ngeometry=rubbish\nlayout=@ByteArray(nonsense)\n[recent]\nfiles=,,\n");
  start();
  open({"good.dsa"});
  EXPECT_TRUE(dock("Timeline")->isVisible());
}

TEST_F(WindowLayoutTest, ANarrowWindowKeepsEveryControl) {
  open({"good.dsa"});
  for (const QSize size : {QSize(900, 600), QSize(1600, 1000)}) {
    window().resize(size);
    trigger("resetLayout");
    QCoreApplication::processEvents();
    EXPECT_EQ(window().size(), size);
    for (const char* name : {"speedBox", "recordingsBox", "mapBox", "rangeBox", "frameField"}) {
      const auto* part = find<QWidget>(name);
      EXPECT_TRUE(part->isVisible()) << name;
      EXPECT_GT(part->width(), 40) << name << " at " << size.width();
    }
    window().docks().show("Inspect");
    QCoreApplication::processEvents();
    // Matrix names are read in full, and the figures that matter most are there.
    auto* table = find<MatrixTable>("matrixTable");
    EXPECT_GE(table->columnWidth(0), table->fontMetrics().horizontalAdvance("2 proximal") + 30);
    EXPECT_FALSE(table->isColumnHidden(MatrixTableModel::kMaximum));
    EXPECT_EQ(table->isColumnHidden(MatrixTableModel::kArea), size.width() == 900);
  }
}

TEST_F(WindowLayoutTest, DocksCloseByTheirButton) {
  open({"good.dsa"});
  auto* close = dock("Inspect")->titleBarWidget()->findChild<QToolButton*>();
  QTest::mouseClick(close, Qt::LeftButton);
  EXPECT_FALSE(dock("Inspect")->isVisible());
  window().docks().show("Inspect");
  EXPECT_TRUE(dock("Inspect")->isVisible());
  EXPECT_EQ(window().docks().names(),
            (QStringList{"Inspect",
                         "Timeline",
                         "Hand",
                         "Link",
                         "Filter",
                         "Spectrum",
                         "Calibrate",
                         "Slip",
                         "Library",
                         "Log",
                         "Recognise"}));
}

}  // namespace
}  // namespace palpate::gui::window_layout_test
