// What is shown is seen through filters: a recording, a live hand; before and after on one key.
#include <QAction>
#include <QLabel>
#include <QMenu>
#include <algorithm>

#include "palpate/device/sdh2.h"
#include <palpate/emulator/synthetic_profile.h>
#include <palpate/filter/filtered_profile.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recording/recording.h>

#include "gui/filter/filter_feature.h"
#include "gui/filter/filter_panel.h"
#include "gui/inspect/matrix_table.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui::filter_window_test {
namespace {

class FilterWindowTest : public WindowTest {
 protected:
  FilterWindowTest() : path_(folder_ / "grasps.palpate") {
    saveRecording(synthesize({.durationS = 8.0, .grasps = 2, .noiseCounts = 10.0}), {}, path_);
    std::filesystem::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
    environment_.read = {};
    reopen();
  }
  void reopen() {
    if (window_) window().close();
    start();
    window().state().open({path_});
    waitUntilOpened();
    window().settle();
    ask_.choices = {"Discard"};
  }
  void setRecipe(const std::string& text) {
    window().feature<FilterFeature>().panel().editor().setRecipe(
        parseRecipe(std::vector<std::string>{text}));
    window().settle();
  }
  std::size_t loudest() {
    return window().state().displayed.unfilteredRecording()->table.frameOfLargestSum();
  }
  const std::vector<float>& seen() { return window().findChild<MatricesPanel*>()->frame().values; }
  std::string path_;
};

TEST_F(FilterWindowTest, BeforeAndAfterOnOneKey) {
  const std::size_t frame = loudest();
  playback().seekFrame(frame);
  const auto raw = window().state().displayed.unfilteredRecording()->profile.frame(frame).values;
  const auto filtered = filteredProfile(window().state().displayed.unfilteredRecording()->profile,
                                        parseRecipe(std::vector<std::string>{"gaussian:size=5"}))
                            .frame(frame)
                            .values;
  setRecipe("gaussian:size=5");
  EXPECT_EQ(seen(), raw);  // the switch is off
  trigger("filtered");
  window().settle();
  EXPECT_EQ(seen(), filtered);
  EXPECT_TRUE(window().state().activeFilters.applied());
  EXPECT_TRUE(find<StatusStrip>("statusStrip")->status().state.contains("filtered"));
  // All that is shown is the same recording, filtered.
  EXPECT_EQ(window().state().displayed.filteredRecording()->table.at(frame, 1).maximum,
            *std::max_element(filtered.begin() + 84, filtered.begin() + 162));
  trigger("filtered");
  EXPECT_EQ(seen(), raw);
  EXPECT_FALSE(window().state().activeFilters.applied());
  trigger("filtered");
  EXPECT_EQ(seen(), filtered);  // at once: it was made before
  EXPECT_EQ(playback().frame(), frame);
}

TEST_F(FilterWindowTest, TheMomentAndThePartOfTheTimelineStay) {
  TimelineChart& chart = window().feature<TimelineFeature>().panel().chart();
  playback().seekFrame(77);
  chart.setVisibleRange(1.0, 4.0);
  chart.setSelection(TimeSpan{1.5, 2.0});
  trigger("filtered");
  setRecipe("median | running-mean:centred=1");
  EXPECT_EQ(playback().frame(), 77u);
  EXPECT_NEAR(chart.seen().lower, 1.0, 1e-9);
  EXPECT_NEAR(chart.seen().upper, 4.0, 1e-9);
  ASSERT_TRUE(chart.selection());
  EXPECT_NEAR(chart.selection()->fromS, 1.5, 0.05);
}

TEST_F(FilterWindowTest, ChangesAreSeenAtOnce) {
  trigger("filtered");
  const std::size_t frame = loudest();
  playback().seekFrame(frame);
  for (const char* text : {"box", "box:size=5", "kalman", "median | (box)", "rts"}) {
    setRecipe(text);
    EXPECT_EQ(seen(),
              filteredProfile(window().state().displayed.unfilteredRecording()->profile,
                              parseRecipe(std::vector<std::string>{text}))
                  .frame(frame)
                  .values)
        << text;
  }
  setRecipe("(box)");
  EXPECT_EQ(seen(), window().state().displayed.unfilteredRecording()->profile.frame(frame).values);
  EXPECT_FALSE(window().state().activeFilters.applied());
}

TEST_F(FilterWindowTest, TheFactsOfTheRecordingStayThoseOfTheFile) {
  const auto& facts = find<FactsView>("recordingFacts")->facts();
  const std::vector<Fact> before = facts;
  ASSERT_FALSE(before.empty());
  trigger("filtered");
  setRecipe("gaussian:size=5");
  ASSERT_TRUE(window().state().activeFilters.applied());
  const std::vector<Fact> after = facts;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(after[i].value, before[i].value) << before[i].name.toStdString();
}

TEST_F(FilterWindowTest, SaturationIsLookedForInWhatWasRecorded) {
  // One taxel at its end among empty ones: no filter shall hide that.
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  frame.matrix(1)(7, 2) = 3560.0F;
  for (int i = 0; i < 10; ++i) builder.addFrame(1'000'000 + i * 30'000, frame.values);
  saveRecording(builder.finish({}), {}, folder_ / "saturated.palpate");
  window().state().open({folder_ / "saturated.palpate"});
  waitUntilOpened();
  trigger("filtered");
  setRecipe("median");
  EXPECT_EQ(seen(), std::vector<float>(seen().size(), 0.0F));
  EXPECT_TRUE(find<StatusStrip>("statusStrip")->status().figures.contains("saturated 1"));
}

TEST_F(FilterWindowTest, AChainForAnotherHandIsRefusedWithAWord) {
  trigger("filtered");
  setRecipe("median:matrices=9");
  EXPECT_TRUE(find<QLabel>("filterTotals")->text().contains("no matrix 9"));
  EXPECT_EQ(window().state().displayed.filteredRecording(),
            window().state().displayed.unfilteredRecording());
  setRecipe("median");
  EXPECT_NE(window().state().displayed.filteredRecording(),
            window().state().displayed.unfilteredRecording());
}

TEST_F(FilterWindowTest, TheRecipeIsKeptWithTheRecordingAndFoundAgain) {
  setRecipe("median:masked=1 | kalman:q=0.2");
  for (QMenu* menu : window().feature<FilterFeature>().panel().findChildren<QMenu*>())
    for (QAction* action : menu->actions())
      if (action->text() == "Add them to the recording") action->trigger();
  actions().at("saveEvents")->trigger();
  const auto events = readEvents(path_).events;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "recipe");
  EXPECT_EQ(events[0].text, "median:size=3,masked=1 | kalman:q=0.2,r=0.5,centred=0");
  setRecipe("box");
  reopen();
  EXPECT_EQ(recipeText(window().feature<FilterFeature>().panel().editor().recipe()),
            "median:masked=1 | kalman:q=0.2");
  EXPECT_TRUE(window().state().activeFilters.applied());
  window().feature<FilterFeature>().panel().editor().undo();  // what was there before isn't lost
  EXPECT_EQ(recipeText(window().feature<FilterFeature>().panel().editor().recipe()), "box");
}

TEST_F(FilterWindowTest, TheChainAndItsSwitchAreRemembered) {
  setRecipe("bilateral:sigma_value=99");
  trigger("filtered");
  reopen();
  EXPECT_EQ(recipeText(window().feature<FilterFeature>().panel().editor().recipe()),
            "bilateral:sigma_value=99");
  EXPECT_TRUE(actions().at("filtered")->isChecked());
  EXPECT_TRUE(window().state().activeFilters.applied());
}

TEST_F(FilterWindowTest, ALiveHandIsSeenThroughTheSameChain) {
  setRecipe("box:size=31");
  Connection connection;
  connection.kind = Connection::Kind::kReplay;
  connection.recording = QString::fromStdString(path_);
  window().state().connectTo(connection);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().state().displayed.isLive() && !window().state().live.stale(); },
      20'000));
  const auto alike = [&] {
    const TactileFrame& frame = window().findChild<MatricesPanel*>()->frame();
    if (frame.values.empty()) return false;
    // So wide a mean leaves no taxel of a touched matrix at 0.
    const auto touched = frame.matrix(1);
    return touched(12, 0) > 0.0F && touched(12, 5) > 0.0F && touched(5, 0) > 0.0F;
  };
  trigger("filtered");
  EXPECT_TRUE(QTest::qWaitFor(alike, 20'000));
  EXPECT_TRUE(window().state().activeFilters.applied());
  window().state().live.end();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().state().displayed.isLive(); }, 20'000));
}

TEST_F(FilterWindowTest, ARecordingMadeThroughFiltersHoldsWhatCameAndTheRecipe) {
  setRecipe("median:size=5");
  window().feature<FilterFeature>().panel().setOn(true);
  window().state().prompts.recording = [this](RecordingSettings settings, const QString&) {
    settings.folder = QString::fromStdString((folder_ / "runs").string());
    settings.nameTemplate = "run";
    return std::optional(settings);
  };
  Connection connection;
  connection.kind = Connection::Kind::kReplay;
  connection.recording = QString::fromStdString(path_);
  window().state().connectTo(connection);
  const auto await = [](const auto& condition) { return QTest::qWaitFor(condition, 20'000); };
  ASSERT_TRUE(
      await([&] { return window().state().displayed.isLive() && !window().state().live.stale(); }));
  actions().at("record")->trigger();
  ASSERT_TRUE(
      await([&] { return window().state().live.source()->session->recorderStatus().frames > 20; }));
  actions().at("record")->trigger();
  const auto made = folder_ / "runs/run.palpate";
  ASSERT_TRUE(
      await([&] { return !window().state().live.recording() && std::filesystem::exists(made); }));
  window().state().live.end();
  ASSERT_TRUE(await([&] { return !window().state().displayed.isLive(); }));
  const auto events = readEvents(made).events;
  EXPECT_EQ(std::count_if(events.begin(),
                          events.end(),
                          [](const Event& event) {
                            return event.kind == "recipe" && event.text == "median:size=5,masked=0";
                          }),
            1);
  EXPECT_TRUE(openRecording(made).info().valueType == ValueType::kCounts);  // as it came
}

}  // namespace
}  // namespace palpate::gui::filter_window_test
