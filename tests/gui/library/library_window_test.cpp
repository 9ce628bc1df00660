// The Library in the window: from the key to the recording that is shown.
#include <QLineEdit>

#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_panel.h"
#include "gui/library/library_feature.h"
#include "gui/library/library_panel.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::library_window_test {
namespace {

class LibraryWindowTest : public WindowTest {
 protected:
  LibraryPanel& library() { return window().feature<LibraryFeature>().panel(); }
  QTableView* table() { return find<QTableView>("libraryTable"); }
  void toggle() { press(Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier); }
  // The folder of the test, with as many files as there are names.
  void look(const std::vector<std::string>& names) {
    for (const std::string& name : names) file(name);
    library().setFolder(QString::fromStdString(folder_.path().string()));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          return !library().scanning() &&
                 table()->model()->rowCount() == static_cast<int>(names.size());
        },
        10000));
  }
};

TEST_F(LibraryWindowTest, IsThereWithNothingOpenAndOpensByKeyboard) {
  EXPECT_FALSE(library().isVisible());
  toggle();
  ASSERT_TRUE(library().isVisible());
  look({"good1.dsa", "good2.dsa"});
  library().startSearch();
  auto* field = find<QLineEdit>("librarySearch");
  QTest::keyClicks(field, "good2");
  QTest::keyClick(field, Qt::Key_Return);
  QTest::keyClick(table(), Qt::Key_Return);
  waitUntilOpened();
  ASSERT_TRUE(window().state().displayed.unfilteredRecording());
  EXPECT_EQ(window().state().displayed.unfilteredRecording()->path.filename(), "good2.dsa");
  EXPECT_TRUE(library().isVisible()) << "it stays when a recording is shown";
  toggle();
  EXPECT_FALSE(library().isVisible());
}

TEST_F(LibraryWindowTest, ItsArrowsMoveInItAndNothingElse) {
  toggle();
  look({"good1.dsa", "good2.dsa", "good3.dsa"});
  open({"good1.dsa"});
  table()->setFocus();
  table()->selectRow(0);
  const double speed = playback().speed();
  const std::size_t frame = playback().frame();
  for (const Qt::Key key : {Qt::Key_Down, Qt::Key_End, Qt::Key_Home, Qt::Key_Right, Qt::Key_Up})
    QTest::keyClick(table(), key);
  EXPECT_EQ(playback().speed(), speed);
  EXPECT_EQ(playback().frame(), frame);
  QTest::keyClick(table(), Qt::Key_Down);
  EXPECT_EQ(table()->currentIndex().row(), 1);
}

TEST_F(LibraryWindowTest, ReturnPressedTwiceReadsAFileOnceAndAsksNothing) {
  ask_.choices = {"Save"};
  toggle();
  look({"good1.dsa", "good2.dsa"});
  QTest::keyClick(find<QLineEdit>("librarySearch"), Qt::Key_Return);
  QTest::keyClick(table(), Qt::Key_Return);
  QTest::keyClick(table(), Qt::Key_Return);
  waitUntilOpened();
  EXPECT_EQ(reads_, 1);
  ASSERT_TRUE(window().state().displayed.isRecording());
  window().state().events.add({.kind = "label", .matrix = {}, .text = "cup", .json = {}}, "label");
  ASSERT_TRUE(window().state().events.editor()->unsaved());
  QTest::keyClick(table(), Qt::Key_Return);
  QTest::keyClick(table(), Qt::Key_Return);
  waitUntilOpened();
  EXPECT_EQ(reads_, 1);
  EXPECT_TRUE(ask_.choices.asked.isEmpty());
  EXPECT_TRUE(window().state().events.editor()->unsaved()) << "the mark is still there";
}

TEST_F(LibraryWindowTest, ComparesWithWhatIsShown) {
  toggle();
  look({"good1.dsa", "good2.dsa"});
  const int row = table()->model()->index(0, 0).data().toString() == "good2.dsa" ? 0 : 1;
  table()->selectRow(row);
  QTest::keyClick(table(), Qt::Key_Return, Qt::ControlModifier);
  EXPECT_FALSE(window().state().opener.busy()) << "nothing is shown";
  open({"good1.dsa"});
  table()->selectRow(row);
  QTest::keyClick(table(), Qt::Key_Return, Qt::ControlModifier);
  waitUntilOpened();
  EXPECT_TRUE(window().state().comparison.on());
  ASSERT_TRUE(window().state().displayed.unfilteredRecording());
  EXPECT_EQ(window().state().displayed.unfilteredRecording()->path.filename(), "good1.dsa");
  ASSERT_TRUE(window().feature<CompareFeature>().panel().b());
  EXPECT_EQ(window().feature<CompareFeature>().panel().b()->path.filename(), "good2.dsa");
  // Open already, it is only shown.
  press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(window().state().comparison.on());
  const int reads = reads_;
  table()->selectRow(row);
  QTest::keyClick(table(), Qt::Key_Return, Qt::ControlModifier);
  EXPECT_TRUE(window().state().comparison.on());
  EXPECT_EQ(reads_, reads);
}

TEST_F(LibraryWindowTest, StaysOpenOverARestart) {
  toggle();
  look({"good1.dsa"});
  window().close();
  start();
  EXPECT_TRUE(library().isVisible());
  EXPECT_EQ(library().folder(), QString::fromStdString(folder_.path().string()));
  ASSERT_TRUE(QTest::qWaitFor([&] { return table()->model()->rowCount() == 1; }, 10000));
}

// analyst m19: what is typed then is for the search, not for the button that had the keyboard.
TEST_F(LibraryWindowTest, AFolderThatIsOpenedCanBeSearchedAtOnce) {
  file("good1.dsa");
  window().state().open({folder_.path()});
  ASSERT_TRUE(library().isVisible());
  EXPECT_EQ(window().focusWidget(), find<QLineEdit>("librarySearch"));
}

TEST_F(LibraryWindowTest, ResettingTheLayoutHidesIt) {
  open({"good.dsa"});
  toggle();
  EXPECT_TRUE(library().isVisible());
  trigger("resetLayout");
  EXPECT_FALSE(library().isVisible());
}

}  // namespace
}  // namespace palpate::gui::library_window_test
