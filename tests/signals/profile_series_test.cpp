#include "palpate/signals/profile_series.h"

#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/signals/formula.h"
#include "palpate/signals/signal_name.h"
#include "palpate/signals/signal_overview.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::profile_series_test {
namespace {

using Kind = SeriesChoice::Kind;
constexpr std::int64_t kStartUs = 1'400'000'000'000'000;

// Ten frames 100 ms apart; frame i: 10 * (i + 1) counts at (7, 2), 4 * i at (8, 3) of matrix 1.
// Angles every 40 ms from 20 ms before the first frame; axis 3 goes up by a degree each.
// Temperatures: sensor 2 says nothing.
Profile small() {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 10; ++i) {
    TactileFrame frame(sdh2().layout);
    frame.matrix(1)(7, 2) = 10.0F * static_cast<float>(i + 1);
    frame.matrix(1)(8, 3) = 4.0F * static_cast<float>(i);
    builder.addFrame(kStartUs + i * 100'000, frame.values);
  }
  for (int i = 0; i < 20; ++i) {
    std::vector<double> deg(7, 1.0);
    deg[3] = i;
    builder.addAngles(kStartUs - 20'000 + i * 40'000, deg);
  }
  for (int i = 0; i < 2; ++i) {
    std::vector<double> degC(9, 30.0 + i);
    degC[2] = 0.0;
    builder.addTemperatures(kStartUs + i * 500'000, degC);
  }
  return builder.finish({});
}

TEST(ProfileSeries, OfAMatrixIsItsSignal) {
  const Profile profile = small();
  const Series series = readSeries(profile, {Kind::kMatrix, 1, SignalKind::kMaximum}, -1.0, 9.0);
  ASSERT_EQ(series.values.size(), 10u);
  EXPECT_DOUBLE_EQ(series.timeS[4], 0.4);
  EXPECT_DOUBLE_EQ(series.values[4], 50.0);
  const Series whole = readSeries(profile, {Kind::kMatrix, 6, SignalKind::kSum}, 0.0, 9.0);
  EXPECT_DOUBLE_EQ(whole.values[4], 66.0);
}

TEST(ProfileSeries, ComponentsAreThoseOfMatricesWithReadings) {
  MatrixLayout matrix = MatrixLayout::full(1, 1, 2.0);
  matrix.touch = {.components = 3, .isSigned = true};
  ProfileBuilder builder(std::make_shared<SensorLayout>(std::vector{matrix}));
  const std::vector<float> readings = {3.0F, -4.0F, -12.0F};
  builder.addReadings(kStartUs, readings);
  const Profile profile = builder.finish({});
  for (const auto& [name, value] :
       {std::pair("m0_x", 3.0), {"m0_y", -4.0}, {"m0_z", -12.0}, {"m0_norm", 13.0}}) {
    const auto choice = signalNamed(name, profile);
    ASSERT_TRUE(choice) << name;
    EXPECT_EQ(nameOf(*choice, profile.layout()), name);
    EXPECT_EQ(readSeries(profile, *choice, 0.0, 1.0).values, std::vector<double>{value}) << name;
    EXPECT_FALSE(signalNamed(name, small())) << "an SDH-2 has none";
  }
  EXPECT_FALSE(signalNamed("hand_x", profile)) << "each matrix has axes of its own";
  EXPECT_FALSE(hasSeries(profile, {.index = 1, .signal = SignalKind::kX}));
  EXPECT_FALSE(hasSeries(small(), {.index = 0, .signal = SignalKind::kX}));
  EXPECT_EQ(formulaSeries(profile, Formula("m0_x - m0_y"), 0.0, 1.0).values,
            std::vector<double>{7.0});
  SignalOverview overview(profile);
  overview.compute();
  EXPECT_EQ(overview.of(0, SignalKind::kNorm).maximum(0), 13.0F);
  EXPECT_THROW((void)SignalOverview(small()).of(0, SignalKind::kX), std::out_of_range);
}

TEST(ProfileSeries, OfTaxelsIsTheirMean) {
  const Profile profile = small();
  TaxelSelection taxels(profile.layout());
  taxels.toggle(1, 7, 2);
  taxels.toggle(1, 8, 3);
  taxels.toggle(4, 2, 2);
  const SeriesChoice choice{.kind = Kind::kTaxels, .taxels = taxels};
  const Series series = readSeries(profile, choice, 0.0, 0.9);
  EXPECT_DOUBLE_EQ(series.values[5], (60.0 + 20.0 + 0.0) / 3.0);
  EXPECT_EQ(meanOf(profile.frame(5), TaxelSelection(profile.layout())), 0.0);
}

TEST(ProfileSeries, AnglesAndTemperaturesHaveTheirOwnStamps) {
  const Profile profile = small();
  const Series angles = readSeries(profile, {.kind = Kind::kAngle, .index = 3}, -1.0, 9.0);
  ASSERT_EQ(angles.values.size(), 20u);
  EXPECT_DOUBLE_EQ(angles.timeS[0], -0.02);
  EXPECT_DOUBLE_EQ(angles.values[7], 7.0);
  const Series sensor = readSeries(profile, {.kind = Kind::kTemperature, .index = 1}, 0.0, 9.0);
  EXPECT_EQ(sensor.values, (std::vector<double>{30.0, 31.0}));
  const Series silent = readSeries(profile, {.kind = Kind::kTemperature, .index = 2}, 0.0, 9.0);
  EXPECT_TRUE(std::isnan(silent.values[0])) << "an exact 0 is no temperature";
}

TEST(ProfileSeries, APartComesWithItsNeighbours) {
  const Profile profile = small();
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMaximum};
  const Series part = readSeries(profile, choice, 0.25, 0.45);
  EXPECT_EQ(part.values, (std::vector<double>{30.0, 40.0, 50.0, 60.0}));
  EXPECT_EQ(numSamples(profile, choice, 0.25, 0.45), 3u);
  EXPECT_EQ(numSamples(profile, choice, -5.0, 50.0), 10u);
  EXPECT_EQ(numSamples(profile, choice, 1.0, 0.0), 0u);
  EXPECT_TRUE(readSeries(profile, choice, 1.0, 0.0).values.empty());
}

TEST(ProfileSeries, VisitsWhatItReads) {
  const Profile profile = small();
  const SeriesChoice choice{.kind = Kind::kAngle, .index = 3};
  const Series read = readSeries(profile, choice, -100.0, 100.0);
  Series visited;
  visitSeries(profile, choice, [&](double timeS, double value) {
    visited.timeS.push_back(timeS);
    visited.values.push_back(value);
  });
  EXPECT_EQ(visited.timeS, read.timeS);
  EXPECT_EQ(visited.values, read.values);
}

TEST(ProfileSeries, ASpreadTakesSamplesEvenlyAndNoneTwice) {
  const Profile profile = small();
  const SeriesChoice choice{.kind = Kind::kMatrix, .index = 1, .signal = SignalKind::kMaximum};
  const Series three = readSpread(profile, choice, 3);
  EXPECT_EQ(three.timeS, (std::vector<double>{0.0, 0.3, 0.6, 0.9}));
  EXPECT_EQ(three.values, (std::vector<double>{10.0, 40.0, 70.0, 100.0}));
  EXPECT_EQ(readSpread(profile, choice, 1000).timeS.size(), profile.numFrames());
  EXPECT_THROW(readSpread(profile, choice, 0), std::invalid_argument);
  EXPECT_THROW(readSpread(profile, choice, 3, [](double) { return false; }), Cancelled);
}

TEST(ProfileSeries, WhatIsNotThereIsSaid) {
  const Profile profile = small();
  const Profile bare =
      synthesize({.durationS = 1.0, .angleRateHz = 0.0, .temperatureRateHz = 0.0, .grasps = 0});
  EXPECT_TRUE(hasSeries(profile, {.kind = Kind::kAngle, .index = 6}));
  EXPECT_FALSE(hasSeries(profile, {.kind = Kind::kAngle, .index = 7}));
  EXPECT_FALSE(hasSeries(bare, {.kind = Kind::kAngle, .index = 0}));
  EXPECT_FALSE(hasSeries(bare, {.kind = Kind::kTemperature, .index = 0}));
  EXPECT_FALSE(hasSeries(profile, {.kind = Kind::kMatrix, .index = 7}));
  EXPECT_FALSE(hasSeries(profile, {.kind = Kind::kTaxels})) << "none chosen";
  EXPECT_THROW(readSeries(bare, {.kind = Kind::kAngle}, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(visitSeries(bare, {.kind = Kind::kAngle}, [](double, double) {}),
               std::invalid_argument);
  EXPECT_FALSE(hasSeries(ProfileBuilder(sdh2().layout).finish({}), {}));
  EXPECT_EQ(numSamples(bare, {.kind = Kind::kAngle}, 0.0, 1.0), 0u);
}

TEST(ProfileSeries, SaysWhyASeriesIsMissing) {
  const Profile profile = small();
  EXPECT_EQ(whyMissing(profile, {Kind::kMatrix, 1}), "") << "it isn't missing";
  EXPECT_EQ(whyMissing(profile, {.kind = Kind::kAngle, .index = 99}), "");
  EXPECT_NE(whyMissing(profile, {Kind::kMatrix, 1, SignalKind::kX}).find("sends readings"),
            std::string::npos);
  // Computed series say it in their source.
  ProfileBuilder builder(sdh2().layout);
  builder.addSeries({.name = "m1_force",
                     .role = kComputedRole,
                     .columns = {{"n", "N"}},
                     .source = "needs a calibration"});
  builder.addFrame(kStartUs, TactileFrame(sdh2().layout).values);
  EXPECT_EQ(
      whyMissing(builder.finish({}), {.kind = Kind::kColumn, .series = "m1_force", .column = "n"}),
      "needs a calibration");
}

TEST(ProfileSeries, CanBeCancelled) {
  EXPECT_THROW(readSeries(small(), {}, 0.0, 9.0, [](double) { return false; }), Cancelled);
}

TEST(ProfileSeries, AFormulaIsASeriesToo) {
  const Profile profile = synthesize({.durationS = 4.0, .grasps = 1});
  const SeriesChoice sum{.index = profile.layout().numMatrices(), .signal = SignalKind::kSum};
  const SeriesChoice twice{.kind = SeriesChoice::Kind::kFormula, .formula = "2*hand_sum + t"};
  ASSERT_TRUE(hasSeries(profile, twice));
  EXPECT_EQ(numSamples(profile, twice, -1e9, 1e9), profile.numFrames());
  for (const auto& [fromS, toS] :
       {std::pair(-1e9, 1e9), std::pair(1.0, 2.0), std::pair(1.5, 1.5)}) {
    const Series plain = readSeries(profile, sum, fromS, toS);
    const Series derived = readSeries(profile, twice, fromS, toS);
    ASSERT_EQ(derived.timeS, plain.timeS);
    for (std::size_t i = 0; i < plain.values.size(); ++i)
      EXPECT_EQ(derived.values[i], 2.0 * plain.values[i] + plain.timeS[i]) << i;
  }
  // A part is the same as that part of the whole: slopes and filters look beyond its ends.
  for (const char* text : {"der(hand_sum)", "smooth(hand_sum, 7)", "lowpass(hand_sum, 8)"}) {
    const SeriesChoice choice{.kind = SeriesChoice::Kind::kFormula, .formula = text};
    const Series whole = readSeries(profile, choice, -1e9, 1e9);
    const Series part = readSeries(profile, choice, 1.8, 2.2);
    ASSERT_GT(part.values.size(), 5u);
    const auto at = static_cast<std::size_t>(
        std::find(whole.timeS.begin(), whole.timeS.end(), part.timeS.front()) -
        whole.timeS.begin());
    for (std::size_t i = 0; i < part.values.size(); ++i)
      // Less than 1e-9 of what lies further away is left.
      EXPECT_NEAR(part.values[i], whole.values.at(at + i), 0.01) << text << i;
    std::size_t visited = 0;
    visitSeries(profile, choice, [&](double timeS, double value) {
      EXPECT_EQ(timeS, whole.timeS.at(visited));
      EXPECT_EQ(value, whole.values.at(visited++));
    });
    EXPECT_EQ(visited, profile.numFrames());
  }
  for (const char* text : {"m9_mean", "1 +", "angle77", "thumb"}) {
    const SeriesChoice choice{.kind = SeriesChoice::Kind::kFormula, .formula = text};
    EXPECT_FALSE(hasSeries(profile, choice)) << text;
    EXPECT_THROW(readSeries(profile, choice, 0.0, 1.0), std::invalid_argument) << text;
  }
}

TEST(ProfileSeries, WhatCannotBeReadIsNoNumberAndCounted) {
  const Profile damaged = testing::withDamage(small(), 3, 4);
  const SeriesChoice choice{Kind::kMatrix, 1, SignalKind::kMaximum};
  EXPECT_THROW(readSeries(damaged, choice, -1.0, 10.0), FormatError);
  UnreadableSamples unreadable;
  const Series series = readSeries(damaged, choice, -1.0, 10.0, {}, &unreadable);
  EXPECT_EQ(unreadable.runs, (std::vector<UnreadableSamples::Run>{{3, 4}}));
  ASSERT_EQ(series.values.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(series.timeS[i], 0.1 * static_cast<double>(i), 1e-9);
    if (i == 3 || i == 4) {
      EXPECT_TRUE(std::isnan(series.values[i]));
    } else {
      EXPECT_EQ(series.values[i], 10.0 * static_cast<double>(i + 1));
    }
  }
  UnreadableSamples visited;
  std::size_t numbers = 0;
  visitSeries(
      damaged, choice, [&](double, double value) { numbers += !std::isnan(value); }, {}, &visited);
  EXPECT_EQ(numbers, 8u);
  EXPECT_EQ(visited.count, 2u);
  UnreadableSamples spread;
  EXPECT_EQ(readSpread(damaged, choice, 9, {}, &spread).timeS.size(), 10u);
  EXPECT_EQ(spread.count, 2u);
  EXPECT_EQ(spread.runs, (std::vector<UnreadableSamples::Run>{{3, 4}}));
  // Many steps come to each sample, and few to none but theirs.
  UnreadableSamples dense;
  EXPECT_EQ(readSpread(damaged, choice, 100, {}, &dense).timeS.size(), 10u);
  EXPECT_EQ(dense.count, 2u);
  UnreadableSamples sparse;
  readSpread(damaged, choice, 2, {}, &sparse);
  EXPECT_EQ(sparse.runs, (std::vector<UnreadableSamples::Run>{{4, 4}}));
}

TEST(ProfileSeries, AColumnOfAFurtherSeriesHasItsOwnStamps) {
  const Profile profile = testing::withWrist(small(), 20);
  const SeriesChoice fz{.kind = Kind::kColumn, .series = "wrist", .column = "fz"};
  ASSERT_TRUE(hasSeries(profile, fz));
  const Series series = readSeries(profile, fz, -1.0, 9.0);
  ASSERT_EQ(series.values.size(), 20u);
  EXPECT_DOUBLE_EQ(series.timeS[0], 0.03);
  EXPECT_DOUBLE_EQ(series.timeS[4], 0.23);
  EXPECT_EQ(series.values[4], -8.0);
  EXPECT_TRUE(std::isnan(series.values[3])) << "not known";
  const SeriesChoice torque{.kind = Kind::kColumn, .series = "wrist", .column = "Torque Z"};
  EXPECT_EQ(readSeries(profile, torque, -1.0, 9.0).values, std::vector<double>(20, 0.0))
      << "0 is a value, unlike of a temperature";
  EXPECT_EQ(numSamples(profile, fz, 0.1, 0.3), 5u);
  EXPECT_EQ(readSpread(profile, fz, 1000).timeS.size(), 18u) << "up to the last frame";
  std::size_t visited = 0;
  visitSeries(profile, torque, [&](double, double) { ++visited; });
  EXPECT_EQ(visited, 20u);
}

TEST(ProfileSeries, WithoutFramesAFurtherSeriesBeginsAtItsFirstSample) {
  ProfileBuilder builder(sdh2().layout);
  const std::size_t wrist = builder.addSeries(testing::wristSeries());
  for (int i = 0; i < 3; ++i)
    builder.addSample(wrist, kStartUs + i * 1'000'000, std::vector{1.0 * i, 2.0, 3.0});
  const SeriesChoice fx{.kind = Kind::kColumn, .series = "wrist", .column = "fx"};
  const Series series = readSeries(builder.finish({}), fx, -1.0, 9.0);
  EXPECT_EQ(series.timeS, (std::vector{0.0, 1.0, 2.0}));
  EXPECT_EQ(series.values, (std::vector{0.0, 1.0, 2.0}));
}

TEST(ProfileSeries, AFurtherSeriesIsFoundByItsName) {
  const auto choice = [](const char* series, const char* column) {
    return SeriesChoice{.kind = Kind::kColumn, .series = series, .column = column};
  };
  const Profile profile = testing::withWrist(small());
  EXPECT_EQ(columnOf(profile, choice("wrist", "fz"))->column, 1u);
  EXPECT_EQ(columnOf(profile, choice("wrist", "fz"))->series, kHandSeries);
  EXPECT_FALSE(hasSeries(profile, choice("wrist", "FZ")));
  EXPECT_FALSE(hasSeries(profile, choice("ankle", "fz")));
  EXPECT_FALSE(hasSeries(small(), choice("wrist", "fz")));
  EXPECT_THROW(readSeries(small(), choice("wrist", "fz"), 0.0, 1.0), std::invalid_argument);
  EXPECT_EQ(numSamples(small(), choice("wrist", "fz"), 0.0, 1.0), 0u);
  EXPECT_FALSE(hasSeries(testing::withWrist(small(), 0), choice("wrist", "fz"))) << "no samples";
}

}  // namespace
}  // namespace palpate::profile_series_test
