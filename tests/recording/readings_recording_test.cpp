// Recordings of sensors whose readings have a sign, three components, or noise at rest.
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/model/touch.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/second_summary.h"

#include "recording/palpate_damage.h"
#include "testing/testing.h"

namespace palpate::readings_recording_test {
namespace {

using namespace testing;

HandDescription skin() {
  return parseHand(R"({"format": "palpate-hand", "version": 1, "name": "skin", "full_scale": 1000,
      "touch_threshold": 5, "matrices": [
        {"name": "a", "rows": 2, "columns": 2, "pitch_mm": 4, "components": 3},
        {"name": "b", "rows": 1, "columns": 3, "pitch_mm": 4, "picture": {"column": 1, "row": 0}}
      ]})",
                   "",
                   "hand.json");
}

// 15 readings of frame `i`; that of z of the first taxel falls by 1 per frame.
std::vector<float> readingsOf(int i) {
  std::vector<float> readings(15, 0.25F);
  readings[0] = readings[1] = 0.0F;
  readings[2] = static_cast<float>(-i);
  readings[14] = static_cast<float>(100 + i);
  return readings;
}

Profile recorded() {
  ProfileBuilder builder(skin());
  for (int i = 0; i < 40; ++i) builder.addReadings(1'000 + 10 * i, readingsOf(i));
  return builder.finish({});
}

std::vector<Event> rest() {
  Baseline first{std::vector<float>(15), {}};
  first.rest[14] = 100.0F;
  Baseline second = first;
  second.rest[2] = -20.0F;
  return {baselineEvent(first, 900), baselineEvent(second, 1'200)};
}

TEST(ReadingsRecording, ReadingsComeBackAndAreSeenOverTheirBaselines) {
  const TemporaryFolder folder;
  const auto path = folder / "a.palpate";
  saveRecording(recorded(), rest(), path);
  const Recording read = readRecording(path);
  ASSERT_TRUE(read.profile.givesReadings());
  ASSERT_EQ(read.profile.numFrames(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    const TactileFrame frame = read.profile.frame(i);
    ASSERT_EQ(frame.readings, readingsOf(static_cast<int>(i))) << i;
    // From frame 20 on over the second baseline.
    const float z = static_cast<float>(i < 20 ? i : i - 20);
    EXPECT_EQ(frame.values[0], z > 5.0F ? z : 0.0F) << i;
    EXPECT_EQ(frame.values[6], i > 5 ? static_cast<float>(i) : 0.0F) << i;
    EXPECT_EQ(frame.allValues()[0], z) << i;
  }
  const Profile part = cropped(read.profile, 25, 39);
  EXPECT_EQ(part.frame(14).values, read.profile.frame(39).values);
  const auto cut = folder / "cut.palpate";
  saveRecording(part, eventsWithin(read.events, part), cut);
  EXPECT_EQ(openRecording(cut).frame(14).values, read.profile.frame(39).values);
}

TEST(ReadingsRecording, AWholeOneIsVerified) {
  const TemporaryFolder folder;
  saveRecording(recorded(), rest(), folder / "a.palpate");
  const PalpateRecovery recovery = recoverPalpateProfile(folder / "a.palpate");
  EXPECT_TRUE(recovery.whole());
  ASSERT_TRUE(recovery.profile);
  EXPECT_EQ(recovery.profile->frame(7).readings, readingsOf(7));
}

// What its file says of each second is what was seen while recording.
TEST(ReadingsRecording, ABaselineTakenLaterIsSeenAndDamagesNothing) {
  const TemporaryFolder folder;
  const auto path = folder / "a.palpate";
  saveRecording(recorded(), rest(), path);
  const auto summary = readSeconds(path);
  Baseline later{std::vector<float>(15), {}};
  later.rest[2] = -30.0F;
  const Recording before = readRecording(path);
  std::vector<Event> events = before.events;
  events.push_back(baselineEvent(later, 1'300, kNewBaselineKind));
  saveEvents(path, {before.events, 0}, events);
  const Recording read = readRecording(path);
  EXPECT_EQ(read.profile.frame(0).values[0], 30.0F) << "also before it";
  EXPECT_EQ(read.profile.frame(39).values[0], 9.0F);
  EXPECT_EQ(read.profile.frame(39).readings, before.profile.frame(39).readings);
  EXPECT_TRUE(recoverPalpateProfile(path).whole());
  EXPECT_EQ(recoverPalpateProfile(path).damagedRows, 0u);
  EXPECT_EQ(readSeconds(path), summary);

  const auto copy = folder / "copy.palpate";
  saveRecording(read.profile, read.events, copy);
  EXPECT_EQ(recoverPalpateProfile(copy).damagedRows, 0u);
  EXPECT_EQ(readSeconds(copy), summary);
  // A part that ends before the baseline was taken is seen over it, too.
  const Profile part = cropped(read.profile, 2, 10);
  const auto cut = folder / "cut.palpate";
  saveRecording(part, eventsWithin(read.events, part), cut);
  EXPECT_EQ(openRecording(cut).frame(0).values[0], 28.0F);
  EXPECT_EQ(recoverPalpateProfile(cut).damagedRows, 0u);

  saveEvents(path, {read.events, 0}, before.events);
  EXPECT_EQ(readRecording(path).profile.frame(30).values[0], 10.0F) << "undone";
  std::vector<Event> without = before.events;
  without.erase(without.begin());
  EXPECT_THROW(saveEvents(path, {before.events, 0}, without), std::invalid_argument)
      << "what happened while recording stays";
}

TEST(ReadingsRecording, OtherFormsHoldWhatIsSeen) {
  const TemporaryFolder folder;
  const Profile profile = recorded();
  saveRecording(profile, {}, folder / "a.mcap");
  const Recording read = readRecording(folder / "a.mcap");
  EXPECT_FALSE(read.profile.givesReadings());
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(read.profile.frame(i).values, profile.frame(i).values) << i;
    EXPECT_EQ(read.profile.frame(i).allValues(), profile.frame(i).allValues()) << i;
  }
}

}  // namespace
}  // namespace palpate::readings_recording_test
