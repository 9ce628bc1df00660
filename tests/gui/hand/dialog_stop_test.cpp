// A modal dialogue has a button that stops the hand while there is a hand to stop.
#include "gui/hand/dialog_stop.h"

#include <QInputDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <QVBoxLayout>
#include <initializer_list>

#include <gtest/gtest.h>

#include "gui/appearance/theme.h"

namespace palpate::gui::dialog_stop_test {
namespace {

QPushButton* stopOf(const QDialog& dialog) {
  return dialog.findChild<QPushButton*>("dialogStopButton");
}

TEST(DialogStop, EachModalDialogueStopsTheHandByAClick) {
  QAction stop("Stop");
  const DialogStop dialogs(stop, nullptr);
  QSignalSpy stopped(&stop, &QAction::triggered);
  QMessageBox question(QMessageBox::Question, "Palpate", "Go on?", QMessageBox::Yes);
  QInputDialog name;
  for (QDialog* dialog : std::initializer_list<QDialog*>{&question, &name}) {
    dialog->open();
    QCoreApplication::processEvents();
    QPushButton* button = stopOf(*dialog);
    ASSERT_NE(button, nullptr);
    EXPECT_TRUE(button->isVisible());
    EXPECT_TRUE(
        dialog->rect().contains(QRect(button->mapTo(dialog, QPoint(0, 0)), button->size())));
    QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_TRUE(dialog->isVisible()) << "the dialogue stays";
    dialog->close();
  }
  EXPECT_EQ(stopped.size(), 2);
}

TEST(DialogStop, AQuestionIsReadWhole) {
  QAction stop("Stop");
  const DialogStop dialogs(stop, nullptr);
  QMessageBox question(
      QMessageBox::Question,
      "Palpate",
      "A batch is running. Finished files stay; the rest are not made. End the batch?",
      QMessageBox::Yes | QMessageBox::Cancel);
  question.open();
  QCoreApplication::processEvents();
  ASSERT_NE(stopOf(question), nullptr);
  const auto* label = question.findChild<QLabel*>("qt_msgbox_label");
  ASSERT_NE(label, nullptr);
  EXPECT_GE(label->width(), label->minimumSizeHint().width());
  EXPECT_GE(label->height(), label->heightForWidth(label->width()));
  EXPECT_TRUE(question.rect().contains(label->geometry()));
  question.close();
}

// With the theme's style sheet, which changes what text and buttons take.
TEST(DialogStop, QuestionsAndNamesAreReadWholeInTheTheme) {
  applyTheme(*qApp, Theme::kLight);
  QAction stop("Stop");
  const DialogStop dialogs(stop, nullptr);
  QWidget window;
  window.resize(1200, 700);
  window.show();
  QMessageBox question(
      QMessageBox::Question,
      "Finish the recording",
      "A recording is running. Before the hand is disconnected, the recording is "
      "finished; all that was recorded is kept. The hand is moving: it will be stopped.",
      QMessageBox::NoButton,
      &window);
  question.setDefaultButton(question.addButton("Finish the recording", QMessageBox::AcceptRole));
  question.addButton("Keep recording", QMessageBox::RejectRole);
  QTimer::singleShot(100, &question, [&] {
    const auto* label = question.findChild<QLabel*>("qt_msgbox_label");
    ASSERT_NE(label, nullptr);
    EXPECT_GE(label->width(), label->minimumSizeHint().width());
    EXPECT_GE(label->height(), label->heightForWidth(label->width()));
    question.close();
  });
  question.exec();
  QInputDialog name(&window);
  name.setLabelText("Name");
  name.open();
  QCoreApplication::processEvents();
  const QPushButton* button = stopOf(name);
  ASSERT_NE(button, nullptr);
  EXPECT_GE(button->width(), button->sizeHint().width());
  EXPECT_LE(button->parentWidget()->sizeHint().width(), name.width());
  name.close();
}

TEST(DialogStop, WithoutAHandThereIsNoButton) {
  QAction stop("Stop");
  const DialogStop dialogs(stop, nullptr);
  QInputDialog name;
  name.open();
  EXPECT_NE(stopOf(name), nullptr);
  name.close();
  stop.setEnabled(false);
  name.open();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_EQ(stopOf(name), nullptr);
  name.close();
}

TEST(DialogStop, ADialogueThatIsNotModalLeavesTheWindowsButtonUsable) {
  QAction stop("Stop");
  const DialogStop dialogs(stop, nullptr);
  QDialog keys;
  new QVBoxLayout(&keys);
  keys.show();
  EXPECT_EQ(stopOf(keys), nullptr);
}

TEST(DialogStop, SaysWhetherAStopReachesTheHandAndWhetherItMoves) {
  QAction stop("Stop");
  DialogStop dialogs(stop, nullptr);
  QMessageBox question(QMessageBox::Question, "Palpate", "Go on?", QMessageBox::Yes);
  const auto shown = [&] {
    const auto* label = question.findChild<QLabel*>("dialogStopState");
    return label ? label->text() : QString("no label");
  };
  question.open();
  QCoreApplication::processEvents();
  EXPECT_EQ(shown(), "A hand is connected.");
  const QSize size = question.size();
  dialogs.setMoving(true);
  EXPECT_EQ(shown(), "The hand is moving.");
  dialogs.setReached(false);
  EXPECT_EQ(shown(), "The hand can't be stopped from here.");
  QCoreApplication::processEvents();
  const auto* label = question.findChild<QLabel*>("dialogStopState");
  EXPECT_GE(label->width(), label->sizeHint().width()) << "it is read whole";
  EXPECT_EQ(question.size(), size);
  question.close();
  QInputDialog name;
  name.open();
  QCoreApplication::processEvents();
  EXPECT_EQ(name.findChild<QLabel*>("dialogStopState")->text(),
            "The hand can't be stopped from here.");
  dialogs.setReached(true);
  EXPECT_EQ(name.findChild<QLabel*>("dialogStopState")->text(), "The hand is moving.");
  dialogs.setMoving(false);
  EXPECT_EQ(name.findChild<QLabel*>("dialogStopState")->text(), "A hand is connected.");
  name.close();
}

}  // namespace
}  // namespace palpate::gui::dialog_stop_test
