#include "gui/record/plan_controller.h"

#include <QSignalSpy>

#include <palpate/core/error.h>
#include <palpate/recording/recording.h>

#include "gui/testing/held_readings.h"
#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::plan_controller_test {
namespace {
namespace fs = std::filesystem;

class PlanControllerTest : public ::testing::Test {
 protected:
  PlanControllerTest() {
    controller_.addRow({.object = "ball", .run = "left", .repetitions = 2, .notes = "slowly"});
    controller_.addRow({.object = "cup"});
    QObject::connect(&controller_,
                     &PlanController::checked,
                     &controller_,
                     [this](const fs::path&, const QString& problem) { checked_ << problem; });
  }
  // A take that was recorded: of frames in which something is touched for a second, or not.
  RecordingReport recorded(const std::string& name) {
    RecordingReport report;
    report.paths = {folder_ / name};
    saveRecording(twentyFrames(), {}, report.paths.front());
    return report;
  }
  std::string refusal(const std::string& csv) {
    testing::writeFile(folder_ / "plan.csv", csv);
    return refusalOf(folder_ / "plan.csv");
  }
  std::string refusalOf(const std::filesystem::path& path) {
    QSignalSpy imported(&controller_, &PlanController::imported);
    controller_.importCsv(path);
    controller_.settle();
    return imported.count() == 1 ? imported[0][0].toString().toStdString() : "no answer";
  }

  const testing::TemporaryFolder folder_;
  QSettings settings_{QString::fromStdString((folder_ / "p.ini").string()), QSettings::IniFormat};
  PlanController controller_{settings_};
  QStringList checked_;
};

TEST_F(PlanControllerTest, OnlyAFollowedPlanNamesTheNextRecording) {
  RecordingSettings last;
  last.operatorName = "Ada";
  EXPECT_FALSE(controller_.nextSettings(last));
  controller_.setFollowed(true);
  const auto next = controller_.nextSettings(last);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->object, "ball");
  EXPECT_EQ(next->run, "left");
  EXPECT_EQ(next->repetition, "1 of 2");
  EXPECT_EQ(next->notes, "slowly");
  EXPECT_EQ(next->operatorName, "Ada");
  const RecordingOptions options = recordingOptions(*next, folder_ / "a.palpate");
  EXPECT_EQ(options.meta.at("run"), "left");
  EXPECT_EQ(options.meta.at("repetition"), "1 of 2");
}

TEST_F(PlanControllerTest, ATakeIsCheckedCountedAndRejected) {
  controller_.setFollowed(true);
  EXPECT_EQ(controller_.progressText(), "0 of 3");
  EXPECT_EQ(controller_.nextText(), "next: ball, left, 1 of 2");
  // Twenty frames, 50 ms apart: 0.95 s.
  controller_.begin(2.0);
  EXPECT_EQ(controller_.nextText(), "now: ball, left, 1 of 2") << "while it is recorded";
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  EXPECT_EQ(controller_.progressText(), "0 of 3") << "nobody has decided yet";
  EXPECT_EQ(controller_.nextText(), "next: ball, left, 2 of 2; 1 take is to be decided");
  EXPECT_EQ(controller_.undecided(), folder_ / "a.palpate");
  ASSERT_EQ(checked_.size(), 1);
  EXPECT_TRUE(checked_[0].contains("long, not 2.0 s")) << checked_[0].toStdString();
  EXPECT_EQ(controller_.plan().rows()[0].takes[0].problem, checked_[0].toStdString());
  EXPECT_EQ(controller_.lastTake(), folder_ / "a.palpate");
  controller_.reject(folder_ / "a.palpate");
  EXPECT_EQ(controller_.progressText(), "0 of 3");
  EXPECT_FALSE(controller_.lastTake());
}

TEST_F(PlanControllerTest, ABadTakeThatIsKeptCounts) {
  controller_.begin(2.0);
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  controller_.keep(folder_ / "a.palpate");
  EXPECT_EQ(controller_.progressText(), "1 of 3");
  EXPECT_EQ(controller_.nextText(), "next: ball, left, 2 of 2");
  EXPECT_FALSE(controller_.undecided());
}

TEST_F(PlanControllerTest, TheLastTakeIsKnownAfterARestart) {
  controller_.begin(0.0);
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  {
    PlanController again(settings_);
    ASSERT_EQ(again.lastTake(), folder_ / "a.palpate");
    again.reject(*again.lastTake());
    EXPECT_EQ(again.progressText(), "0 of 3");
  }
  EXPECT_FALSE(PlanController(settings_).lastTake()) << "it was repeated";
}

// Settings of an earlier version don't name the last take.
TEST_F(PlanControllerTest, TheLastTakeIsTheLowestOfThePlanWhereNothingElseIsKnown) {
  controller_.begin(0.0);
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  settings_.remove("recording/plan_last_take");
  EXPECT_EQ(PlanController(settings_).lastTake(), folder_ / "a.palpate");
}

TEST_F(PlanControllerTest, TheLimitsOfTheCheckAreSetAndKept) {
  TakeCheckOptions limits;
  limits.leastS = 3.0;
  limits.mostLost = 4;
  limits.mostSaturated = 0.5;
  limits.leastQuality = 0.25;
  limits.contact.taxels = 1000;
  controller_.setLimits(limits);
  EXPECT_EQ(PlanController(settings_).limits(), limits);
  controller_.begin(std::nullopt);
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  ASSERT_EQ(checked_.size(), 1);
  EXPECT_TRUE(checked_[0].contains("nothing was touched")) << "by a thousand taxels";
  EXPECT_TRUE(checked_[0].contains("long, not 3.0 s")) << checked_[0].toStdString();
  EXPECT_TRUE(checked_[0].contains("no grasp")) << checked_[0].toStdString();
  settings_.setValue("recording/plan_limits/most_saturated", 7.0);
  EXPECT_EQ(PlanController(settings_).limits(), TakeCheckOptions()) << "out of range";
}

TEST_F(PlanControllerTest, ARecordingThatIsNotOfThePlanIsNotCounted) {
  controller_.end(recorded("a.palpate"));
  EXPECT_EQ(controller_.progressText(), "0 of 3");
  controller_.begin(1.0);
  controller_.end({});
  controller_.end(recorded("b.palpate"));
  EXPECT_EQ(controller_.progressText(), "0 of 3") << "the planned one was never begun";
}

// During the countdown of a take of "cup" an earlier take is rejected, so that "ball" would be
// next.
TEST_F(PlanControllerTest, AHeldTakeIsBookedOnItsRowWhateverIsEditedMeanwhile) {
  controller_.setFollowed(true);
  for (const char* name : {"a.palpate", "b.palpate"}) {
    controller_.begin(0.0);
    controller_.end(recorded(name));
    controller_.settle();
    controller_.keep(folder_ / name);
  }
  controller_.hold();
  EXPECT_EQ(controller_.nextText(), "now: cup");
  controller_.reject(folder_ / "a.palpate");
  controller_.setRow(1, {.object = "mug"});
  EXPECT_EQ(controller_.nextSettings({})->object, "mug");
  controller_.removeRow(0);
  controller_.begin(0.0);
  controller_.end(recorded("c.palpate"));
  ASSERT_EQ(controller_.plan().rows().size(), 1u);
  ASSERT_EQ(controller_.plan().rows()[0].takes.size(), 1u);
  EXPECT_EQ(controller_.plan().rows()[0].takes[0].file, folder_ / "c.palpate");
  controller_.settle();
}

TEST_F(PlanControllerTest, ATakeThatWasNotBegunIsHeldNoLonger) {
  controller_.hold();
  EXPECT_TRUE(controller_.holds());
  controller_.release();
  EXPECT_FALSE(controller_.holds());
  controller_.hold();
  controller_.removeRow(0);
  EXPECT_FALSE(controller_.holds()) << "its row is gone";
  controller_.end(recorded("a.palpate"));
  EXPECT_EQ(controller_.progressText(), "0 of 1");
}

TEST_F(PlanControllerTest, LostFramesAreAProblem) {
  controller_.begin(0.0);
  RecordingReport report = recorded("a.palpate");
  report.counters = {{"lost", 6}};
  controller_.end(report);
  controller_.settle();
  ASSERT_EQ(checked_.size(), 1);
  EXPECT_TRUE(checked_[0].contains("6 frames lost")) << checked_[0].toStdString();
}

TEST_F(PlanControllerTest, AnEndWithoutFramesIsAProblem) {
  controller_.begin(0.0);
  RecordingReport report = recorded("a.palpate");
  report.openGapS = 8.04;
  controller_.end(report);
  controller_.settle();
  ASSERT_EQ(checked_.size(), 1);
  EXPECT_TRUE(checked_[0].contains("no frame came in its last 8.0 s")) << checked_[0].toStdString();
}

TEST_F(PlanControllerTest, IsRememberedAfterARestart) {
  controller_.setFollowed(true);
  controller_.begin(0.0);
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  controller_.keep(folder_ / "a.palpate");
  const PlanController again(settings_);
  EXPECT_TRUE(again.followed());
  EXPECT_EQ(again.plan(), controller_.plan());
  EXPECT_EQ(again.progressText(), "1 of 3");
  settings_.setValue("recording/plan", "{nonsense");
  EXPECT_TRUE(PlanController(settings_).plan().rows().empty());
}

TEST_F(PlanControllerTest, WhetherItIsFollowedIsInDoubtInANewSessionAndWithAnotherHand) {
  controller_.setFollowed(true);
  EXPECT_EQ(controller_.doubt("a"), "");
  EXPECT_EQ(controller_.doubt("b"), "") << "it was followed before there was a hand";
  controller_.followWith("a");
  EXPECT_EQ(controller_.doubt("a"), "");
  EXPECT_EQ(controller_.doubt("b"), "with another hand");
  controller_.setFollowed(true);
  EXPECT_EQ(controller_.doubt("b"), "") << "followed anew";
  PlanController again(settings_);
  EXPECT_EQ(again.doubt("a"), "in an earlier session");
  again.followWith("a");
  EXPECT_EQ(again.doubt("a"), "");
}

TEST_F(PlanControllerTest, ATableReplacesThePlanOrChangesNothing) {
  const RecordingPlan before = controller_.plan();
  EXPECT_EQ(refusal("object,repetitions\nball,x\n,2\n"),
            "plan.csv: line 2, repetitions: 'x' is not a whole number, and 1 more problem; the "
            "plan is as it was");
  EXPECT_EQ(refusal("object\n"), "plan.csv: has no rows; the plan is as it was");
  EXPECT_NE(refusal("nothing\n1\n").find("must name the column object"), std::string::npos);
  std::string many = "object,repetitions\n";
  for (int i = 0; i < 200; ++i) many += "ball,x\n";
  EXPECT_EQ(refusal(many),
            "plan.csv: more than 100 problems, the first: line 2, repetitions: 'x' is not a whole "
            "number; the plan is as it was");
  EXPECT_NE(refusalOf(folder_ / "none.csv"), "");
  EXPECT_EQ(controller_.plan(), before);
  EXPECT_EQ(refusal("object,repetitions\npen,4\n"), "");
  EXPECT_EQ(controller_.progressText(), "0 of 4");
  controller_.exportCsv(folder_ / "out.csv");
  EXPECT_EQ(testing::readFile(folder_ / "out.csv"),
            "object,run,repetitions,notes,done\npen,,4,,0\n");
}

TEST_F(PlanControllerTest, ATableDoesNotReplaceAPlanThatChangedOrIsBeingRecorded) {
  testing::writeFile(folder_ / "plan.csv", "object\npen\n");
  QSignalSpy imported(&controller_, &PlanController::imported);
  {
    HeldReadings held;
    controller_.importCsv(folder_ / "plan.csv");
    EXPECT_TRUE(controller_.importing());
    controller_.addRow({.object = "late"});
  }
  controller_.settle();
  EXPECT_FALSE(controller_.importing());
  ASSERT_EQ(controller_.plan().rows().size(), 3u);
  EXPECT_EQ(controller_.plan().rows().back().object, "late");
  ASSERT_EQ(imported.size(), 1);
  EXPECT_EQ(imported[0][0].toString(), "plan.csv: not imported: the plan has since changed");
  {
    HeldReadings held;
    controller_.importCsv(folder_ / "plan.csv");
    controller_.begin(0.0);
  }
  controller_.settle();
  EXPECT_EQ(controller_.plan().rows().size(), 3u);
  ASSERT_EQ(imported.size(), 2);
  EXPECT_EQ(imported[1][0].toString(),
            "plan.csv: not imported: a take of the plan is being recorded");
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  ASSERT_EQ(controller_.plan().rows()[0].takes.size(), 1u) << "the take is one of its row";
  controller_.keep(folder_ / "a.palpate");
  EXPECT_EQ(controller_.progressText(), "1 of 4");
}

TEST_F(PlanControllerTest, RenamedAndDiscardedTakesAreFollowed) {
  controller_.begin(0.0);
  controller_.end(recorded("a.palpate"));
  controller_.settle();
  controller_.rename(folder_ / "a.palpate", folder_ / "b.palpate");
  EXPECT_EQ(controller_.lastTake(), folder_ / "b.palpate");
  controller_.forget(folder_ / "b.palpate");
  EXPECT_EQ(controller_.progressText(), "0 of 3");
}

TEST_F(PlanControllerTest, ARowThatGoesWhileItIsRecordedIsNotCounted) {
  controller_.begin(0.0);
  controller_.removeRow(0);
  controller_.end(recorded("a.palpate"));
  EXPECT_EQ(controller_.progressText(), "0 of 1");
}

}  // namespace
}  // namespace palpate::gui::plan_controller_test
