#include "gui/help/whats_this.h"

#include <QDockWidget>
#include <QHelpEvent>
#include <QLabel>
#include <QWhatsThis>

#include "gui/testing/window_fixture.h"

namespace palpate::gui::whats_this_test {
namespace {

TEST(WhatsThisTest, TellsTheToolTipOfTheControlOrOfWhatSurroundsIt) {
  const WhatsThis what([](const QString& dock) { return "about " + dock; }, nullptr);
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

}  // namespace
}  // namespace palpate::gui::whats_this_test
