// Comparing two recordings, in the window: which ones, how it comes and goes, what is said of odd
// ones.
#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QScrollArea>
#include <QScrollBar>

#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_fixture.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui::compare_window_test {
namespace {

using CompareWindowTest = CompareWindowFixture;

TEST_F(CompareWindowTest, TakesThePlaceOfTheMatricesAndGivesItBack) {
  open({"early.dsa", "late.dsa"});
  window().docks().show("Inspect");
  ASSERT_TRUE(dock("Timeline")->isVisible());
  compareNow();
  EXPECT_TRUE(compare().isVisible());
  EXPECT_FALSE(window().feature<MatricesFeature>().panel().view().isVisible());
  EXPECT_FALSE(dock("Timeline")->isVisible());
  EXPECT_FALSE(dock("Inspect")->isVisible());
  EXPECT_TRUE(actions().at("compare")->isChecked());
  QTest::mouseClick(find<QToolButton>("compareBack"), Qt::LeftButton);
  EXPECT_FALSE(compare().isVisible());
  EXPECT_TRUE(window().feature<MatricesFeature>().panel().view().isVisible());
  EXPECT_TRUE(dock("Timeline")->isVisible());
  EXPECT_TRUE(dock("Inspect")->isVisible());
}

// The comparison is of the recordings as they are: the status line agrees.
TEST_F(CompareWindowTest, TheStatusLineIsNotOfFilteredValues) {
  open({"early.dsa", "late.dsa"});
  ActiveFilters& filters = window().state().activeFilters;
  filters.editor().setRecipe(parseRecipe(std::vector<std::string>{"gaussian:size=5"}));
  filters.setOn(true);
  filters.wait();
  QCoreApplication::processEvents();
  playback().seekFrame(12);  // the third one of 500, 501, ..
  const auto status = [this] { return find<StatusStrip>("statusStrip")->status(); };
  EXPECT_TRUE(status().state.contains("filtered"));
  compareNow();
  EXPECT_FALSE(status().state.contains("filtered")) << status().state.toStdString();
  EXPECT_EQ(status().figures.at(1), "max 502");
  compareNow();
  EXPECT_TRUE(status().state.contains("filtered"));
}

// The comparison is wider than what is left beside this dock.
TEST_F(CompareWindowTest, AWideDockHasItsWidthAgain) {
  window().resize(1280, 800);
  open({"early.dsa", "late.dsa"});
  window().docks().show("Recognise");
  QCoreApplication::processEvents();
  window().resizeDocks({dock("Recognise")}, {760}, Qt::Horizontal);
  QCoreApplication::processEvents();
  const int width = dock("Recognise")->width();
  ASSERT_GT(width, 700);
  compareNow();
  ASSERT_LT(window().width() - width, compare().minimumSizeHint().width())
      << "there is no room for both";
  EXPECT_FALSE(dock("Recognise")->isVisible());
  press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  QCoreApplication::processEvents();
  EXPECT_TRUE(dock("Recognise")->isVisible());
  EXPECT_EQ(dock("Recognise")->width(), width);
  EXPECT_EQ(window().size(), QSize(1280, 800));
}

// Heat maps and chart are seen without scrolling, below a notice, too.
TEST_F(CompareWindowTest, BothFitIntoAWindowOfAUsualScreen) {
  window().resize(1280, 800);
  open({"early.dsa", "untouched.dsa"});
  compareNow();
  for (const QString& each : window().docks().names()) dock(each.toUtf8())->hide();
  for (int i = 0; i < 4; ++i) settle();
  ASSERT_EQ(window().size(), QSize(1280, 800));
  auto* chart = compare().findChild<CompareChart*>();
  auto* scroll = compare().findChild<QScrollArea*>();
  ASSERT_TRUE(chart && scroll);
  ASSERT_TRUE(find<QLabel>("compareNotice")->isVisible());
  EXPECT_EQ(scroll->verticalScrollBar()->maximum(), 0);
  EXPECT_EQ(chart->visibleRegion().boundingRect(), chart->rect());
  EXPECT_GT(compare().view().height(), chart->height());
  EXPECT_GE(chart->height(), 120);
}

// What the difference of a frame is stands above its heat map without an ellipsis.
TEST_F(CompareWindowTest, TheCaptionOfTheDifferenceFitsBesideADock) {
  window().resize(1280, 800);
  open({"early.dsa", "late.dsa"});
  compareNow();
  dock("Inspect")->show();
  settle();
  playback().seekFrame(30);
  settle();
  const CompareView& view = compare().view();
  const CompareGroupContent& between =
      view.frames()[static_cast<std::size_t>(CompareGroup::kDifference)];
  ASSERT_TRUE(between.caption.contains("largest")) << between.caption.toStdString();
  const QFontMetricsF metrics(view.font());
  const double room = view.geometryOfGroups().titleRect(CompareGroup::kDifference).width() - 17.0;
  EXPECT_LE(metrics.horizontalAdvance(fittingCaption(between, room, metrics)), room);
  EXPECT_TRUE(fittingCaption(between, room, metrics).contains("largest"));
}

TEST_F(CompareWindowTest, SwappingKeepsTheMoment) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  playback().seekFrame(20);
  QTest::mouseClick(find<QToolButton>("compareSwap"), Qt::LeftButton);
  settle();
  EXPECT_EQ(name(compare().a()), "late");
  EXPECT_EQ(name(compare().b()), "early");
  EXPECT_EQ(window().state().displayed.unfilteredRecording(), compare().a());
  EXPECT_NEAR(*compare().offsetS(), 1.0, 1e-9);
  EXPECT_EQ(playback().frame(), 40u);
  EXPECT_EQ(playback().numFrames(), 80u) << "what is played is A";
  EXPECT_EQ(valueIn(CompareGroup::kDifference), -200.0F);
}

TEST_F(CompareWindowTest, AnOffsetByHandIsSwappedToo) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  compare().setOffset(0.4);
  settle();
  QTest::mouseClick(find<QToolButton>("compareSwap"), Qt::LeftButton);
  settle();
  EXPECT_EQ(compare().alignment(), Alignment::kManual);
  EXPECT_NEAR(*compare().offsetS(), -0.4, 1e-9);
}

TEST_F(CompareWindowTest, AAndBAreChosenAmongWhatIsOpen) {
  open({"early.dsa", "late.dsa", "third.dsa"});
  compareNow();
  EXPECT_EQ(name(compare().b()), "late") << "the next one";
  choose("compareB", "third.dsa");
  EXPECT_EQ(name(compare().b()), "third");
  choose("compareB", "late.dsa");
  choose("compareA", "third.dsa");
  EXPECT_EQ(name(window().state().displayed.unfilteredRecording()), "third")
      << "A is what is shown and played";
  EXPECT_EQ(name(compare().b()), "late");
  EXPECT_NEAR(*compare().offsetS(), 0.25 - 1.5, 1e-9);
  // The window shows another one: that is A.
  press(Qt::Key_Tab, Qt::ControlModifier);
  settle();
  EXPECT_EQ(name(compare().a()), "early");
  choose("compareA", "late.dsa");
  EXPECT_EQ(name(compare().a()), "late");
  EXPECT_EQ(name(compare().b()), "early") << "chosen as A, B gives way";
  press(Qt::Key_W, Qt::ControlModifier);
  settle();
  EXPECT_TRUE(compare().hasPair());
  EXPECT_NE(compare().a(), compare().b());
}

TEST_F(CompareWindowTest, OneRecordingOffersToOpenAnotherOrItself) {
  open({"early.dsa"});
  compareNow();
  EXPECT_FALSE(compare().hasPair());
  auto* text = find<QLabel>("compareEmpty");
  EXPECT_TRUE(text->isVisible());
  EXPECT_TRUE(text->text().contains("Only early.dsa is open"));
  ask_.files = {QString::fromStdString(file("late.dsa"))};
  QTest::mouseClick(find<QPushButton>("compareItself"), Qt::LeftButton);
  settle();
  EXPECT_EQ(compare().b(), compare().a());
  EXPECT_TRUE(find<CompareView>("compareView")->isVisible());
  compare().setOffset(0.0);
  settle();
  EXPECT_TRUE(compare().notice().contains("same recording twice"));
  choose("compareB", "open another…");
  EXPECT_EQ(ask_.files.asked.size(), 1);
  waitUntilOpened();
  settle();
  EXPECT_EQ(name(compare().a()), "early") << "A stays";
  EXPECT_EQ(name(compare().b()), "late");
}

TEST_F(CompareWindowTest, EscapeGoesBack) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  press(Qt::Key_Escape);
  EXPECT_FALSE(window().state().comparison.on());
  EXPECT_FALSE(actions().at("compare")->isChecked());
}

TEST_F(CompareWindowTest, EscapeInAnOpenListClosesTheListAlone) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  QComboBox* box = nullptr;
  for (auto* each : window().findChildren<QComboBox*>())
    if (each->isVisible() && each->count() > 1) box = each;
  ASSERT_NE(box, nullptr);
  box->showPopup();
  ASSERT_NE(QApplication::activePopupWidget(), nullptr);
  actions().at("dismiss")->trigger();
  EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
  EXPECT_TRUE(window().state().comparison.on());
  // On a desktop Qt closes the list before the shortcut of the same press is triggered.
  box->showPopup();
  QKeyEvent pressed(QEvent::ShortcutOverride, Qt::Key_Escape, Qt::NoModifier);
  QApplication::sendEvent(box->view(), &pressed);
  box->hidePopup();
  ASSERT_EQ(QApplication::activePopupWidget(), nullptr);
  actions().at("dismiss")->trigger();
  EXPECT_TRUE(window().state().comparison.on());
  QTest::qWait(0);
  press(Qt::Key_Escape);
  EXPECT_FALSE(window().state().comparison.on());
}

TEST_F(CompareWindowTest, WithNothingOpenItAsksAndComparesWhatComes) {
  ask_.files = {QString::fromStdString(file("early.dsa") + "\n" + file("late.dsa"))};
  press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  waitUntilOpened();
  settle();
  EXPECT_TRUE(window().state().comparison.on());
  EXPECT_TRUE(compare().hasPair());
}

TEST_F(CompareWindowTest, ClosingEverythingLeavesIt) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_TRUE(window().state().comparison.on());
  press(Qt::Key_W, Qt::ControlModifier);
  EXPECT_FALSE(window().state().comparison.on());
  open({"early.dsa"});
  EXPECT_TRUE(dock("Timeline")->isVisible()) << "docks are as they were";
}

TEST_F(CompareWindowTest, WithoutContactStartsAreUsedAndSaid) {
  open({"early.dsa", "untouched.dsa"});
  compareNow();
  EXPECT_EQ(*compare().offsetS(), 0.0);
  EXPECT_EQ(
      compare().notice(),
      "No lasting contact (3 taxels in 3 frames) in B: the recordings are aligned at their starts");
  EXPECT_TRUE(find<QLabel>("compareNotice")->isVisible());
}

TEST_F(CompareWindowTest, AnotherHandIsSaid) {
  open({"early.dsa", "pad.dsa"});
  compareNow();
  EXPECT_TRUE(compare().notice().contains("finger 0 proximal")) << compare().notice().toStdString();
  EXPECT_EQ(compare().view().frames()[2].notice, "nothing to compare: other matrices");
  EXPECT_TRUE(compare().chart().curves().curveB) << "all matrices of either can be compared";
  choose("compareMatrix", "finger 1 distal");
  EXPECT_FALSE(compare().chart().curves().curveB);
  EXPECT_EQ(compare().figures(), "the other recording has no such matrix");
}

TEST_F(CompareWindowTest, OneFrameAndNoneAreRecordingsToo) {
  open({"early.dsa", "one.dsa", "empty.dsa"});
  compareNow();
  choose("compareB", "empty.dsa");
  EXPECT_EQ(compare().view().frames()[1].notice, "B has no frames");
  choose("compareB", "one.dsa");
  choose("compareAlignment", "start of both");
  playback().seekFrame(0);
  EXPECT_EQ(valueIn(CompareGroup::kB), 50.0F);
  playback().seekFrame(5);
  EXPECT_EQ(compare().view().frames()[1].notice, "B ended 0.25 s ago");
}

TEST_F(CompareWindowTest, TheAlignmentIsRemembered) {
  open({"early.dsa", "late.dsa"});
  compareNow();
  choose("compareAlignment", "start of both");
  window().close();
  start();
  EXPECT_EQ(window().feature<CompareFeature>().panel().alignment(), Alignment::kStart);
  open({"good.dsa"});
  EXPECT_TRUE(dock("Timeline")->isVisible()) << "its layout isn't that of the window";
}

}  // namespace
}  // namespace palpate::gui::compare_window_test
