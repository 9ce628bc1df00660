#include "palpate/model/profile.h"

#include <stdexcept>

#include "palpate/model/profile_builder.h"
#include "palpate/model/profile_over.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"

namespace palpate::profile_test {
namespace {

std::shared_ptr<const SensorLayout> smallLayout() {
  return std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(2, 2, 1.0)});
}

std::vector<float> frameOf(float value) { return {value, 0.0F, value, 1.0F}; }

TEST(Profile, GivesEveryFrameAtRandomAcrossChunks) {
  constexpr int kFrames = 3000;  // several chunks of the builder
  ProfileBuilder builder(smallLayout());
  for (int i = 0; i < kFrames; ++i)
    builder.addFrame(1000 * (i + 1),
                     frameOf(i % 7 == 0 ? 0.5F * static_cast<float>(i) : static_cast<float>(i)));
  const Profile profile = builder.finish({});
  ASSERT_EQ(profile.numFrames(), static_cast<std::size_t>(kFrames));
  for (int i : {2999, 0, 1023, 1024, 1025, 2047, 2048, 7, 14}) {
    const auto index = static_cast<std::size_t>(i);
    EXPECT_EQ(profile.frame(index).values,
              frameOf(i % 7 == 0 ? 0.5F * static_cast<float>(i) : static_cast<float>(i)));
    EXPECT_EQ(profile.frameTimeUs(index), 1000 * (i + 1));
  }
  EXPECT_EQ(profile.info().valueType, ValueType::kFloat);
  EXPECT_THROW(profile.frame(kFrames), std::out_of_range);
  EXPECT_THROW(profile.frameTimeUs(kFrames), std::out_of_range);
}

TEST(Profile, AnglesOfAFrameAreTheLastOnesAtOrBeforeItClampedAtBothEnds) {
  ProfileBuilder builder(smallLayout());
  for (std::int64_t t : {5, 10, 15, 20, 95}) builder.addFrame(t, frameOf(1.0F));
  for (std::int64_t t : {10, 16, 20})
    builder.addAngles(t, std::vector<double>{static_cast<double>(t)});
  const Profile profile = builder.finish({});
  const double expected[] = {10.0, 10.0, 10.0, 20.0, 20.0};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(profile.anglesAtFrame(i)->values, std::vector<double>{expected[i]}) << i;
  EXPECT_FALSE(profile.temperaturesAtFrame(0).has_value());
  EXPECT_THROW(profile.angles(3), std::out_of_range);
  EXPECT_THROW(profile.temperatures(0), std::out_of_range);
}

TEST(Profile, FindsTheFrameOfATime) {
  ProfileBuilder builder(smallLayout());
  for (std::int64_t t : {100, 200, 300}) builder.addFrame(t, frameOf(1.0F));
  const Profile profile = builder.finish({});
  EXPECT_EQ(profile.frameAt(-5), 0u);
  EXPECT_EQ(profile.frameAt(199), 0u);
  EXPECT_EQ(profile.frameAt(200), 1u);
  EXPECT_EQ(profile.frameAt(1'000'000), 2u);
  EXPECT_EQ(profile.durationUs(), 200);
}

TEST(Profile, MayBeEmpty) {
  const Profile profile = ProfileBuilder(smallLayout()).finish({});
  EXPECT_EQ(profile.numFrames(), 0u);
  EXPECT_EQ(profile.frameAt(0), std::nullopt);
  EXPECT_EQ(profile.durationUs(), 0);
  EXPECT_EQ(profile.info().valueType, ValueType::kCounts);
}

// Such a frame is shown on: its time and its values belong together.
TEST(Profile, AFrameThatCannotBeReadLeavesTheOneBeforeAsItWas) {
  ProfileBuilder builder(smallLayout());
  for (int i = 0; i < 4; ++i) builder.addFrame(1000 * (i + 1), frameOf(static_cast<float>(i)));
  const Profile profile = testing::withDamage(builder.finish({}), 2, 2);
  TactileFrame frame = profile.frame(1);
  frame.filtered = frameOf(8.0F);
  EXPECT_THROW(profile.readFrame(2, frame), FormatError);
  EXPECT_EQ(frame.hostUs, 2000);
  EXPECT_EQ(frame.values, frameOf(1.0F));
  EXPECT_EQ(frame.filtered, frameOf(8.0F));
  profile.readFrame(3, frame);
  EXPECT_EQ(frame.hostUs, 4000);
  EXPECT_EQ(frame.values, frameOf(3.0F));
  EXPECT_TRUE(frame.filtered.empty());
}

TEST(Profile, FramesThatCannotBeReadAreCountedByThePassThatGoesOn) {
  ProfileBuilder builder(smallLayout());
  for (int i = 0; i < 10; ++i) builder.addFrame(1000 * (i + 1), frameOf(static_cast<float>(i)));
  const Profile profile = testing::withDamage(builder.finish({}), 4, 6);
  TactileFrame frame;
  EXPECT_THROW(profile.readFrame(5, frame), FormatError);
  EXPECT_THROW(profile.readFrame(5, frame, nullptr), FormatError);
  UnreadableSamples unreadable;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(profile.readFrame(i, frame, &unreadable), i < 4 || i > 6) << i;
    EXPECT_EQ(frame.hostUs, 1000 * (static_cast<std::int64_t>(i) + 1));
  }
  EXPECT_EQ(unreadable.count, 3u);
  EXPECT_EQ(unreadable.runs, (std::vector<UnreadableSamples::Run>{{4, 6}}));
  EXPECT_EQ(unreadable.firstFault, "x.palpate: block 7 is damaged");
  unreadable.add(8, "other");
  EXPECT_EQ(unreadable.runs, (std::vector<UnreadableSamples::Run>{{4, 6}, {8, 8}}));
  EXPECT_EQ(unreadable.firstFault, "x.palpate: block 7 is damaged");
}

// A profile whose temperatures are computed.
class LazyStorage final : public ProfileOver {
 public:
  using ProfileOver::ProfileOver;
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    source_.readFrame(frame, out);
  }
  bool isReady(std::size_t series) const override { return series != kTemperatureSeries || ready; }
  void prepare(std::size_t series, const Progress&) const override {
    if (series == kTemperatureSeries) ready = true;
  }
  mutable bool ready = false;
};

TEST(Profile, SaysWhichSeriesAreStillToBeComputed) {
  ProfileBuilder builder(smallLayout());
  builder.addFrame(5, frameOf(1.0F));
  builder.addFrame(9, frameOf(2.0F));
  const Profile source = builder.finish({});
  EXPECT_TRUE(source.isReady(kTemperatureSeries)) << "recorded";
  source.prepare(kTemperatureSeries);
  EXPECT_THROW(source.isReady(7), std::out_of_range);
  EXPECT_THROW(source.prepare(7), std::out_of_range);
  const Profile lazy(source.info(), source.hand(), std::make_shared<LazyStorage>(source));
  EXPECT_EQ(lazy.numFrames(), 2u);
  EXPECT_EQ(lazy.frameTimeUs(1), 9);
  EXPECT_EQ(lazy.frame(1).values, source.frame(1).values);
  EXPECT_TRUE(lazy.isReady(kAngleSeries));
  EXPECT_FALSE(lazy.isReady(kTemperatureSeries));
  lazy.prepare(kTemperatureSeries);
  EXPECT_TRUE(lazy.isReady(kTemperatureSeries));
}

}  // namespace
}  // namespace palpate::profile_test
