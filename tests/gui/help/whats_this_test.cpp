#include "gui/help/whats_this.h"

#include <QDockWidget>
#include <QHelpEvent>
#include <QLabel>
#include <QWhatsThis>
#include <QWhatsThisClickedEvent>

#include "gui/help/manual_window.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::whats_this_test {
namespace {

TEST(WhatsThisTest, TellsTheToolTipOfTheControlOrOfWhatSurroundsIt) {
  const WhatsThis what([](const QString& dock) { return "about " + dock; }, {}, nullptr);
  QDockWidget dock;
  dock.setObjectName("Slip");
  auto* page = new QWidget(&dock);
  auto* label = new QLabel(page);
  EXPECT_EQ(what.about(*label), "about Slip");
  page->setToolTip("the page");
  EXPECT_EQ(what.about(*label), "the page");
  label->setToolTip("the label");
  EXPECT_EQ(what.about(*label), "the label");
  label->setWhatsThis("more of it");
  EXPECT_EQ(what.about(*label), "more of it");
  EXPECT_EQ(what.about(QWidget()), "");
}

TEST(WhatsThisTest, NamesOfPagesAreLinks) {
  EXPECT_EQ(WhatsThis::withLinks("a < b\nMore: slip.md, docks.md#the-hand."),
            "<p>a &lt; b<br>More: <a href=\"slip.md\">slip.md</a>, "
            "<a href=\"docks.md#the-hand\">docks.md</a>.</p>");
  EXPECT_EQ(WhatsThis::withLinks("a < b"), "a < b");
}

class WhatsThisWindowTest : public WindowTest {};

TEST_F(WhatsThisWindowTest, AnswersForControlsOfTheWindow) {
  auto* speed = find<QWidget>("speedBox");
  ASSERT_NE(speed, nullptr);
  QHelpEvent asks(QEvent::QueryWhatsThis, {2, 2}, {2, 2});
  asks.ignore();
  QCoreApplication::sendEvent(speed, &asks);
  EXPECT_TRUE(asks.isAccepted());
  press(Qt::Key_F1, Qt::ShiftModifier);
  EXPECT_TRUE(QWhatsThis::inWhatsThisMode());
  QWhatsThis::leaveWhatsThisMode();
}

// The text of a dock is shown with links, and a click on one opens the manual there.
TEST_F(WhatsThisWindowTest, ALinkOpensTheManualAtItsPage) {
  std::filesystem::create_directory_symlink(testing::dataFolder().parent_path() / "docs",
                                            folder_ / "docs");
  auto* dock = window().findChild<QDockWidget*>("Slip");
  ASSERT_NE(dock, nullptr);
  QWhatsThisClickedEvent click("docks.md#slip");
  QCoreApplication::sendEvent(dock, &click);
  auto* manual = window().findChild<ManualWindow*>();
  ASSERT_NE(manual, nullptr);
  EXPECT_TRUE(manual->isVisible());
  EXPECT_EQ(manual->page(), "manual/docks.md");
  QWhatsThisClickedEvent other("settings.md");
  QCoreApplication::sendEvent(dock, &other);
  EXPECT_EQ(manual->page(), "manual/settings.md");
}

}  // namespace
}  // namespace palpate::gui::whats_this_test
