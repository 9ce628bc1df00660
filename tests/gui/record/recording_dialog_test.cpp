#include "gui/record/recording_dialog.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <atomic>
#include <latch>
#include <memory>

#include "gui/testing/fake_ask.h"
#include "gui/testing/layout_faults.h"
#include "testing/testing.h"

namespace palpate::gui::recording_dialog_test {
namespace {
namespace fs = std::filesystem;

class StillClock : public Clock {
 public:
  std::int64_t monotonicUs() const override { return 0; }
  // 2014-11-27 12:00 UTC: the same day wherever the machine stands (but for UTC+12 and more).
  std::int64_t wallUs() const override { return 1'417'089'600'000'000; }
};

class RecordingDialogTest : public ::testing::Test {
 protected:
  RecordingDialogTest() {
    given_.folder = QString::fromStdString(folder_.path().string());
    given_.operatorName = "Anna";
    given_.object = "foam ball";
    given_.notes = "first";
    given_.markLabels[4] = "";
    open();
  }
  void open(const QString& okText = "Start recording") {
    dialog_ = std::make_unique<RecordingDialog>(given_, okText, ask_, nullptr, clock_);
    dialog_->show();
    dialog_->activateWindow();
    dialog_->settle();
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = dialog_->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("no ") + name);
    return found;
  }
  void type(const char* field, const QString& text) {
    auto* edit = find<QLineEdit>(field);
    edit->setFocus();
    edit->selectAll();
    QTest::keyClick(edit, Qt::Key_Delete);
    QTest::keyClicks(edit, text);
    dialog_->settle();
  }
  QString nextName() { return find<QLabel>("recordingNextName")->accessibleName(); }
  QString place() { return find<QLabel>("recordingNextFolder")->accessibleName(); }
  QString problem() {
    auto* label = find<QLabel>("recordingProblem");
    return label->isVisible() ? label->text() : QString();
  }
  QPushButton* ok() { return find<QPushButton>("recordingOk"); }
  QAction* placeholder(const QString& text) {
    for (QAction* action : find<QPushButton>("recordingInsert")->menu()->actions())
      if (action->data() == text) return action;
    throw std::runtime_error("no such placeholder");
  }

  const testing::TemporaryFolder folder_;
  const StillClock clock_;
  RecordingSettings given_;
  FakeAsk ask_;
  std::unique_ptr<RecordingDialog> dialog_;
};

TEST_F(RecordingDialogTest, ShowsWhatIsGivenAndGivesItBack) {
  EXPECT_EQ(ok()->text(), "Start recording");
  const RecordingSettings back = dialog_->settings();
  EXPECT_EQ(back.folder, given_.folder);
  EXPECT_EQ(back.nameTemplate, given_.nameTemplate);
  EXPECT_EQ(back.operatorName, "Anna");
  EXPECT_EQ(back.object, "foam ball");
  EXPECT_EQ(back.notes, "first");
  EXPECT_TRUE(back.askEachTime);
  EXPECT_FALSE(back.withMcap);
  find<QCheckBox>("recordingMcap")->click();
  EXPECT_TRUE(dialog_->settings().withMcap);
  EXPECT_EQ(back.markLabels, given_.markLabels);
}

TEST_F(RecordingDialogTest, WhatIsTypedIsWhatIsSaid) {
  type("recordingOperator", "  Bert  Berg ");
  type("recordingObject", "steel cup");
  type("recordingTemplate", "{operator}-{object}-{run}");
  find<QPlainTextEdit>("recordingNotes")->setPlainText("two\nlines\n\n");
  find<QCheckBox>("recordingAsk")->click();
  find<QToolButton>("marksHeader")->click();
  type("markLabel0", "start");
  type("markLabel4", " lifted ");
  const RecordingSettings said = dialog_->settings();
  EXPECT_EQ(said.operatorName, "Bert Berg");
  EXPECT_EQ(said.object, "steel cup");
  EXPECT_EQ(said.nameTemplate, "{operator}-{object}-{run}");
  EXPECT_EQ(said.notes, "two\nlines");
  EXPECT_FALSE(said.askEachTime);
  EXPECT_EQ(said.markLabels[0], "start");
  EXPECT_EQ(said.markLabels[4], "lifted");
  EXPECT_EQ(said.markLabels[1], given_.markLabels[1]);
  EXPECT_EQ(nextName(), "Bert_Berg-steel_cup-001.palpate");
}

TEST_F(RecordingDialogTest, TheNextNameIsSeenWhileTyping) {
  EXPECT_EQ(nextName(), "2014-11-27_foam_ball_001.palpate");
  EXPECT_EQ(place(), "in " + given_.folder);
  type("recordingObject", "cup");
  EXPECT_EQ(nextName(), "2014-11-27_cup_001.palpate");
  EXPECT_FALSE(find<QLabel>("recordingProblem")->isVisible());
}

TEST_F(RecordingDialogTest, AFolderWithLittleSpaceSaysSo) {
  dialog_->freeBytes = [](const fs::path&) { return std::uint64_t{200'000}; };
  type("recordingObject", "cup");
  EXPECT_EQ(place(), "in " + given_.folder + ": only 0.2 MB free");
  dialog_->freeBytes = [](const fs::path&) { return std::uint64_t{65'000'000'000}; };
  type("recordingObject", "mug");
  EXPECT_EQ(place(), "in " + given_.folder);
}

// Window F13.
TEST_F(RecordingDialogTest, NeitherTypingNorStartNorLeavingWaitsForTheFolder) {
  const auto end = std::make_shared<std::latch>(1);
  const auto hangs = std::make_shared<std::atomic<bool>>(false);
  dialog_->freeBytes = [end, hangs](const fs::path&) {
    *hangs = true;
    end->wait();
    return std::optional<std::uint64_t>();
  };
  find<QLineEdit>("recordingObject")->setText("cup");
  EXPECT_EQ(nextName(), "2014-11-27_foam_ball_001.palpate") << "as long as nothing is known";
  QSignalSpy accepted(dialog_.get(), &QDialog::accepted);
  ok()->click();
  EXPECT_EQ(accepted.size(), 0) << "not before the folder has answered";
  ASSERT_TRUE(QTest::qWaitFor([&] { return hangs->load(); }, 20'000));
  dialog_.reset();
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1))) << "it still hangs";
  end->count_down();
  EXPECT_TRUE(Abandonable::awaitThreads(std::chrono::seconds(20)));
}

TEST_F(RecordingDialogTest, WhatNeverHappensIsSaidInWords) {
  for (const char* field : {"recordingSplitMinutes", "recordingSplitMb"})
    EXPECT_EQ(find<QAbstractSpinBox>(field)->text(), "never");
}

TEST_F(RecordingDialogTest, WhatOthersRecordMeanwhileIsCounted) {
  testing::writeFile(folder_ / "2014-11-27_foam_ball_001.palpate", "");
  EXPECT_TRUE(
      QTest::qWaitFor([this] { return nextName() == "2014-11-27_foam_ball_002.palpate"; }, 10'000));
}

TEST_F(RecordingDialogTest, AFolderThatIsntThereIsSaidToBeMade) {
  type("recordingFolder", given_.folder + "/new");
  EXPECT_EQ(place(), "in " + given_.folder + "/new, which will be created");
  EXPECT_TRUE(ok()->isEnabled());
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(RecordingDialogTest, AProblemIsSaidAndNothingCanStart) {
  QSignalSpy accepted(dialog_.get(), &QDialog::accepted);
  type("recordingTemplate", "{objekt}");
  EXPECT_TRUE(problem().contains("{objekt} isn't known; use {date}")) << problem().toStdString();
  EXPECT_FALSE(find<QLabel>("recordingNextName")->isVisible());
  EXPECT_FALSE(ok()->isEnabled());
  QTest::keyClick(find<QLineEdit>("recordingTemplate"), Qt::Key_Return);
  QTest::keyClick(find<QPlainTextEdit>("recordingNotes"), Qt::Key_Return, Qt::ControlModifier);
  dialog_->settle();
  EXPECT_EQ(accepted.size(), 0);
  EXPECT_TRUE(dialog_->isVisible());
  type("recordingTemplate", "{object}");
  EXPECT_EQ(problem(), "");
  EXPECT_TRUE(ok()->isEnabled());
  type("recordingFolder", "");
  EXPECT_TRUE(problem().contains("choose a folder"));
}

TEST_F(RecordingDialogTest, EnterStartsEscapeCancels) {
  QSignalSpy accepted(dialog_.get(), &QDialog::accepted);
  QTest::keyClick(find<QLineEdit>("recordingObject"), Qt::Key_Return);
  dialog_->settle();
  EXPECT_EQ(accepted.size(), 1);
  open();
  QSignalSpy rejected(dialog_.get(), &QDialog::rejected);
  QTest::keyClick(find<QLineEdit>("recordingObject"), Qt::Key_Escape);
  EXPECT_EQ(rejected.size(), 1);
}

TEST_F(RecordingDialogTest, ReturnPressesTheButtonThatHasTheFocus) {
  QSignalSpy accepted(dialog_.get(), &QDialog::accepted);
  QSignalSpy rejected(dialog_.get(), &QDialog::rejected);
  auto* cancel = find<QPushButton>("recordingCancel");
  cancel->setFocus();
  QTest::keyClick(cancel, Qt::Key_Return);
  EXPECT_EQ(accepted.size(), 0);
  EXPECT_EQ(rejected.size(), 1);
}

TEST_F(RecordingDialogTest, EnterInTheNotesIsANewLineWithCtrlItStarts) {
  QSignalSpy accepted(dialog_.get(), &QDialog::accepted);
  auto* notes = find<QPlainTextEdit>("recordingNotes");
  notes->setFocus();
  notes->moveCursor(QTextCursor::End);
  QTest::keyClick(notes, Qt::Key_Return);
  QTest::keyClicks(notes, "second");
  EXPECT_EQ(accepted.size(), 0);
  EXPECT_EQ(dialog_->settings().notes, "first\nsecond");
  QTest::keyClick(notes, Qt::Key_Return, Qt::ControlModifier);
  dialog_->settle();
  EXPECT_EQ(accepted.size(), 1);
}

TEST_F(RecordingDialogTest, PlaceholdersGoWhereTheCursorIsWithWhatJoinsThem) {
  auto* field = find<QLineEdit>("recordingTemplate");
  type("recordingTemplate", "{date}_{run}");
  field->setCursorPosition(7);  // before {run}
  placeholder("{object}")->trigger();
  EXPECT_EQ(field->text(), "{date}_{object}_{run}");
  field->setCursorPosition(static_cast<int>(field->text().size()));
  placeholder("{operator}")->trigger();
  EXPECT_EQ(field->text(), "{date}_{object}_{run}_{operator}");
  dialog_->settle();
  EXPECT_EQ(nextName(), "2014-11-27_foam_ball_001_Anna.palpate");
  // What stands there already isn't offered: twice would be refused.
  emit find<QPushButton>("recordingInsert")->menu()->aboutToShow();
  EXPECT_FALSE(placeholder("{date}")->isEnabled());
  EXPECT_TRUE(placeholder("{time}")->isEnabled());
}

TEST_F(RecordingDialogTest, BrowseBeginsWhereTheFolderIsOrWillBe) {
  type("recordingFolder", given_.folder + "/not/there");
  QTest::mouseClick(find<QPushButton>("recordingBrowse"), Qt::LeftButton);
  EXPECT_EQ(ask_.folders.began, QStringList(given_.folder));
  EXPECT_EQ(dialog_->settings().folder, given_.folder + "/not/there") << "cancelled";
  fs::create_directory(folder_ / "chosen");
  const QString answer = given_.folder + "/chosen";
  ask_.folders = {answer};
  QTest::mouseClick(find<QPushButton>("recordingBrowse"), Qt::LeftButton);
  EXPECT_EQ(dialog_->settings().folder, answer);
  dialog_->settle();
  EXPECT_EQ(place(), "in " + answer);
}

TEST_F(RecordingDialogTest, MarksUnfoldBelowAndFoldAgain) {
  auto* grid = find<QWidget>("marksGrid");
  auto* notes = find<QPlainTextEdit>("recordingNotes");
  EXPECT_FALSE(grid->isVisible());
  EXPECT_TRUE(find<QLabel>("marksSummary")->accessibleName().startsWith("1 contact · 2 slip"));
  EXPECT_FALSE(find<QLabel>("marksSummary")->accessibleName().contains("4"));
  const int folded = dialog_->height();
  const int notesHeight = notes->height();
  find<QToolButton>("marksHeader")->click();
  EXPECT_TRUE(grid->isVisible());
  EXPECT_GT(dialog_->height(), folded + 100);
  EXPECT_EQ(notes->height(), notesHeight);
  find<QToolButton>("marksHeader")->click();
  EXPECT_EQ(dialog_->height(), folded);
  EXPECT_EQ(notes->height(), notesHeight);
}

TEST_F(RecordingDialogTest, WhenItStopsAndSplitsIsSaidInOneLineAndGivenBack) {
  auto* summary = find<QLabel>("timingSummary");
  EXPECT_EQ(summary->accessibleName(), "until it is stopped, in one file");
  EXPECT_EQ(dialog_->settings().limits, RecordingLimits());
  find<QToolButton>("timingHeader")->click();
  find<QDoubleSpinBox>("recordingStopAfter")->setValue(30.0);
  find<QDoubleSpinBox>("recordingSplitMinutes")->setValue(10.0);
  find<QDoubleSpinBox>("recordingSplitMb")->setValue(500.0);
  const RecordingLimits limits{.stopAfterS = 30.0, .splitMinutes = 10.0, .splitMb = 500.0};
  EXPECT_EQ(dialog_->settings().limits, limits);
  find<QToolButton>("timingHeader")->click();
  EXPECT_EQ(summary->accessibleName(), "stops after 30 s, a new file every 10 min or 500 MB");
  given_.limits = limits;
  open();
  EXPECT_EQ(dialog_->settings().limits, limits);
}

TEST_F(RecordingDialogTest, CountdownAndContactAreSaidInOneLineAndGivenBack) {
  find<QToolButton>("timingHeader")->click();
  find<QSpinBox>("recordingCountdown")->setValue(5);
  find<QCheckBox>("recordingOnContact")->click();
  find<QDoubleSpinBox>("recordingContactThreshold")->setValue(250.0);
  find<QDoubleSpinBox>("recordingReleased")->setValue(1.5);
  given_ = dialog_->settings();
  EXPECT_EQ(given_.countdownS, 5);
  EXPECT_TRUE(given_.startOnContact);
  EXPECT_EQ(given_.contactThreshold, 250.0);
  EXPECT_EQ(given_.stopWithoutContactS, 1.5);
  EXPECT_EQ(find<QLabel>("timingSummary")->accessibleName(),
            "5 s countdown, begins when touched, stops untouched for 1.5 s");
  open();
  EXPECT_EQ(dialog_->settings().countdownS, 5);
  EXPECT_TRUE(dialog_->settings().startOnContact);
  EXPECT_EQ(dialog_->settings().stopWithoutContactS, 1.5);
}

TEST_F(RecordingDialogTest, TooShortALimitBecomesTheShortestOne) {
  find<QDoubleSpinBox>("recordingStopAfter")->setValue(0.01);
  find<QDoubleSpinBox>("recordingSplitMinutes")->setValue(0.01);
  EXPECT_EQ(dialog_->settings().limits.stopAfterS, RecordingLimits::kStopAfterS.minimum);
  EXPECT_EQ(dialog_->settings().limits.splitMinutes, RecordingLimits::kSplitMinutes.minimum);
}

TEST_F(RecordingDialogTest, OnASmallScreenTheFieldsAreScrolledAndTheButtonsStayWhole) {
  find<QToolButton>("timingHeader")->click();
  find<QToolButton>("marksHeader")->click();
  for (const QSize size : {QSize(580, 640), QSize(580, 400), QSize(1000, 500)}) {
    dialog_->resize(size);
    QTest::qWait(0);
    EXPECT_EQ(dialog_->size(), size);
    const QStringList faults = layoutFaults(*dialog_);
    EXPECT_TRUE(faults.isEmpty()) << faults.join("\n").toStdString();
    for (const char* name : {"recordingOk", "recordingCancel"}) {
      const auto* button = find<QPushButton>(name);
      EXPECT_EQ(button->visibleRegion().boundingRect().size(), button->size()) << name;
    }
  }
}

TEST_F(RecordingDialogTest, IsNoHigherThanTheScreen) {
  find<QToolButton>("timingHeader")->click();
  find<QToolButton>("marksHeader")->click();
  EXPECT_LE(dialog_->height(), dialog_->screen()->availableGeometry().height() - 40);
}

TEST_F(RecordingDialogTest, ALongNameFitsIntoTheDialog) {
  const int width = dialog_->width();
  type("recordingTemplate", QString(160, 'x'));
  type("recordingFolder", given_.folder + "/" + QString(200, 'y') + "/" + QString(200, 'z'));
  QTest::qWait(0);
  EXPECT_EQ(dialog_->width(), width);
  auto* label = find<QLabel>("recordingNextName");
  EXPECT_TRUE(label->text().contains(QChar(0x2026)));
  EXPECT_LE(label->fontMetrics().horizontalAdvance(label->text()), label->width());
  EXPECT_EQ(label->toolTip(), QString(160, 'x') + ".palpate");
}

}  // namespace
}  // namespace palpate::gui::recording_dialog_test
