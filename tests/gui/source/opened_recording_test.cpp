// What is known of a long recording before all of its frames are read, and after.
#include "gui/source/opened_recording.h"

#include <QAction>
#include <vector>

#include <gtest/gtest.h>

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
  inspect.setRecording(recording);
  EXPECT_EQ(largestValue(inspect), "being counted");
  QAction interpolated("interpolated"), values("values");
  MatricesPanel matrices(&interpolated, &values);
  ViewSettings settings;
  settings.range = RangeMode::kRecording;
  matrices.setSettings(settings, Theme::kDark);
  matrices.setRecording(recording);
  EXPECT_EQ(matrices.view().look().range.maximum, 1.0);

  recording->overview->compute();
  EXPECT_EQ(recording->maximumNow(), 200.0);
  inspect.renewFacts();
  EXPECT_EQ(largestValue(inspect), "200 counts");
  matrices.renewRange();
  EXPECT_EQ(matrices.view().look().range.maximum, 200.0);
}

}  // namespace
}  // namespace palpate::gui::opened_recording_test
