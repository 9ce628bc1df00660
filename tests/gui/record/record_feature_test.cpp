// Recording over the bench: what is offered when one has ended.
#include "gui/record/record_feature.h"

#include <QAction>
#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "gui/record/countdown_strip.h"
#include "gui/record/plan_dialog.h"
#include "gui/widgets/offer_strip.h"
#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::record_feature_test {
namespace {

// While it lives there is neither a home folder nor one for temporary files.
class NoEmergencyFolder {
 public:
  NoEmergencyFolder() {
    for (const char* name : kNames) {
      before_.push_back(qgetenv(name));
      qputenv(name, "/no/such/folder");
    }
  }
  ~NoEmergencyFolder() {
    for (std::size_t i = 0; i < kNames.size(); ++i)
      if (before_[i].isNull())
        qunsetenv(kNames[i]);
      else
        qputenv(kNames[i], before_[i]);
  }
  NoEmergencyFolder(const NoEmergencyFolder&) = delete;
  NoEmergencyFolder& operator=(const NoEmergencyFolder&) = delete;

 private:
  static constexpr std::array<const char*, 2> kNames{"HOME", "TMPDIR"};
  std::vector<QByteArray> before_;
};

class RecordFeatureTest : public WindowStateTest {
 protected:
  RecordFeatureTest() : feature_(*windowState_, &actionsOf_) {}
  QString offered() { return qobject_cast<OfferStrip*>(feature_.strips().back().widget)->text(); }
  void endRecording(std::int64_t gaps = 0) {
    RecordingReport report;
    report.gaps = gaps;
    report.paths = {folder_ / "run_001.palpate"};
    report.frames = 412;
    report.complete = true;
    emit windowState_->live.recordingEnded(report);
  }
  RecordFeature feature_;
};

TEST_F(RecordFeatureTest, WhatWasRecordedIsOffered) {
  endRecording();
  EXPECT_TRUE(offered().startsWith("Recorded run_001.palpate")) << offered().toStdString();
  EXPECT_TRUE(windowState_->actions.at("openRecorded")->isEnabled());
}

// "Renamed: .." would otherwise stay over the next hand and the next recording.
TEST_F(RecordFeatureTest, TheLineAboutTheLastRecordingGoesWhenSomethingNewBegins) {
  QWidget* strip = feature_.strips().back().widget;
  for (const auto begins : {&LiveController::recordingStarted, &LiveController::sourceOpened}) {
    endRecording();
    emit feature_.lastTake().renamed(folder_ / "run_001.palpate", folder_ / "good.palpate");
    ASSERT_EQ(offered(), "Renamed: good.palpate");
    ASSERT_FALSE(strip->isHidden());
    emit(windowState_->live.*begins)();
    EXPECT_TRUE(strip->isHidden());
  }
}

TEST_F(RecordFeatureTest, ThatNothingIsLostIsNotSaidBesideAGap) {
  endRecording();
  EXPECT_TRUE(offered().endsWith("nothing lost")) << offered().toStdString();
  endRecording(1);
  EXPECT_TRUE(offered().endsWith("1 gap of 0.0 s in which no frame arrived"))
      << offered().toStdString();
}

// The chart and `palpate info` tell the same length.
TEST_F(RecordFeatureTest, SaysHowLongTheGapsAre) {
  RecordingReport report;
  report.paths = {folder_ / "run_001.palpate"};
  report.frames = 101;
  report.rateHz = 10.0;
  report.durationS = 12.5;
  report.gaps = 2;
  report.gapsS = 4.42;
  emit windowState_->live.recordingEnded(report);
  EXPECT_TRUE(offered().endsWith("2 gaps of 4.4 s in which no frame arrived"))
      << offered().toStdString();
}

TEST_F(RecordFeatureTest, ATakeWhoseHandWasGoneAtItsEndLacksSomething) {
  RecordingReport report;
  report.paths = {folder_ / "run_001.palpate"};
  report.frames = 627;
  report.openGapS = 8.04;
  emit windowState_->live.recordingEnded(report);
  EXPECT_TRUE(offered().endsWith("no frame came in its last 8.0 s")) << offered().toStdString();
}

// What the user stopped while it waited for contact is no alarm.
TEST_F(RecordFeatureTest, StoppedBeforeAContactIsANoticeAndNoFailure) {
  QSignalSpy failed(&windowState_->messages, &Messages::failed);
  RecordingReport report;
  report.nothingTouched = true;
  report.complete = false;
  report.message = "nothing was touched";
  emit windowState_->live.recordingEnded(report);
  EXPECT_EQ(failed.count(), 0);
  EXPECT_TRUE(windowState_->messages.flashed().contains("nothing was recorded"));
  report.nothingTouched = false;
  report.message = "no frame arrived";
  emit windowState_->live.recordingEnded(report);
  ASSERT_EQ(failed.count(), 1);
  EXPECT_EQ(failed[0][1].toString(), "Nothing was recorded: no frame arrived");
}

TEST_F(RecordFeatureTest, WhatTheConnectionLostIsSaid) {
  RecordingReport report;
  report.paths = {folder_ / "run_001.palpate"};
  report.frames = 316;
  report.counters = {{"lost", 6}, {"bad_checksums", 20}, {"motion_bad_checksums", 4}};
  emit windowState_->live.recordingEnded(report);
  EXPECT_TRUE(offered().endsWith("6 frames lost on the way, 24 bad checksums"))
      << offered().toStdString();
  EXPECT_TRUE(feature_.strips().back().widget->property("warning").toBool());
  endRecording();
  EXPECT_FALSE(feature_.strips().back().widget->property("warning").toBool());
}

TEST_F(RecordFeatureTest, WhatAStreamRefusedOrHadOutOfRangeIsSaid) {
  for (const auto& [name, said] :
       {std::pair("suspect", "1 refused"),
        std::pair("out_of_range", "1 frame with values outside the hand's range")}) {
    RecordingReport report;
    report.paths = {folder_ / "run_001.palpate"};
    report.frames = 316;
    report.complete = true;
    report.counters = {{name, 1}};
    emit windowState_->live.recordingEnded(report);
    EXPECT_TRUE(offered().endsWith(said)) << offered().toStdString();
    EXPECT_TRUE(feature_.strips().back().widget->property("warning").toBool()) << name;
  }
}

// The plan knew it by the part that is in the trash.
TEST_F(RecordFeatureTest, ATakeThatIsDiscardedInTwoStepsCountsNoLonger) {
  namespace fs = std::filesystem;
  const fs::path first = folder_ / "run_001.palpate", second = folder_ / "run_001_2.palpate";
  for (const fs::path& part : {first, second}) testing::writeFile(part, "");
  feature_.plan().addRow({.object = "ball"});
  feature_.plan().begin(std::nullopt);
  RecordingReport report;
  report.paths = {first, second};
  emit windowState_->live.recordingEnded(report);
  feature_.plan().settle();
  QCoreApplication::processEvents();
  ask_.choices = {"Discard", QString(), "Discard"};
  feature_.lastTake().moveToTrash = [&](const QString& path) {
    return (ask_.choices.asked.size() > 2 || !path.endsWith("_2.palpate")) && QFile::remove(path);
  };
  feature_.lastTake().discard();
  ASSERT_EQ(feature_.plan().plan().rows()[0].takes.size(), 1u);
  EXPECT_EQ(feature_.plan().plan().rows()[0].takes[0].file, second);
  EXPECT_TRUE(offered().startsWith("run_001_2.palpate: ")) << offered().toStdString();
  feature_.lastTake().discard();
  EXPECT_TRUE(feature_.plan().plan().rows()[0].takes.empty());
}

// The recording of the plan could not begin; that of another program is none of it.
TEST_F(RecordFeatureTest, ARecordingThatIsNoneOfThePlanIsNotSaidToBeMissingInIt) {
  connectEmulated();
  RecordingSettings settings;
  settings.folder = QString::fromStdString(folder_.path().string());
  saveRecordingSettings(settings, windowState_->settings);
  feature_.plan().addRow({.object = "ball"});
  feature_.plan().setFollowed(true);
  windowState_->actions.at("record")->trigger();
  emit windowState_->live.recordingFailed("the disk is full");
  endRecording();
  EXPECT_FALSE(offered().contains("not counted")) << offered().toStdString();
  disconnect();
}

TEST_F(RecordFeatureTest, AFileIsNamedOnce) {
  QSignalSpy failed(&windowState_->messages, &Messages::failed);
  RecordingReport report;
  report.paths = {folder_ / "run_001.palpate", folder_ / "other" / "run_001.palpate"};
  report.frames = 316;
  report.complete = false;
  report.message = "run_001.palpate could not be finished in /full, where it was begun";
  emit windowState_->live.recordingEnded(report);
  ASSERT_EQ(failed.count(), 1);
  EXPECT_EQ(failed[0][1].toString(), QString::fromStdString(report.message));
}

TEST_F(RecordFeatureTest, TheLastRecordingCanBeRenamedAndDiscarded) {
  const auto enabled = [this](const char* action) {
    return windowState_->actions.at(action)->isEnabled();
  };
  EXPECT_FALSE(enabled("renameRecorded"));
  EXPECT_FALSE(enabled("discardRecorded"));
  endRecording();
  EXPECT_TRUE(enabled("renameRecorded"));
  EXPECT_TRUE(enabled("discardRecorded"));
  const auto buttons = feature_.strips().back().widget->findChildren<QPushButton*>("offerOther");
  ASSERT_EQ(buttons.size(), 2);
  EXPECT_EQ(buttons[0]->text(), "Rename…");
  EXPECT_EQ(buttons[1]->text(), "Discard…");
}

// The dialogue shows what the plan gives to the next recording; it isn't kept for others.
TEST_F(RecordFeatureTest, TheSettingsShowWhatThePlanGives) {
  windowState_->prompts.recording = [](RecordingSettings settings, const QString&) {
    settings.object = "box";
    return settings;
  };
  windowState_->actions.at("recordingSettings")->trigger();
  feature_.plan().addRow({.object = "ball", .run = "left", .repetitions = 3});
  feature_.plan().setFollowed(true);
  RecordingSettings seen;
  windowState_->prompts.recording = [&seen](RecordingSettings settings, const QString&) {
    seen = settings;
    settings.operatorName = "Ada";
    return settings;
  };
  windowState_->actions.at("recordingSettings")->trigger();
  EXPECT_EQ(seen.object, "ball");
  EXPECT_EQ(seen.run, "left");
  EXPECT_EQ(seen.repetition, "1 of 3");
  const RecordingSettings kept = loadRecordingSettings(windowState_->settings);
  EXPECT_EQ(kept.operatorName, "Ada");
  EXPECT_EQ(kept.object, "box");
}

// Repeated in the window of the plan: the question above the views has its answer.
TEST_F(RecordFeatureTest, TheQuestionAboutATakeGoesWhenItIsRepeatedElsewhere) {
  feature_.plan().addRow({.object = "ball", .repetitions = 2});
  feature_.plan().setFollowed(true);
  feature_.plan().begin(std::nullopt);
  endRecording();
  emit feature_.plan().checked(folder_ / "run_001.palpate", "nothing was touched");
  QWidget* strip = feature_.strips().back().widget;
  ASSERT_TRUE(offered().contains("Repeat it?")) << offered().toStdString();
  EXPECT_FALSE(strip->isHidden());
  EXPECT_TRUE(strip->property("warning").toBool());
  feature_.plan().reject(folder_ / "run_001.palpate");
  EXPECT_TRUE(strip->isHidden());
}

// The window of the plan may cover the line above the views.
TEST_F(RecordFeatureTest, ThePlanAsksAboutABadTakeAndItCountsOnceItIsKept) {
  feature_.plan().addRow({.object = "ball", .repetitions = 2});
  windowState_->actions.at("recordingPlan")->trigger();
  auto* dialog = actionsOf_.findChild<PlanDialog*>();
  ASSERT_TRUE(dialog);
  const auto* question = &dialog->question();
  EXPECT_TRUE(question->isHidden());
  feature_.plan().begin(std::nullopt);
  endRecording();
  feature_.plan().settle();
  ASSERT_FALSE(question->isHidden());
  QCoreApplication::processEvents();  // buttons of a visible line are shown then
  EXPECT_TRUE(question->text().startsWith("run_001.palpate: can't be checked"));
  EXPECT_TRUE(question->text().endsWith("Repeat it?")) << question->text().toStdString();
  QStringList buttons{question->findChild<QPushButton*>("offerAccept")->text()};
  for (const QPushButton* each : question->findChildren<QPushButton*>("offerOther"))
    if (!each->isHidden()) buttons << each->text();
  EXPECT_EQ(buttons, QStringList({"Repeat", "Keep", "Discard…"}));
  EXPECT_EQ(feature_.plan().progressText(), "0 of 2");
  question->findChildren<QPushButton*>("offerOther").front()->click();
  EXPECT_EQ(feature_.plan().progressText(), "1 of 2");
  EXPECT_TRUE(question->isHidden());
  EXPECT_TRUE(feature_.strips().back().widget->isHidden()) << "decided there, too";
}

// As after a restart: another take was not recorded in this session.
TEST_F(RecordFeatureTest, ATakeToBeDecidedCanBeDiscardedAfterARestartAndNothingBesideIt) {
  namespace fs = std::filesystem;
  const fs::path take = folder_ / "ball.palpate", other = folder_ / "ball_002.palpate";
  for (const fs::path& each : {take, other}) testing::writeFile(each, "");
  feature_.plan().addRow({.object = "ball", .repetitions = 2});
  feature_.plan().begin(std::nullopt);
  RecordingReport report;
  report.paths = {take};
  feature_.plan().end(report);
  feature_.plan().settle();
  windowState_->actions.at("recordingPlan")->trigger();
  QCoreApplication::processEvents();
  auto& question = actionsOf_.findChild<PlanDialog*>()->question();
  const auto others = question.findChildren<QPushButton*>("offerOther");
  ASSERT_EQ(others.size(), 2);
  ASSERT_EQ(others[1]->text(), "Discard…");
  ask_.choices = {"Discard"};
  QStringList trashed;
  feature_.lastTake().moveToTrash = [&](const QString& path) {
    trashed << path;
    return true;
  };
  others[1]->click();
  EXPECT_EQ(trashed, QStringList(QString::fromStdString(take.string())));
  EXPECT_FALSE(feature_.plan().undecided());
}

TEST_F(RecordFeatureTest, ARecordingBesideThePlanIsSaidToBeOne) {
  connectEmulated();
  feature_.plan().addRow({.object = "ball", .repetitions = 1});
  feature_.plan().setFollowed(true);
  feature_.plan().begin(std::nullopt);
  endRecording();
  feature_.plan().settle();  // there is no such file: to be decided
  ASSERT_TRUE(feature_.plan().undecided());
  QString button;
  windowState_->prompts.recording = [&](const RecordingSettings&, const QString& said) {
    button = said;
    return std::optional<RecordingSettings>();
  };
  windowState_->actions.at("record")->trigger();
  EXPECT_EQ(button, "Record outside of the plan");
  disconnect();
}

TEST_F(RecordFeatureTest, KeysOfTheWindowWorkInThePlanExceptThoseOfItsTable) {
  QAction* open = windowState_->actions.make("openHand", "Hand", "Open", {key("Ctrl+Alt+O")});
  QAction* theme = windowState_->actions.make("nextTheme", "View", "Theme", {key("Ctrl+T")});
  QAction* newest = windowState_->actions.make("liveNewest", "Hand", "Newest", {key("End")});
  QAction* erase = windowState_->actions.make("removeEvent", "Edit", "Delete", {key("Del")});
  QAction* smooth = windowState_->actions.make("smooth", "View", "Smooth", {key("I")});
  QAction* close = windowState_->actions.make("close", "File", "Close", {key("Ctrl+W")});
  windowState_->actions.at("recordingPlan")->trigger();
  const QList<QAction*> keys = actionsOf_.findChild<PlanDialog*>()->actions();
  for (QAction* each : {open,
                        theme,
                        windowState_->actions.at("mark"),
                        windowState_->actions.at("record"),
                        windowState_->actions.at("recordingSettings")})
    EXPECT_TRUE(keys.contains(each)) << each->text().toStdString();
  for (QAction* each : {newest, erase, smooth, close})
    EXPECT_FALSE(keys.contains(each)) << each->text().toStdString();
}

TEST_F(RecordFeatureTest, EscapeInThePlanEndsTheCountdownAndThenClosesThePlan) {
  connectEmulated();
  windowState_->prompts.recording = [this](RecordingSettings settings, const QString&) {
    settings.folder = QString::fromStdString(folder_.path().string());
    settings.countdownS = 30;
    return settings;
  };
  windowState_->actions.at("recordingPlan")->trigger();
  auto* dialog = actionsOf_.findChild<PlanDialog*>();
  windowState_->actions.at("record")->trigger();
  ASSERT_TRUE(feature_.countdown().running());
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_FALSE(feature_.countdown().running());
  EXPECT_TRUE(dialog->isVisible());
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_FALSE(dialog->isVisible());
  disconnect();
}

TEST_F(RecordFeatureTest, ACountdownIsSeenAndRecordOrEscapeCancelsIt) {
  connectEmulated();
  QWidget* strip = feature_.strips().front().widget;
  windowState_->prompts.recording = [this](RecordingSettings settings, const QString&) {
    settings.folder = QString::fromStdString(folder_.path().string());
    settings.countdownS = 30;
    return settings;
  };
  QAction* record = windowState_->actions.at("record");
  record->trigger();
  EXPECT_TRUE(feature_.countdown().running());
  EXPECT_FALSE(strip->isHidden());
  EXPECT_EQ(strip->findChild<QLabel*>("countdownDigits")->text(), "30");
  EXPECT_EQ(record->iconText(), " in 30 s");
  feature_.countdown().tick();
  EXPECT_EQ(record->iconText(), " in 29 s");
  record->trigger();
  EXPECT_FALSE(feature_.countdown().running());
  EXPECT_TRUE(strip->isHidden());
  record->trigger();
  windowState_->escapeHandler.press();
  EXPECT_FALSE(feature_.countdown().running());
  record->trigger();
  emit windowState_->handCommands.stopped();
  EXPECT_FALSE(feature_.countdown().running()) << "Stop cancels, too";
  EXPECT_FALSE(windowState_->live.recording());
  disconnect();
}

TEST_F(RecordFeatureTest, AfterTheCountdownItRecordsAndNotesAreOfOneRecording) {
  connectEmulated();
  windowState_->prompts.recording = [this](RecordingSettings settings, const QString&) {
    settings.folder = QString::fromStdString(folder_.path().string());
    settings.countdownS = 1;
    settings.notes = "of this one";
    return settings;
  };
  windowState_->actions.at("record")->trigger();
  feature_.countdown().tick();
  EXPECT_TRUE(windowState_->live.recording());
  EXPECT_EQ(loadRecordingSettings(windowState_->settings).notes, "");
  EXPECT_EQ(loadRecordingSettings(windowState_->settings).countdownS, 1);
  disconnect();
}

TEST_F(RecordFeatureTest, AHandThatGoesCancelsTheCountdown) {
  connectEmulated();
  windowState_->prompts.recording = [](RecordingSettings settings, const QString&) {
    settings.countdownS = 30;
    return settings;
  };
  windowState_->actions.at("record")->trigger();
  disconnect();
  EXPECT_FALSE(feature_.countdown().running());
}

// One that reached its own limit offers the same as one that the user stops.
TEST_F(RecordFeatureTest, OneThatEndsByItselfOnAFailingDiskOffersAnotherFolder) {
  namespace fs = std::filesystem;
  const fs::path here = folder_ / "here", other = folder_ / "other";
  fs::create_directory(here);
  fs::create_directory(other);
  const NoEmergencyFolder nowhere;
  connectEmulated();
  windowState_->prompts.recording = [&](RecordingSettings settings, const QString&) {
    settings.folder = QString::fromStdString(here.string());
    settings.limits.stopAfterS = 2.0;
    return settings;
  };
  std::optional<RecordingReport> report;
  QObject::connect(&windowState_->live,
                   &LiveController::recordingEnded,
                   &feature_,
                   [&](const RecordingReport& ended) { report = ended; });
  LiveController& live = windowState_->live;
  windowState_->actions.at("record")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.health().recorder.framesOnDisk > 0; }, 20'000));
  fs::rename(here, folder_ / "there");
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.health().recorder.waitsForDisk; }, 20'000));
  EXPECT_TRUE(offered().startsWith("The recording has reached its end, but can't be written"))
      << offered().toStdString();
  bool asked = false;
  windowState_->prompts.endRecording = [&](UserPrompts::Ending ending) {
    EXPECT_EQ(ending, UserPrompts::Ending::kStop);
    asked = true;
    live.continueRecordingIn(other);
    return true;
  };
  feature_.strips().back().widget->findChild<QPushButton*>("offerAccept")->click();
  EXPECT_TRUE(asked);
  ASSERT_TRUE(QTest::qWaitFor([&] { return report.has_value(); }, 20'000));
  EXPECT_EQ(report->lost, 0);
  ASSERT_EQ(report->paths.size(), 1u);
  EXPECT_EQ(report->paths[0].parent_path(), other);
  disconnect();
}

// Seen and heard while it records, and told with its true name at the end.
TEST_F(RecordFeatureTest, OneWhoseFileIsReplacedSaysWhereItIs) {
  namespace fs = std::filesystem;
  connectEmulated();
  std::optional<RecordingReport> report;
  QObject::connect(&windowState_->live,
                   &LiveController::recordingEnded,
                   &feature_,
                   [&](const RecordingReport& ended) { report = ended; });
  windowState_->prompts.recording = [&](RecordingSettings settings, const QString&) {
    settings.folder = QString::fromStdString(folder_.path().string());
    return settings;
  };
  LiveController& live = windowState_->live;
  windowState_->actions.at("record")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return live.health().recorder.framesOnDisk > 0; }, 20'000));
  const fs::path path = live.health().recorder.path;
  fs::rename(path, folder_ / "mine.palpate");
  testing::writeFile(path, "somebody's");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !live.health().recorder.relocation.empty(); }, 20'000));
  EXPECT_TRUE(std::any_of(live.health().alarms.begin(),
                          live.health().alarms.end(),
                          [](const Alarm& alarm) { return alarm.kind == AlarmKind::kWriteError; }));
  live.stopRecording();
  ASSERT_TRUE(QTest::qWaitFor([&] { return report.has_value(); }, 20'000));
  ASSERT_EQ(report->paths.size(), 1u);
  EXPECT_EQ(report->paths[0].filename().string(), path.stem().string() + "_continued.palpate");
  EXPECT_FALSE(report->complete);
  EXPECT_NE(report->message.find(report->paths[0].string()), std::string::npos);
  EXPECT_TRUE(offered().startsWith("Recorded " +
                                   QString::fromStdString(report->paths[0].filename().string())))
      << offered().toStdString();
  EXPECT_EQ(testing::readFile(path), "somebody's");
  disconnect();
}

TEST_F(RecordFeatureTest, AWindowThatClosesOffersNothingAnyMore) {
  windowState_->messages.announce("Closing");
  endRecording();
  EXPECT_EQ(offered(), "Closing");
}

}  // namespace
}  // namespace palpate::gui::record_feature_test
