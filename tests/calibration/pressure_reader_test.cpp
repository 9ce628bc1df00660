#include "palpate/calibration/pressure_reader.h"

#include <stdexcept>

#include "palpate/calibration/force_series.h"
#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::pressure_reader_test {
namespace {

// P = 2 + 0.1 K, and creep of 1 % of K per second.
Calibration creeping() {
  Calibration made;
  made.matrix = 1;
  made.settings = {1.0, 100.0, false};
  for (int i = 0; i < 16; ++i) {
    PressureSample sample;
    sample.staticResponseCounts = 100.0 * (i + 1);
    sample.driftCountsPerS = 0.01 * sample.staticResponseCounts;
    sample.pressureKpa = 2.0 + 0.1 * sample.staticResponseCounts;
    sample.nearestDegC = 30.0 + i % 4;
    made.samples.push_back(sample);
  }
  made.pressure = fitPressureModel(made.samples, {});
  return made;
}

// Loads that come, stay between one and fifty seconds, and go.
Profile loads() {
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(sdh2().layout->numCells(), 0.0F);
  const std::size_t offset = sdh2().layout->offset(1);
  std::int64_t us = 1'000'000;
  builder.addTemperatures(us, std::vector<double>(9, 31.0));
  const auto hold = [&](double seconds, float counts) {
    for (std::size_t place = 30; place < 36; ++place) values[offset + place] = counts;
    for (int i = 0; i < seconds * 10; ++i, us += 100'000) builder.addFrame(us, values);
  };
  hold(1.0, 0.0F);
  hold(50.0, 700.0F);
  hold(2.0, 0.0F);
  hold(6.0, 400.0F);
  hold(20.0, 1500.0F);
  hold(1.0, 0.0F);
  return builder.finish({});
}

TEST(PressureReader, SaysOfAnyFrameWhatTheSeriesSays) {
  const Profile profile = loads();
  const ForceSeries series = forceSeries(profile, creeping());
  PressureReader inOrder(profile, creeping()), here(profile, creeping());
  std::size_t compensated = 0;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    ASSERT_EQ(static_cast<float>(inOrder.at(i).forceN), static_cast<float>(series.forceN(i))) << i;
    compensated += inOrder.at(i).matrices[1].compensated ? 1 : 0;
    const std::size_t elsewhere = i * 617 % profile.numFrames();
    ASSERT_EQ(static_cast<float>(here.at(elsewhere).forceN),
              static_cast<float>(series.forceN(elsewhere)))
        << elsewhere;
  }
  EXPECT_GT(compensated, 500u) << "creep was taken out";
  EXPECT_GT(series.forceN(400), 1.0);
}

TEST(PressureReader, TakesTareSettingsAndTemperaturesAsTheSeriesDoes) {
  const Profile profile = synthesize({.durationS = 6.0, .grasps = 2, .noiseCounts = 12.0});
  Tare tare;
  tare.zero.assign(profile.layout().numCells(), 4.0F);
  tare.matrices.resize(profile.layout().numMatrices());
  PressureMapOptions options;
  options.settings.push_back({0.5, 100.0, true});
  const ForceSeries series = forceSeries(profile, creeping(), options, tare);
  PressureReader reader(profile, creeping(), options, tare);
  for (const std::size_t i : {std::size_t{150}, std::size_t{20}, std::size_t{100}})
    EXPECT_EQ(static_cast<float>(reader.at(i).sdForceN), static_cast<float>(series.sdForceN(i)));
}

TEST(PressureReader, SaysWhatDoesNotGo) {
  const Profile profile = loads();
  EXPECT_THROW(PressureReader(profile, creeping()).at(profile.numFrames()), std::out_of_range);
  EXPECT_THROW(
      PressureReader(filteredProfile(profile, parseRecipe(std::vector<std::string>{"median"})),
                     creeping()),
      Error);
  Tare tare;
  tare.zero.assign(3, 0.0F);
  EXPECT_THROW(PressureReader(profile, creeping(), {}, tare), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::pressure_reader_test
