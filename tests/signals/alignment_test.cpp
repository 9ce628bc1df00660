#include "palpate/signals/alignment.h"

#include <limits>
#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"

namespace palpate::alignment_test {
namespace {

constexpr std::int64_t kStartUs = 1'400'000'000'000'000;

// One frame per stamp [ms]; from `touchedFrom` on twelve taxels are active.
Profile recorded(const std::vector<std::int64_t>& stampsMs, std::size_t touchedFrom) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < stampsMs.size(); ++i) {
    TactileFrame frame(sdh2().layout);
    if (i >= touchedFrom) frame.matrix(3).block(5, 1, 3, 4).setConstant(100.0F);
    builder.addFrame(kStartUs + stampsMs[i] * 1000, frame.values);
  }
  return builder.finish({});
}

std::vector<std::int64_t> every(std::int64_t stepMs, std::size_t count, std::int64_t fromMs = 0) {
  std::vector<std::int64_t> stamps;
  for (std::size_t i = 0; i < count; ++i)
    stamps.push_back(fromMs + static_cast<std::int64_t>(i) * stepMs);
  return stamps;
}

// A: 40 frames, 50 ms apart, touched from 0.50 s on. B: began 7.25 s later, 20 ms apart, from 0.30
// s on.
class AlignmentTest : public ::testing::Test {
 protected:
  TimedProfile a_ = timedProfile(recorded(every(50, 40), 10));
  TimedProfile b_ = timedProfile(recorded(every(20, 50, 7250), 15));
};

TEST_F(AlignmentTest, ContactsComeOnTopOfEachOther) {
  ASSERT_EQ(a_.contact, 10u);
  ASSERT_EQ(b_.contact, 15u);
  EXPECT_NEAR(*offsetBetween(a_, b_, Alignment::kContact), 0.50 - 0.30, 1e-12);
  EXPECT_NEAR(*offsetBetween(b_, a_, Alignment::kContact), 0.30 - 0.50, 1e-12);
}

TEST_F(AlignmentTest, StartsAndClockAreWhatTheyAre) {
  EXPECT_EQ(offsetBetween(a_, b_, Alignment::kStart), 0.0);
  EXPECT_NEAR(*offsetBetween(a_, b_, Alignment::kClock), 7.25, 1e-12);
  EXPECT_NEAR(*offsetBetween(b_, a_, Alignment::kClock), -7.25, 1e-12);
  EXPECT_EQ(offsetBetween(a_, b_, Alignment::kManual), std::nullopt);
}

TEST_F(AlignmentTest, ChosenGraspsComeOnTopOfEachOther) {
  EXPECT_EQ(offsetBetween(a_, b_, Alignment::kGrasp), std::nullopt) << "none is chosen";
  a_.grasp = 30;  // at 1.50 s
  EXPECT_EQ(offsetBetween(a_, b_, Alignment::kGrasp), std::nullopt);
  b_.grasp = 20;  // at 0.40 s
  EXPECT_NEAR(*offsetBetween(a_, b_, Alignment::kGrasp), 1.50 - 0.40, 1e-12);
  // The second grasp of a recording on its first one.
  TimedProfile again = a_;
  again.grasp = 12;
  EXPECT_NEAR(*offsetBetween(again, a_, Alignment::kGrasp), 0.60 - 1.50, 1e-12);
  b_.grasp = 50;
  EXPECT_THROW((void)offsetBetween(a_, b_, Alignment::kGrasp), std::out_of_range);
}

TEST_F(AlignmentTest, TwoGraspsHaveInCommonWhatTheShorterOneHas) {
  // A's lasts from 0.50 to 1.50 s, B's from 0.30 to 0.70 s, which is 0.50 to 0.90 s of A.
  const auto both = graspsInCommon(a_, {10, 30}, b_, {15, 35}, 0.20);
  ASSERT_TRUE(both);
  EXPECT_NEAR(both->fromS, 0.50, 1e-12);
  EXPECT_NEAR(both->toS, 0.90, 1e-12);
  // B's lies before A's.
  EXPECT_EQ(graspsInCommon(a_, {10, 30}, b_, {15, 35}, -1.0), std::nullopt);
  EXPECT_THROW((void)graspsInCommon(a_, {10, 40}, b_, {15, 35}, 0.2), std::out_of_range);
}

TEST_F(AlignmentTest, WithoutContactOrFrameThereIsNoOffset) {
  const TimedProfile untouched = timedProfile(recorded(every(50, 9), 9));
  EXPECT_EQ(untouched.contact, std::nullopt);
  EXPECT_EQ(offsetBetween(a_, untouched, Alignment::kContact), std::nullopt);
  EXPECT_EQ(offsetBetween(untouched, b_, Alignment::kContact), std::nullopt);
  EXPECT_EQ(offsetBetween(a_, untouched, Alignment::kStart), 0.0);
  const TimedProfile empty = timedProfile(recorded({}, 0));
  for (const Alignment each : kAllAlignments)
    EXPECT_EQ(offsetBetween(a_, empty, each), std::nullopt);
  EXPECT_EQ(commonSpan(a_, empty, 0.0), std::nullopt);
  EXPECT_EQ(wholeSpan(a_, empty, 3.0), (TimeSpan{0.0, a_.timing.durationS}));
  EXPECT_EQ(wholeSpan(empty, empty, 3.0), TimeSpan{});
}

TEST_F(AlignmentTest, SpansAreThoseOfTheTwo) {
  const auto common = commonSpan(a_, b_, 1.5);  // A 0..1.95, B 1.5..2.48
  ASSERT_TRUE(common);
  EXPECT_NEAR(common->fromS, 1.5, 1e-12);
  EXPECT_NEAR(common->toS, 1.95, 1e-12);
  EXPECT_NEAR(common->lengthS(), 0.45, 1e-12);
  const TimeSpan whole = wholeSpan(a_, b_, 1.5);
  EXPECT_NEAR(whole.fromS, 0.0, 1e-12);
  EXPECT_NEAR(whole.toS, 2.48, 1e-12);
  EXPECT_NEAR(wholeSpan(a_, b_, -0.5).fromS, -0.5, 1e-12);
  EXPECT_EQ(commonSpan(a_, b_, 7.25), std::nullopt);
  EXPECT_EQ(commonSpan(a_, b_, -3.0), std::nullopt);
}

TEST_F(AlignmentTest, AFrameStandsFromItsStampToTheNext) {
  EXPECT_EQ(a_.frameAt(0.0), 0u);
  EXPECT_EQ(a_.frameAt(0.0499), 0u);
  EXPECT_EQ(a_.frameAt(0.05), 1u);
  EXPECT_EQ(a_.frameAt(1.95), 39u);
  EXPECT_EQ(a_.frameAt(-0.0001), std::nullopt);
  EXPECT_EQ(a_.frameAt(1.951), std::nullopt);
  EXPECT_EQ(a_.frameAt(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
  EXPECT_EQ(a_.frameAt(1e300), std::nullopt);
  EXPECT_DOUBLE_EQ(a_.timeS(10), 0.5);
}

TEST_F(AlignmentTest, InsideAGapThereIsNoFrame) {
  std::vector<std::int64_t> stamps = every(50, 10);
  for (const std::int64_t stamp : every(50, 10, 90'450)) stamps.push_back(stamp);
  const TimedProfile gap = timedProfile(recorded(stamps, 0));
  ASSERT_EQ(gap.timing.gaps.size(), 1u);
  EXPECT_EQ(gap.frameAt(0.45), 9u);  // exactly the last one before it
  EXPECT_EQ(gap.frameAt(0.46), std::nullopt);
  EXPECT_EQ(gap.frameAt(90.0), std::nullopt);
  EXPECT_EQ(gap.frameAt(90.45), 10u);
}

TEST_F(AlignmentTest, OneFrameIsARecording) {
  const TimedProfile one = timedProfile(recorded({0}, 1));
  EXPECT_EQ(one.frameAt(0.0), 0u);
  EXPECT_EQ(one.frameAt(0.001), std::nullopt);
  EXPECT_EQ(commonSpan(a_, one, 1.0), (TimeSpan{1.0, 1.0}));
}

TEST(AlignmentNames, GoThereAndBack) {
  for (const Alignment each : kAllAlignments) EXPECT_EQ(alignmentFrom(nameOf(each)), each);
  EXPECT_EQ(alignmentFrom("contact"), Alignment::kContact);
  EXPECT_EQ(alignmentFrom("Contact"), std::nullopt);
}

TEST(AlignmentOfRealGrasps, ContactsMeet) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  std::vector<TimedProfile> all;
  for (const auto& entry :
       std::filesystem::directory_iterator(*folder / "grasps_by_class" / "dice_large"))
    all.push_back(timedProfile(openRecording(entry.path())));
  ASSERT_GE(all.size(), 2u);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double offsetS = offsetBetween(all[0], all[i], Alignment::kContact).value();
    // Where A touches first, B touches first, to the microsecond of the stamps.
    EXPECT_EQ(all[i].frameAt(all[0].timeS(*all[0].contact) - offsetS), all[i].contact);
    const auto byClock = offsetBetween(all[0], all[i], Alignment::kClock);
    EXPECT_EQ(std::llround(*byClock * 1e6),
              all[i].profile.frameTimeUs(0) - all[0].profile.frameTimeUs(0));
  }
}

// Three touched frames in a row are a contact; a frame that can't be read interrupts the row.
TEST_F(AlignmentTest, AContactIsFoundBehindDamagedFrames) {
  const Profile damaged = testing::withDamage(a_.profile, 8, 11);
  EXPECT_THROW(timedProfile(damaged), FormatError);
  UnreadableSamples unreadable;
  const TimedProfile timed = timedProfile(damaged, {}, {}, &unreadable);
  EXPECT_EQ(timed.contact, 12u);
  EXPECT_EQ(unreadable.count, 4u);
  EXPECT_EQ(timed.timing.durationS, a_.timing.durationS);
}

}  // namespace
}  // namespace palpate::alignment_test
