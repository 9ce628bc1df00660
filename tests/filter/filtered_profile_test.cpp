#include "palpate/filter/filtered_profile.h"

#include <atomic>
#include <random>
#include <stdexcept>
#include <thread>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::filtered_profile_test {
namespace {

Recipe recipeOf(const std::string& text) { return parseRecipe(std::vector<std::string>{text}); }

class Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override { frames.push_back(frame); }
  std::vector<TactileFrame> frames;
};

std::vector<TactileFrame> streamed(const Profile& profile, const Recipe& recipe) {
  Collector out;
  FilterChain chain(recipe, out);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    TactileFrame frame = profile.frame(i);
    chain.push(frame);
  }
  chain.finish();
  return out.frames;
}

Profile grasps() { return synthesize({.durationS = 8.0, .grasps = 3, .noiseCounts = 12.0}); }

// The frames of another profile, but for some that can't be read.
class Damaged final : public ProfileStorage {
 public:
  Damaged(Profile source, std::size_t bad) : source_(std::move(source)), bad_(bad) {}
  std::size_t numFrames() const override { return source_.numFrames(); }
  std::int64_t frameTimeUs(std::size_t i) const override { return source_.frameTimeUs(i); }
  void readFrame(std::size_t i, TactileFrame& out) const override {
    if (i == bad_) throw FileError("x.palpate", "frame is damaged");
    source_.readFrame(i, out);
  }
  std::size_t numSamples(std::size_t) const override { return 0; }
  std::int64_t sampleTimeUs(std::size_t, std::size_t) const override { return 0; }
  Sample sample(std::size_t, std::size_t) const override { return {}; }

 private:
  Profile source_;
  std::size_t bad_;
};

const char* const kRecipes[] = {"median",
                                "gaussian | temporal-min",
                                "min-median:masked=1",
                                "running-mean:window=7,centred=1",
                                "median3d:centred=1",
                                "savitzky-golay:window=9,centred=1",
                                "median | savitzky-golay:derivative=1"};

TEST(FilteredProfile, IsTheStreamBitByBitInWhateverOrder) {
  const Profile source = grasps();
  for (const char* text : kRecipes) {
    const Recipe recipe = recipeOf(text);
    const auto expected = streamed(source, recipe);
    const Profile forwards = filteredProfile(source, recipe);
    ASSERT_EQ(forwards.numFrames(), source.numFrames());
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(forwards.frame(i).values, expected[i].values) << text << " frame " << i;
    const Profile anyhow = filteredProfile(source, recipe);
    std::mt19937 random(1);
    for (int n = 0; n < 120; ++n) {
      const std::size_t i = random() % expected.size();
      ASSERT_EQ(anyhow.frame(i).values, expected[i].values)
          << text << " frame " << i << " out of order";
      ASSERT_EQ(anyhow.frame(i).hostUs, source.frameTimeUs(i));
    }
  }
}

TEST(FilteredProfile, RecursiveFiltersAgreeToNineDigitsOutOfOrder) {
  const Profile source = grasps();
  const Recipe recipe = recipeOf("kalman");
  const auto expected = streamed(source, recipe);
  const Profile filtered = filteredProfile(source, recipe);
  for (std::size_t i = expected.size(); i-- > 0;)
    for (std::size_t k = 0; k < expected[i].values.size(); ++k)
      ASSERT_NEAR(
          filtered.frame(i).values[k], expected[i].values[k], 1e-5F + 1e-6F * expected[i].values[k])
          << "frame " << i;
}

TEST(FilteredProfile, SmoothersAreComputedWhole) {
  const Profile source = grasps();
  for (const char* text : {"rts", "median | kalman:centred=1"}) {
    const auto expected = streamed(source, recipeOf(text));
    const Profile filtered = filteredProfile(source, recipeOf(text));
    for (std::size_t i = expected.size(); i-- > 0;)
      ASSERT_EQ(filtered.frame(i).values, expected[i].values) << text << " " << i;
  }
  int calls = 0;
  EXPECT_THROW(filteredProfile(source, recipeOf("rts"), {}, [&](double) { return ++calls < 3; }),
               Cancelled);
}

TEST(FilteredProfile, TheRestIsTheSources) {
  const Profile source = grasps();
  for (const char* text : {"median", "rts"}) {
    const Profile filtered = filteredProfile(source, recipeOf(text));
    ASSERT_EQ(filtered.numAngles(), source.numAngles());
    EXPECT_EQ(filtered.angles(3).values, source.angles(3).values);
    ASSERT_EQ(filtered.numTemperatures(), source.numTemperatures());
    EXPECT_EQ(filtered.temperatures(2).values, source.temperatures(2).values);
    EXPECT_EQ(filtered.info().valueType, ValueType::kFloat);
    EXPECT_EQ(filtered.layout(), source.layout());
  }
  EXPECT_EQ(filteredProfile(source, Recipe{}).info().valueType, source.info().valueType);
}

TEST(FilteredProfile, ReadingsAreFilteredAsTheyAreSeen) {
  MatrixLayout matrix = MatrixLayout::full(2, 2, 1.0);
  matrix.touch = {.isSigned = true, .threshold = 5.0F};
  ProfileBuilder builder(std::make_shared<const SensorLayout>(std::vector<MatrixLayout>{matrix}));
  for (int i = 0; i < 20; ++i)
    builder.addReadings(1 + 10'000 * i, std::vector<float>{-40.0F, 1.0F, 2.0F, -30.0F});
  const Profile source = builder.finish({}).withBaselines(
      {{0, std::make_shared<const Baseline>(Baseline{{-10.0F, 0.0F, 0.0F, 0.0F}, {}})}});
  for (const char* text : {"running-mean:window=7,centred=1", "rts"}) {
    const Profile filtered = filteredProfile(source, recipeOf(text));
    EXPECT_FALSE(filtered.givesReadings());
    const TactileFrame frame = filtered.frame(10);
    EXPECT_TRUE(frame.readings.empty()) << text;
    EXPECT_NEAR(frame.values[0], 30.0F, 1e-3F) << text;
    EXPECT_EQ(frame.values[1], 0.0F) << text;
    EXPECT_NEAR(frame.values[3], 30.0F, 1e-3F) << text;
    EXPECT_NEAR(frame.allValues()[2], 2.0F, 1e-3F) << text;
  }
}

TEST(FilteredProfile, StartsAnewWhereCountsChangeTheirMeaning) {
  const Profile source = grasps();
  const Recipe recipe = recipeOf("kalman");
  const std::size_t at = source.numFrames() / 2;
  const Profile filtered = filteredProfile(source, recipe, {{source.frameTimeUs(at) - 1000}});
  EXPECT_EQ(filtered.frame(at).values,
            source.frame(at).values);  // the first of a stretch is itself
  EXPECT_NE(filtered.frame(at - 1).values, source.frame(at - 1).values);
}

TEST(FilteredProfile, AFrameThatCannotBeReadSaysSoAndTheOthersGoOn) {
  const Profile sound = grasps();
  const Profile source(sound.info(), sound.hand(), std::make_shared<Damaged>(sound, 100));
  for (const char* text : {"median", "kalman", "running-mean:centred=1"}) {
    const Profile filtered = filteredProfile(source, recipeOf(text));
    for (std::size_t i = 90; i < 110; ++i) {
      if (i == 100) {
        EXPECT_THROW(filtered.frame(i), FileError) << text;
      } else {
        EXPECT_NO_THROW(filtered.frame(i)) << text << " " << i;
      }
    }
    EXPECT_NO_THROW(filtered.frame(20));
    EXPECT_THROW(filtered.frame(100), FileError);
    // Behind it a new stretch begins.
    if (std::string(text) == "kalman") {
      EXPECT_EQ(filtered.frame(101).values, sound.frame(101).values);
    }
  }
}

TEST(FilteredProfile, OneFrameAndNoneAreRecordingsToo) {
  for (const std::size_t count : {0u, 1u, 2u}) {
    ProfileBuilder builder(sdh2().layout);
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    for (std::size_t i = 0; i < count; ++i) {
      values[40] = 100.0F;
      builder.addFrame(static_cast<std::int64_t>(1000 * i + 1), values);
    }
    const Profile source = builder.finish({});
    for (const char* text : {"median:masked=1",
                             "running-mean:window=101,centred=1",
                             "rts",
                             "median3d",
                             "savitzky-golay:window=9,order=4,centred=1",
                             "kelvin-voigt"}) {
      const Profile filtered = filteredProfile(source, recipeOf(text));
      ASSERT_EQ(filtered.numFrames(), count) << text;
      for (std::size_t i = 0; i < count; ++i) EXPECT_NO_THROW(filtered.frame(i)) << text;
      EXPECT_THROW(filtered.frame(count), std::out_of_range);
    }
  }
}

TEST(FilteredProfile, ServesSeveralThreads) {
  const Profile source = grasps();
  const Recipe recipe = recipeOf("median | running-mean");
  const auto expected = streamed(source, recipe);
  const Profile filtered = filteredProfile(source, recipe);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      for (int n = 0; n < 100; ++n) {
        const std::size_t i = t == 0 ? static_cast<std::size_t>(n) : random() % expected.size();
        if (filtered.frame(i).values != expected[i].values) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(FilteredProfile, KeepsFurtherSeries) {
  const Profile source = testing::withWrist(grasps());
  for (const char* text : {"median", "savitzky-golay:window=9,centred=1"}) {
    const Profile filtered = filteredProfile(source, recipeOf(text));
    EXPECT_EQ(filtered.series(), source.series()) << text;
    ASSERT_EQ(filtered.numSamples(kHandSeries), 40u) << text;
    EXPECT_EQ(filtered.sample(kHandSeries, 7).values, source.sample(kHandSeries, 7).values);
  }
}

}  // namespace
}  // namespace palpate::filtered_profile_test
