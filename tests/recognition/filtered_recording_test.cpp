#include "palpate/recognition/filtered_recording.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/crop.h"

#include "testing/testing.h"

namespace palpate::filtered_recording_test {
namespace {

class FilteredRecording : public ::testing::Test {
 protected:
  Profile by(const std::vector<std::string>& filters) {
    return filteredBy(parseRecipe(filters), recording_, "a.palpate");
  }
  Recording recording_{.profile = synthesize({.durationS = 1.0, .grasps = 1})};
  const Profile& recorded_ = recording_.profile;
};

TEST_F(FilteredRecording, WithoutFiltersIsTheRecordingAndNoFileIsRead) {
  const Profile same = by({});
  TactileFrame before, after;
  recorded_.readFrame(20, before);
  same.readFrame(20, after);
  EXPECT_EQ(before.values, after.values);
}

TEST_F(FilteredRecording, NamesTheFileWhoseMatrixIsMissing) {
  EXPECT_EQ(by({"median"}).numFrames(), recorded_.numFrames());
  try {
    by({"median:matrices=9"});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("a.palpate: ")) << error.what();
  }
}

// 100 frames/s that arrive five at once.
Recording bursts(bool withSendersTimes) {
  ProfileBuilder builder(
      std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)}));
  for (std::int64_t i = 0; i < 200; ++i)
    builder.addFrame(1'000'000 + (i / 5 * 5 + 4) * 10'000 + i % 5,
                     std::vector{1.0F},
                     withSendersTimes ? std::optional(i * 10'000) : std::nullopt);
  return {.profile = builder.finish({})};
}

TEST(AtTimes, TakesTheSendersClockByChoiceOnly) {
  const Recording recording = bursts(true);
  EXPECT_EQ(filteredBy({}, recording, "a.palpate").frameTimeUs(0), 1'040'000);
  const Profile fitted = filteredBy({}, recording, "a.palpate", {}, TimeChoice::kFitted);
  for (std::size_t i = 0; i < 200; ++i)
    ASSERT_EQ(fitted.frameTimeUs(i), 1'000'004 + static_cast<std::int64_t>(i) * 10'000);
  std::string said;
  atTimes(TimeChoice::kFitted, recording.profile, "a.palpate", {}, &said);
  EXPECT_TRUE(said.starts_with("frames: drift not known yet, delays vary by 40.0 ms")) << said;
}

TEST(AtTimes, RefusesWhatCantBeFitted) {
  const Recording recording = bursts(false);
  try {
    atTimes(TimeChoice::kFitted, recording.profile, "a.palpate");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "a.palpate: times can't be fitted: no times of the sender's clock; take the times "
                 "of arrival");
  }
}

TEST(TakeFittedTimes, LeavesANote) {
  Recording recording = bursts(true);
  recording.events = {{0, 0, "mark", {}, "", ""}, {5'000'000, 5'000'000, "mark", {}, "", ""}};
  const std::string said = takeFittedTimes(recording, "a.palpate");
  ASSERT_EQ(recording.events.size(), 3u);
  EXPECT_EQ(recording.events[1].tUs, 1'000'004);
  EXPECT_EQ(recording.events[1].kind, "note");
  EXPECT_EQ(recording.events[1].text, "times fitted to the sender's clock: " + said);
  EXPECT_EQ(recording.profile.frameTimeUs(0), 1'000'004);
  // A part of it keeps the note.
  const Profile part = cropped(recording.profile, 100, 150);
  const std::vector<Event> within = eventsWithin(recording.events, part);
  ASSERT_EQ(within.size(), 1u);
  EXPECT_EQ(within[0].text, recording.events[1].text);
  EXPECT_EQ(within[0].tUs, part.frameTimeUs(0));
}

}  // namespace
}  // namespace palpate::filtered_recording_test
