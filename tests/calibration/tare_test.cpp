#include "palpate/calibration/tare.h"

#include <random>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::tare_test {
namespace {

std::shared_ptr<const SensorLayout> twoMatrices() {
  return std::make_shared<SensorLayout>(
      std::vector{MatrixLayout::full(2, 2, 3.4), MatrixLayout::full(2, 2, 3.4)});
}

// 10 s at 30 frames/s: taxel 0 of each matrix rests at 20 counts; matrix 0 is loaded from 4 to 7 s.
Profile recording(float load = 500.0F, float rest = 20.0F) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0F, 1.0F);
  ProfileBuilder builder(twoMatrices());
  for (int i = 0; i < 300; ++i) {
    std::vector<float> values(8, 0.0F);
    values[0] = rest + noise(random);
    values[4] = rest + noise(random);
    if (i >= 120 && i < 210)
      for (std::size_t p = 0; p < 4; ++p) values[p] += load;
    builder.addFrame(1'000'000 + i * 33'333, values);
  }
  return builder.finish({});
}

TEST(Tare, FindsTheZeroInUnloadedWindows) {
  const Tare tare = findTare(recording());
  ASSERT_EQ(tare.matrices.size(), 2u);
  EXPECT_TRUE(tare.any());
  EXPECT_TRUE(tare.matrices[0].valid);
  EXPECT_NEAR(tare.zero[0], 20.0F, 0.3F);
  EXPECT_EQ(tare.zero[1], 0.0F);
  EXPECT_NEAR(tare.zero[4], 20.0F, 0.3F);
  EXPECT_EQ(tare.matrices[0].raisedTaxels, 1u);
  for (const UnloadedWindow& window : tare.matrices[0].windows)
    EXPECT_TRUE(window.end < 120 || window.begin >= 210) << window.begin;
  ASSERT_EQ(tare.matrices[1].windows.size(), 1u) << "never touched: one stretch";
  EXPECT_EQ(tare.matrices[1].windows[0].begin, 0u);
  EXPECT_EQ(tare.matrices[1].windows[0].end, 299u);
}

TEST(Tare, WindowsOfASlowRecordingAreAsLongAsThreeFramesNeed) {
  // A frame every 3 s: no window of 1 s holds more than one.
  ProfileBuilder builder(twoMatrices());
  for (int i = 0; i < 60; ++i) {
    std::vector<float> values(8, 0.0F);
    values[4] = 30.0F;
    builder.addFrame(1'000'000 + static_cast<std::int64_t>(i) * 3'000'000, values);
  }
  const Tare tare = findTare(builder.finish({}));
  ASSERT_TRUE(tare.matrices[1].valid) << tare.matrices[1].note;
  EXPECT_EQ(tare.zero[4], 30.0F);
  EXPECT_EQ(tare.zero[0], 0.0F);
}

TEST(Tare, TakesTheZeroOffAndLeavesRawRaw) {
  const Profile profile = recording();
  const Tare tare = findTare(profile);
  TactileFrame frame = profile.frame(150);
  const float before = frame.values[1];
  applyTare(tare, frame.values);
  EXPECT_EQ(frame.values[1], before);
  EXPECT_NEAR(frame.values[0], 500.0F, 5.0F);
  EXPECT_NEAR(profile.frame(150).values[0], 520.0F, 5.0F) << "raw stays raw";
  TactileFrame idle = profile.frame(10);
  applyTare(tare, idle.values);
  EXPECT_LE(idle.values[0], 4.0F);
  EXPECT_GE(idle.values[0], 0.0F);
  EXPECT_THROW(applyTare(tare, std::span(idle.values).first(3)), std::invalid_argument);
}

TEST(Tare, SaysWhereNothingIsEverUnloaded) {
  ProfileBuilder held(twoMatrices());
  for (int i = 0; i < 100; ++i) held.addFrame(1 + i * 33'333, std::vector<float>(8, 900.0F));
  const Tare always = findTare(held.finish({}));
  EXPECT_FALSE(always.any());
  EXPECT_NE(always.matrices[0].note.find("never unloaded"), std::string::npos);
  ProfileBuilder moving(twoMatrices());
  for (int i = 0; i < 100; ++i)
    moving.addFrame(1 + i * 33'333, std::vector<float>(8, i % 2 == 0 ? 0.0F : 90.0F));
  EXPECT_NE(findTare(moving.finish({})).matrices[0].note.find("never still"), std::string::npos);
  ProfileBuilder empty(twoMatrices());
  EXPECT_NE(findTare(empty.finish({})).matrices[0].note.find("too short"), std::string::npos);
}

TEST(Tare, PassesThroughItsEvent) {
  const Profile profile = recording();
  const Tare tare = findTare(profile);
  const Tare back =
      tareFrom(Json::parse(jsonOf(tare, profile.layout()).text(-1)), profile.layout());
  EXPECT_EQ(back.zero, tare.zero);
  EXPECT_EQ(back.matrices[0].windows.size(), tare.matrices[0].windows.size());
  EXPECT_TRUE(back.matrices[0].valid);
}

TEST(Tare, RefusesAnEventOfAnotherSensor) {
  const Profile profile = recording();
  const Json json = jsonOf(findTare(profile), profile.layout());
  EXPECT_THROW(tareFrom(json, *sdh2().layout), Error);
  EXPECT_THROW(tareFrom(Json::object(), profile.layout()), Error);
  const SensorLayout other({MatrixLayout::full(2, 3, 3.4), MatrixLayout::full(2, 2, 3.4)});
  EXPECT_THROW(tareFrom(json, other), Error);
}

TEST(Tare, RefusesBadOptions) {
  EXPECT_THROW(findTare(recording(), {.windowS = 0.0}), std::invalid_argument);
  EXPECT_THROW(findTare(recording(), {.maxRestCounts = -1.0}), std::invalid_argument);
  EXPECT_THROW(findTare(recording(), {.sameRestCounts = -1.0}), std::invalid_argument);
  EXPECT_THROW(findTare(recording(), {.maxSdCounts = -1.0}), std::invalid_argument);
}

// 10 s at 10 frames/s; matrix 1 is loaded in the last `loadedS` seconds.
Profile partlyLoaded(int loadedS) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 100; ++i) {
    TactileFrame frame(sdh2().layout);
    frame.matrix(1)(7, 2) = i >= 100 - 10 * loadedS ? 500.0F : 20.0F;
    builder.addFrame(1'000'000 + 100'000 * i, frame.values);
  }
  return builder.finish({});
}

TEST(Tare, SaysWhichMatrixIsNotAtRest) {
  const auto why = [](const Profile& profile, double share) {
    return notAtRest(findTare(profile), profile, share);
  };
  EXPECT_EQ(why(partlyLoaded(0), 1.0), "");
  EXPECT_EQ(why(partlyLoaded(3), 0.0), "") << "seven seconds are enough for a tare";
  const std::string name = partlyLoaded(0).hand().matrixName(1);
  EXPECT_EQ(why(partlyLoaded(3), 0.9),
            "not at rest: " + name + " (touched or moved in 30 % of the time)");
  EXPECT_EQ(why(partlyLoaded(10), 0.0),
            "not at rest: " + name + " (never unloaded: its calmest window reads 500 counts)");
}

}  // namespace
}  // namespace palpate::tare_test
