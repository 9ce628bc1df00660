// What is shown is seen through the chain, and each change of it tells once.
#include "gui/window_state/active_filters.h"

#include <QSignalSpy>

#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::active_filters_test {
namespace {

class ActiveFiltersTest : public WindowStateTest {
 protected:
  ActiveFiltersTest() : activeFilters_(windowState_->activeFilters) {}
  void setRecipe(const std::string& text) {
    activeFilters_.editor().setRecipe(parseRecipe(std::vector<std::string>{text}));
  }
  void wait() {
    activeFilters_.wait();
    QCoreApplication::processEvents();
  }
  ActiveFilters& activeFilters_;
};

TEST_F(ActiveFiltersTest, OffWhatIsSeenIsAsRecorded) {
  setRecipe("gaussian:size=5");
  windowState_->displayed.show(recording("a"));
  wait();
  EXPECT_EQ(windowState_->displayed.filteredRecording(), windowState_->displayed.recorded());
  EXPECT_FALSE(activeFilters_.applied());
  EXPECT_EQ(activeFilters_.caption(), "");
}

TEST_F(ActiveFiltersTest, OnTheRecordingIsFilteredBesideTheWindow) {
  setRecipe("gaussian:size=5");
  activeFilters_.setOn(true);
  windowState_->displayed.show(recording("a"));
  EXPECT_FALSE(activeFilters_.applied()) << "not made yet";
  wait();
  EXPECT_TRUE(activeFilters_.applied());
  EXPECT_NE(windowState_->displayed.filteredRecording(), windowState_->displayed.recorded());
  EXPECT_TRUE(activeFilters_.caption().contains("gaussian"));
}

TEST_F(ActiveFiltersTest, AFrameIsReadOnceWhereItWasFilteredBefore) {
  setRecipe("gaussian:size=5");
  activeFilters_.setOn(true);
  windowState_->displayed.show(recording("a"));
  wait();
  activeFilters_.setOn(false);
  QSignalSpy frames(&windowState_->currentFrame, &CurrentFrame::frameChanged);
  activeFilters_.setOn(true);
  EXPECT_TRUE(activeFilters_.applied()) << "at once";
  EXPECT_EQ(frames.count(), 1);
}

TEST_F(ActiveFiltersTest, BackFromLiveTheFilteredFrameIsTheFirstThatIsSeen) {
  setRecipe("gaussian:size=5");
  activeFilters_.setOn(true);
  windowState_->displayed.show(recording("a"));
  wait();
  connectEmulated();
  int ofRecording = 0;
  QObject::connect(&windowState_->currentFrame, &CurrentFrame::frameChanged, [&] {
    if (windowState_->displayed.isRecording()) ++ofRecording;
  });
  disconnect();
  EXPECT_TRUE(activeFilters_.applied());
  EXPECT_EQ(ofRecording, 1) << "not the one as recorded before";
}

TEST_F(ActiveFiltersTest, IsRememberedWithItsSwitch) {
  setRecipe("gaussian:size=5");
  activeFilters_.setOn(true);
  ActiveFilters later(windowState_->displayed,
                      windowState_->events,
                      windowState_->live,
                      windowState_->messages,
                      windowState_->settings);
  later.restore(std::nullopt);
  EXPECT_TRUE(later.on());
  EXPECT_TRUE(later.recipe().sameSteps(activeFilters_.recipe()));
}

TEST_F(ActiveFiltersTest, FiltersOfTheLastSessionAreNamedOnce) {
  setRecipe("gaussian:size=5");
  activeFilters_.setOn(true);
  ActiveFilters later(windowState_->displayed,
                      windowState_->events,
                      windowState_->live,
                      windowState_->messages,
                      windowState_->settings);
  later.restore(std::nullopt);
  windowState_->displayed.show(recording("a"));
  EXPECT_EQ(windowState_->messages.flashed(),
            "filtered as in the last session: gaussian:size=5; A switches the filters off");
  windowState_->messages.flash("");
  windowState_->displayed.show(recording("b"));
  EXPECT_EQ(windowState_->messages.flashed(), "");
}

TEST_F(ActiveFiltersTest, ARecipeGivenForOneDayIsNotRememberedForTheNext) {
  setRecipe("gaussian:size=5");
  ActiveFilters today(windowState_->displayed,
                      windowState_->events,
                      windowState_->live,
                      windowState_->messages,
                      windowState_->settings);
  today.restore(parseRecipe(std::vector<std::string>{"median:size=3"}));
  today.lend(parseRecipe(std::vector<std::string>{"gaussian:size=7"}));
  today.giveBack();
  EXPECT_EQ(today.text(), "median");
  ActiveFilters tomorrow(windowState_->displayed,
                         windowState_->events,
                         windowState_->live,
                         windowState_->messages,
                         windowState_->settings);
  tomorrow.restore(std::nullopt);
  EXPECT_TRUE(tomorrow.recipe().sameSteps(activeFilters_.recipe()));
}

// The sensitivity test lends its filters; the program may end before it gives the others back.
TEST_F(ActiveFiltersTest, LentFiltersAreNotRemembered) {
  setRecipe("gaussian:size=5");
  const Recipe own = activeFilters_.recipe();
  const Recipe lent = parseRecipe(std::vector<std::string>{"median:size=3"});
  const auto remembered = [this](const Recipe& recipe, bool on) {
    ActiveFilters later(windowState_->displayed,
                        windowState_->events,
                        windowState_->live,
                        windowState_->messages,
                        windowState_->settings);
    later.restore(std::nullopt);
    EXPECT_TRUE(later.recipe().sameSteps(recipe)) << later.text().toStdString();
    EXPECT_EQ(later.on(), on);
  };
  activeFilters_.lend(lent);
  EXPECT_TRUE(activeFilters_.recipe().sameSteps(lent));
  EXPECT_TRUE(activeFilters_.on());
  remembered(own, false);
  activeFilters_.giveBack();
  EXPECT_TRUE(activeFilters_.recipe().sameSteps(own));
  EXPECT_FALSE(activeFilters_.on());
  remembered(own, false);
  activeFilters_.lend(lent);
  setRecipe("gaussian:size=7");  // by the user
  activeFilters_.giveBack();
  EXPECT_EQ(activeFilters_.text(), "gaussian:size=7");
  remembered(activeFilters_.recipe(), true);
}

TEST_F(ActiveFiltersTest, ARecipeKeptWithTheRecordingIsTakenWhenItIsShown) {
  const Recipe kept = parseRecipe(std::vector<std::string>{"gaussian:size=5"});
  auto made = std::make_shared<OpenedRecording>(*recording((folder_ / "a.dsa").string()));
  const std::int64_t us = made->profile.frameTimeUs(0);
  made->events.events = {
      {us, us, "recipe", std::nullopt, recipeText(kept), recipeJson(kept).text(-1)}};
  windowState_->displayed.show(made);
  EXPECT_TRUE(activeFilters_.recipe().sameSteps(kept));
  EXPECT_TRUE(activeFilters_.on());
  activeFilters_.editor().setRecipe({});
  wait();
  EXPECT_TRUE(activeFilters_.recipe().empty()) << "taken once: what the user does then stays";
}

TEST_F(ActiveFiltersTest, KeepingItMakesAnEventOfTheRecording) {
  windowState_->displayed.show(recording((folder_ / "a.dsa").string()));
  setRecipe("gaussian:size=5");
  activeFilters_.keepWithRecording();
  ASSERT_EQ(windowState_->events.editor()->events().size(), 1u);
  EXPECT_EQ(windowState_->events.editor()->events()[0].kind, "recipe");
  EXPECT_TRUE(windowState_->events.hasUnsaved(windowState_->displayed.recorded()));
  activeFilters_.editor().setRecipe({});
  activeFilters_.keepWithRecording();
  EXPECT_TRUE(windowState_->events.editor()->events().empty()) << "no filters: none is kept";
}

TEST_F(ActiveFiltersTest, LiveItIsAppliedAtOnce) {
  setRecipe("gaussian:size=5");
  activeFilters_.setOn(true);
  connectEmulated();
  EXPECT_TRUE(activeFilters_.applied());
  EXPECT_TRUE(activeFilters_.liveFigures().has_value());
  activeFilters_.setOn(false);
  EXPECT_FALSE(activeFilters_.applied());
  EXPECT_EQ(activeFilters_.liveFigures(), std::nullopt);
}

}  // namespace
}  // namespace palpate::gui::active_filters_test
