// What is shown is seen through the chain, and each change of it tells once.
#include "gui/bench/filtering.h"

#include <QSignalSpy>

#include "gui/bench/bench_fixture.h"

namespace palpate::gui::filtering_test {
namespace {

class FilteringTest : public BenchTest {
 protected:
  FilteringTest() : filtering_(bench_->filtering) {}
  void setRecipe(const std::string& text) {
    filtering_.editor().setRecipe(parseRecipe(std::vector<std::string>{text}));
  }
  void wait() {
    filtering_.wait();
    QCoreApplication::processEvents();
  }
  Filtering& filtering_;
};

TEST_F(FilteringTest, OffWhatIsSeenIsAsRecorded) {
  setRecipe("gaussian:size=5");
  bench_->subject.show(recording("a"));
  wait();
  EXPECT_EQ(bench_->subject.seen(), bench_->subject.recorded());
  EXPECT_FALSE(filtering_.applied());
  EXPECT_EQ(filtering_.caption(), "");
}

TEST_F(FilteringTest, OnTheRecordingIsFilteredBesideTheWindow) {
  setRecipe("gaussian:size=5");
  filtering_.setOn(true);
  bench_->subject.show(recording("a"));
  EXPECT_FALSE(filtering_.applied()) << "not made yet";
  wait();
  EXPECT_TRUE(filtering_.applied());
  EXPECT_NE(bench_->subject.seen(), bench_->subject.recorded());
  EXPECT_TRUE(filtering_.caption().contains("gaussian"));
}

TEST_F(FilteringTest, AFrameIsReadOnceWhereItWasFilteredBefore) {
  setRecipe("gaussian:size=5");
  filtering_.setOn(true);
  bench_->subject.show(recording("a"));
  wait();
  filtering_.setOn(false);
  QSignalSpy frames(&bench_->moment, &Moment::frameChanged);
  filtering_.setOn(true);
  EXPECT_TRUE(filtering_.applied()) << "at once";
  EXPECT_EQ(frames.count(), 1);
}

TEST_F(FilteringTest, BackFromLiveTheFilteredFrameIsTheFirstThatIsSeen) {
  setRecipe("gaussian:size=5");
  filtering_.setOn(true);
  bench_->subject.show(recording("a"));
  wait();
  connectEmulated();
  int ofRecording = 0;
  QObject::connect(&bench_->moment, &Moment::frameChanged, [&] {
    if (bench_->subject.isRecording()) ++ofRecording;
  });
  disconnect();
  EXPECT_TRUE(filtering_.applied());
  EXPECT_EQ(ofRecording, 1) << "not the one as recorded before";
}

TEST_F(FilteringTest, IsRememberedWithItsSwitch) {
  setRecipe("gaussian:size=5");
  filtering_.setOn(true);
  Filtering later(
      bench_->subject, bench_->events, bench_->live, bench_->messages, bench_->settings);
  later.restore(std::nullopt);
  EXPECT_TRUE(later.on());
  EXPECT_TRUE(later.recipe().sameSteps(filtering_.recipe()));
}

TEST_F(FilteringTest, ARecipeGivenForOneDayIsNotRememberedForTheNext) {
  setRecipe("gaussian:size=5");
  Filtering today(
      bench_->subject, bench_->events, bench_->live, bench_->messages, bench_->settings);
  today.restore(parseRecipe(std::vector<std::string>{"median:size=3"}));
  Filtering tomorrow(
      bench_->subject, bench_->events, bench_->live, bench_->messages, bench_->settings);
  tomorrow.restore(std::nullopt);
  EXPECT_TRUE(tomorrow.recipe().sameSteps(filtering_.recipe()));
}

TEST_F(FilteringTest, ARecipeKeptWithTheRecordingIsTakenWhenItIsShown) {
  const Recipe kept = parseRecipe(std::vector<std::string>{"gaussian:size=5"});
  auto made = std::make_shared<OpenedRecording>(*recording((folder_ / "a.dsa").string()));
  const std::int64_t us = made->profile.frameTimeUs(0);
  made->events.events = {
      {us, us, "recipe", std::nullopt, recipeText(kept), recipeJson(kept).text(-1)}};
  bench_->subject.show(made);
  EXPECT_TRUE(filtering_.recipe().sameSteps(kept));
  EXPECT_TRUE(filtering_.on());
  filtering_.editor().setRecipe({});
  wait();
  EXPECT_TRUE(filtering_.recipe().empty()) << "taken once: what the user does then stays";
}

TEST_F(FilteringTest, KeepingItMakesAnEventOfTheRecording) {
  bench_->subject.show(recording((folder_ / "a.dsa").string()));
  setRecipe("gaussian:size=5");
  filtering_.keepWithRecording();
  ASSERT_EQ(bench_->events.editor()->events().size(), 1u);
  EXPECT_EQ(bench_->events.editor()->events()[0].kind, "recipe");
  EXPECT_TRUE(bench_->events.hasUnsaved(bench_->subject.recorded()));
  filtering_.editor().setRecipe({});
  filtering_.keepWithRecording();
  EXPECT_TRUE(bench_->events.editor()->events().empty()) << "no filters: none is kept";
}

TEST_F(FilteringTest, LiveItIsAppliedAtOnce) {
  setRecipe("gaussian:size=5");
  filtering_.setOn(true);
  connectEmulated();
  EXPECT_TRUE(filtering_.applied());
  EXPECT_TRUE(filtering_.liveFigures().has_value());
  filtering_.setOn(false);
  EXPECT_FALSE(filtering_.applied());
  EXPECT_EQ(filtering_.liveFigures(), std::nullopt);
}

}  // namespace
}  // namespace palpate::gui::filtering_test
