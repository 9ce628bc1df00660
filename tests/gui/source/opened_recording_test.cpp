// What is known of a long recording before all of its frames are read, and after.
#include "gui/source/opened_recording.h"

#include <QAction>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include <palpate/core/error.h>
#include <palpate/model/profile_builder.h>

#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/testing/sample_profiles.h"

namespace palpate::gui::opened_recording_test {
namespace {

constexpr std::size_t kAlwaysLong = 1;  // frames

// Twenty frames whose largest value is 200 counts, in matrix 1.
Profile ofFormat(const char* format) {
  const Profile frames = twentyFrames();
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < frames.numFrames(); ++i)
    builder.addFrame(frames.frameTimeUs(i), frames.frame(i).values);
  ProfileInfo info;
  info.format = format;
  return builder.finish(std::move(info));
}

QString largestValue(const InspectPanel& panel) {
  for (const Fact& fact : panel.findChild<FactsView*>("recordingFacts")->facts())
    if (fact.name == "largest value") return fact.value;
  return "no such fact";
}

TEST(OpenedRecording, ALongDsaIsSummedUpFromWhatIsOpen) {
  std::vector<double> told;
  const auto recording = makeOpenedRecording(
      "/no/such/file.dsa",
      ofFormat("dsa"),
      [&](double fraction) {
        told.push_back(fraction);
        return true;
      },
      kAlwaysLong);
  ASSERT_TRUE(recording->isLong());
  EXPECT_FALSE(recording->overview->complete());
  EXPECT_EQ(recording->maximumNow(), 200.0);
  EXPECT_EQ(recording->touched, (std::vector<bool>{false, true, false, false, false, false}));
  EXPECT_FALSE(told.empty());
}

TEST(OpenedRecording, SummingUpALongDsaCanBeCancelled) {
  EXPECT_THROW(makeOpenedRecording(
                   "/no/such/file.dsa", ofFormat("dsa"), [](double) { return false; }, kAlwaysLong),
               Cancelled);
}

// Its file is not there: nor is the summary.
TEST(OpenedRecording, WithoutASummaryTheLargestValueIsBeingCounted) {
  const auto recording =
      makeOpenedRecording("/no/such/file.palpate", ofFormat("palpate"), {}, kAlwaysLong);
  EXPECT_EQ(recording->maximumNow(), std::nullopt);
  EXPECT_EQ(recording->touched, std::vector<bool>(6, true));
  InspectPanel inspect;
  inspect.setRecording(recording, recording);
  EXPECT_EQ(largestValue(inspect), "being counted");
  QAction interpolated("interpolated"), values("values");
  MatricesPanel matrices(&interpolated, &values);
  ViewSettings settings;
  settings.range = RangeMode::kRecording;
  matrices.setSettings(settings);
  matrices.setRecording(recording);
  EXPECT_EQ(matrices.view().look().range.maximum, 1.0);

  recording->overview->compute();
  EXPECT_EQ(recording->maximumNow(), 200.0);
  inspect.renewFacts();
  EXPECT_EQ(largestValue(inspect), "200 counts");
  matrices.renewRange();
  EXPECT_EQ(matrices.view().look().range.maximum, 200.0);
}

// `number` frames, `intervalMs` apart, with one pause in the middle.
Profile withAPause(int number, std::int64_t intervalMs, std::int64_t pauseMs) {
  std::vector<std::int64_t> stampsMs;
  std::int64_t ms = 1'400'000'000'000;
  for (int i = 0; i < number; ++i) {
    stampsMs.push_back(ms);
    ms += i == number / 2 ? pauseMs : intervalMs;
  }
  return profileWithStamps(stampsMs);
}

// What the summary tells beforehand agrees with what all time stamps tell.
TEST(OpenedRecording, GapsOfALongOneAreThoseOfItsTimeStamps) {
  struct Case {
    std::int64_t intervalMs, pauseMs;
    std::size_t gaps;
  };
  // A gap is longer than 1 s and than five intervals.
  for (const auto& [intervalMs, pauseMs, gaps] : {Case{2'000, 2'000, 0},
                                                  Case{2'000, 9'000, 0},
                                                  Case{2'000, 30'000, 1},
                                                  Case{500, 2'200, 0},
                                                  Case{500, 3'000, 1},
                                                  Case{50, 2'200, 1}}) {
    const Profile profile = withAPause(200, intervalMs, pauseMs);
    const auto recording = makeOpenedRecording("/no/such/file", profile, {}, kAlwaysLong);
    ASSERT_TRUE(recording->isLong());
    const TimingReport expected = timingOf(profile);
    ASSERT_EQ(expected.gaps.size(), gaps);
    ASSERT_EQ(recording->timing.gaps.size(), gaps) << intervalMs << " ms, pause " << pauseMs;
    if (gaps > 0) {
      EXPECT_EQ(recording->timing.gaps[0].frame, 100u);
      EXPECT_EQ(recording->timing.gaps[0].seconds, static_cast<double>(pauseMs) / 1e3);
    }
    EXPECT_NEAR(recording->timing.rateHz, expected.rateHz, 0.1 * expected.rateHz);
  }
}

// A damaged recording whose notes can't be read, either; said once where that is all of its damage.
TEST(OpenedRecording, SaysWhyThereAreNoEventsOfADamagedRecording) {
  const auto failureBeside = [](const std::string& text) {
    Recording recording{.profile = twentyFrames()};
    recording.damage.text = text;
    recording.damage.eventsError = std::make_exception_ptr(Error("a.dsa.notes.json: is damaged"));
    return makeOpenedRecording("a.dsa", std::move(recording))->eventsFailure;
  };
  EXPECT_EQ(failureBeside(""), "a.dsa.notes.json: is damaged");
  EXPECT_EQ(failureBeside("damaged; readable: 20 frames"), "a.dsa.notes.json: is damaged");
  EXPECT_EQ(failureBeside("a.dsa.notes.json: is damaged"), "");
}

}  // namespace
}  // namespace palpate::gui::opened_recording_test
