#include "gui/shell/screenshot_presses.h"

#include <QAction>
#include <QDialog>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>
#include <QWidget>

#include <gtest/gtest.h>

#include <palpate/core/error.h>

namespace palpate::gui::screenshot_presses_test {
namespace {

class ScreenshotPressesTest : public ::testing::Test {
 protected:
  ScreenshotPressesTest() {
    auto* action = new QAction("Record", &window_);
    action->setShortcut(QKeySequence("Ctrl+R"));
    window_.addAction(action);
    QObject::connect(action, &QAction::triggered, [this] { pressed_ << "Ctrl+R"; });
    auto* layout = new QVBoxLayout(&window_);
    for (const char* words : {"&Check…", "What is it?  (Q)", "Chosen", "Hidden"}) {
      auto* button = new QPushButton(words, &window_);
      layout->addWidget(button);
      QObject::connect(button, &QPushButton::clicked, [this, words] { pressed_ << words; });
      if (button->text() == "Hidden") button->hide();
      if (button->text() == "Chosen") {
        button->setCheckable(true);
        button->setChecked(true);
      }
    }
    window_.show();
  }
  std::string failure(const char* what) {
    try {
      runAndPress(window_, {{what, 0.0}}, 60.0, 0.0);  // doesn't wait for the end
    } catch (const Error& error) {
      return error.what();
    }
    return "it worked";
  }
  QWidget window_;
  QStringList pressed_;
};

TEST_F(ScreenshotPressesTest, MomentsStandBehindTheLastAt) {
  EXPECT_EQ(parsedPress("Ctrl+R@1.5").what, "Ctrl+R");
  EXPECT_EQ(parsedPress("Ctrl+R@1.5").atS, 1.5);
  EXPECT_EQ(parsedPress("Q").what, "Q");
  EXPECT_EQ(parsedPress("Q").atS, 0.0);
  for (const char* words : {"@", "mail@home", "Q@-1", "Q@", "@3"})
    EXPECT_EQ(parsedPress(words).what, words) << words;
}

TEST_F(ScreenshotPressesTest, PressesKeysAndButtonsInOrderOfTheirMoments) {
  EXPECT_TRUE(runAndPress(window_, {{"What is it?", 0.04}, {"Ctrl+R", 0.0}, {"Check", 0.02}}, 0.06)
                  .isNull());
  EXPECT_EQ(pressed_, QStringList({"Ctrl+R", "&Check…", "What is it?  (Q)"}));
}

TEST_F(ScreenshotPressesTest, SaysWhatCannotBePressed) {
  for (const char* what : {"Ctrl+J", "Nothing", "Hidden", "Chosen", ""})
    EXPECT_NE(failure(what).find("'" + std::string(what) + "'"), std::string::npos) << what;
  EXPECT_TRUE(pressed_.isEmpty());
}

TEST_F(ScreenshotPressesTest, WaitsForWhatCannotBePressedYet) {
  auto* late = window_.findChildren<QPushButton*>().last();
  ASSERT_EQ(late->text(), "Hidden");
  QTimer::singleShot(50, late, [late] { late->show(); });
  runAndPress(window_, {{"Hidden", 0.0}, {"Check", 0.01}}, 0.02);
  EXPECT_EQ(pressed_, QStringList({"Hidden", "&Check…"}));
}

TEST_F(ScreenshotPressesTest, ADialogueThatOpensIsThePictureAndGetsTheNextPresses) {
  auto* action = new QAction("Ask", &window_);
  action->setShortcut(QKeySequence("F9"));
  window_.addAction(action);
  int pressedThere = 0;
  QObject::connect(action, &QAction::triggered, [&] {
    QDialog dialogue(&window_);
    dialogue.setFixedSize(321, 123);
    QPushButton more("More", &dialogue);
    QObject::connect(&more, &QPushButton::clicked, [&] { ++pressedThere; });
    dialogue.exec();
  });
  const QImage picture = runAndPress(window_, {{"F9", 0.0}, {"More", 0.03}}, 0.06);
  EXPECT_EQ(picture.size(), QSize(321, 123));
  EXPECT_EQ(pressedThere, 1);
}

}  // namespace
}  // namespace palpate::gui::screenshot_presses_test
