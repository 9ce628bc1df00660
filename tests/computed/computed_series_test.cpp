#include "palpate/computed/computed_series.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "palpate/calibration/force_series.h"
#include "palpate/device/sdh2.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/profile_builder.h"
#include "palpate/signals/formula.h"
#include "palpate/signals/profile_series.h"
#include "palpate/signals/signal_name.h"

#include "testing/damaged_profile.h"

namespace palpate::computed_series_test {
namespace {

// P = .1 K [kPa], whatever the temperature.
Calibration tenth(double indenterAreaMm2) {
  Calibration calibration;
  int i = 0;
  for (const double t : {28.0, 36.0, 44.0})
    for (double k = 50.0; k <= 850.0; k += 100.0)
      calibration.samples.push_back({.file = "a",
                                     .sha256 = "",
                                     .pressureKpa = 0.1 * k + (i++ % 2 == 0 ? 0.01 : -0.01),
                                     .staticResponseCounts = k,
                                     .driftCountsPerS = 0.0,
                                     .nearestDegC = t,
                                     .activeAreaMm2 = 220.5});
  PressureModelOptions options;
  options.indenterAreaMm2 = indenterAreaMm2;
  calibration.pressure = fitPressureModel(calibration.samples, options);
  return calibration;
}

// Frames 50 ms apart; in every second one matrix 2 reads `counts` everywhere, and in all of them
// matrix 0 has one taxel, which moves down by a row per frame.
Profile recorded(float counts = 400.0F, bool angles = true) {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand);
  for (int i = 0; i < 10; ++i) {
    TactileFrame frame(hand.layout);
    if (i % 2 == 1) frame.matrix(2).setConstant(counts);
    frame.matrix(0)(i, 3) = 500.0F;
    builder.addFrame(1'000'000 + i * 50'000, frame.values);
  }
  builder.addTemperatures(1'000'000, std::vector<double>(hand.temperatureSensors.size(), 36.0));
  if (angles) builder.addAngles(1'000'000, std::vector<double>(hand.axes.size(), 0.0));
  return builder.finish({});
}

Series read(const Profile& profile, const std::string& name) {
  const auto choice = signalNamed(name, profile);
  if (!choice || !hasSeries(profile, *choice)) return {};
  return readSeries(profile, *choice, -1e9, 1e9);
}

std::string refusal(const Profile& profile, const std::string& formula) {
  try {
    (void)formulaSeries(profile, Formula(formula), 0.0, 9.0);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(ComputedSeries, ForcesAndPressuresAreThoseOfTheForceSeries) {
  const Calibration calibration = tenth(110.0);
  const Profile profile = withComputedSeries(recorded(), {.calibration = calibration});
  const ForceSeries expected = forceSeries(recorded(), calibration);
  const Series force = read(profile, "m2_force_n"), hand = read(profile, "hand_force_n");
  const Series pressure = read(profile, "m2_pressure_kpa");
  const Series most = read(profile, "m2_pressure_max_kpa");
  ASSERT_EQ(force.values.size(), 10u);
  ASSERT_EQ(hand.values.size(), 10u);
  ASSERT_EQ(pressure.values.size(), 10u);
  EXPECT_DOUBLE_EQ(force.timeS[3], 0.15);
  std::size_t known = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    const MatrixForce& row = expected.at(i, 2);
    EXPECT_EQ(std::isnan(force.values[i]), row.active > 0 && !row.inRange) << i;
    if (std::isnan(force.values[i])) continue;
    EXPECT_EQ(force.values[i], static_cast<double>(row.forceN)) << i;
    EXPECT_EQ(pressure.values[i], static_cast<double>(row.kpa)) << i;
    EXPECT_GE(most.values[i], 0.0) << i;
    known += row.active > 0 ? 1 : 0;
    // The whole hand's is known where that of every matrix is.
    const bool all = std::ranges::all_of(std::vector<std::size_t>{0, 1, 2, 3, 4, 5}, [&](auto m) {
      return expected.at(i, m).active == 0 || expected.at(i, m).inRange;
    });
    EXPECT_EQ(std::isnan(hand.values[i]), !all) << i;
    if (all) {
      EXPECT_NEAR(hand.values[i], expected.forceN(i), 1e-4) << i;
    }
  }
  EXPECT_EQ(known, 5u);
}

TEST(ComputedSeries, WithoutTheAreaOfTheIndenterOnlyPressuresAreKnown) {
  const Profile profile = withComputedSeries(recorded(), {.calibration = tenth(0.0)});
  EXPECT_TRUE(std::isnan(read(profile, "m2_force_n").values.at(1)));
  EXPECT_EQ(read(profile, "m2_force_n").values.at(2), 0.0) << "nothing touches it";
  EXPECT_GT(read(profile, "m2_pressure_kpa").values.at(1), 0.0);
}

TEST(ComputedSeries, CentroidsAreInMillimetresFromTheFirstTaxel) {
  const Profile profile = withComputedSeries(recorded(), {});
  const double pitchMm = profile.layout().matrix(0).pitchMm.x;
  const Series x = read(profile, "m0_centroid_x_mm"), y = read(profile, "m0_centroid_y_mm");
  ASSERT_EQ(x.values.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(x.values[i], 3.0 * pitchMm, 1e-4);
    EXPECT_NEAR(y.values[i], static_cast<double>(i) * pitchMm, 1e-4);
  }
  EXPECT_TRUE(std::isnan(read(profile, "m4_centroid_x_mm").values.at(0))) << "not touched";
}

// A pad of taxels 2 mm apart along a row and 5 mm along a column, touched by one that moves down.
TEST(ComputedSeries, TaxelsThatAreNotSquareHaveTwoPitches) {
  HandDescription pad;
  pad.name = "pad";
  pad.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(6, 6, TaxelPitch(2.0, 5.0))});
  pad.matrices.resize(1);
  ProfileBuilder builder(pad);
  for (int i = 0; i < 4; ++i) {
    TactileFrame frame(pad.layout);
    frame.matrix(0)(1 + i, 3) = 500.0F;
    builder.addFrame(1'000'000 + i * 50'000, frame.values);
  }
  const Profile source = builder.finish({});
  const Profile profile = withComputedSeries(source, {});
  const Series x = read(profile, "m0_centroid_x_mm"), y = read(profile, "m0_centroid_y_mm");
  const Series speed = read(profile, "m0_slip_speed_mm_s"), slip = read(profile, "m0_slip_mm");
  const SlipSeries taxels = slipSeries(source);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(x.values.at(i), 3.0 * 2.0, 1e-4);
    EXPECT_NEAR(y.values.at(i), static_cast<double>(1 + i) * 5.0, 1e-4);
    const SlipSample* sample = taxels.at(0, i);
    ASSERT_NE(sample, nullptr);
    if (sample->valid && i > 0) {
      const double stepMm =
          std::hypot(2.0 * static_cast<double>(sample->dx), 5.0 * static_cast<double>(sample->dy));
      EXPECT_NEAR(speed.values.at(i), stepMm / 0.05, 1e-3);
    }
    if (sample->refValid) {
      const double shiftMm = std::hypot(2.0 * static_cast<double>(sample->refDx),
                                        5.0 * static_cast<double>(sample->refDy));
      EXPECT_NEAR(slip.values.at(i), shiftMm, 1e-3);
    }
  }
}

TEST(ComputedSeries, TheSphereOfOneTaxelIsThatTaxel) {
  const Profile profile = withComputedSeries(recorded(), {});
  const HandGeometry geometry(describeGeometry(sdh2()));
  const HandPose pose = geometry.pose(std::vector<double>(sdh2().axes.size(), 0.0));
  for (const std::size_t frame : {0u, 4u}) {
    const Eigen::Vector3d& place = pose.positionMm(0, static_cast<int>(frame), 3);
    EXPECT_NEAR(read(profile, "hand_sphere_diameter_mm").values.at(frame), 0.0, 1e-4);
    EXPECT_NEAR(read(profile, "hand_sphere_x_mm").values.at(frame), place.x(), 1e-3);
    EXPECT_NEAR(read(profile, "hand_sphere_y_mm").values.at(frame), place.y(), 1e-3);
    EXPECT_NEAR(read(profile, "hand_sphere_z_mm").values.at(frame), place.z(), 1e-3);
  }
}

TEST(ComputedSeries, SlipIsInMillimetresAndMillimetresPerSecond) {
  const Profile source = recorded();
  const Profile profile = withComputedSeries(source, {});
  const SlipSeries expected = slipSeries(source);
  const Series speed = read(profile, "m0_slip_speed_mm_s"), slip = read(profile, "m0_slip_mm");
  ASSERT_EQ(speed.values.size(), 10u);
  ASSERT_EQ(slip.values.size(), 10u);
  const double pitchMm = source.layout().matrix(0).pitchMm.x;
  EXPECT_TRUE(std::isnan(speed.values[0])) << "there is no frame before";
  for (std::size_t i = 1; i < 10; ++i) {
    const SlipSample* sample = expected.at(0, i);
    ASSERT_NE(sample, nullptr);
    EXPECT_EQ(std::isnan(speed.values[i]), !sample->valid) << i;
    if (sample->valid) {
      const double stepMm =
          std::hypot(static_cast<double>(sample->dx), static_cast<double>(sample->dy)) * pitchMm;
      EXPECT_NEAR(speed.values[i], stepMm / 0.05, 1e-3) << i;
    }
    EXPECT_EQ(std::isnan(slip.values[i]), !sample->refValid) << i;
    if (sample->refValid) {
      EXPECT_NEAR(slip.values[i], sample->shiftTaxels() * pitchMm, 1e-4) << i;
    }
  }
  EXPECT_TRUE(std::isnan(read(profile, "m4_slip_mm").values.at(5))) << "not touched";
}

TEST(ComputedSeries, WhatIsMissingIsSaidWithItsRemedy) {
  const Profile plain = recorded(400.0F, false);
  for (const ComputedSeries& series : computedSeries(plain, {})) {
    const std::string& name = series.description.name;
    EXPECT_EQ(series.description.role, kComputedRole);
    EXPECT_EQ(series.captions.size(), series.description.columns.size()) << name;
    if (name.ends_with("_force") || name.ends_with("_pressure")) {
      EXPECT_NE(series.missing.find("--calibration C.json"), std::string::npos) << name;
    } else if (name == "hand_sphere") {
      EXPECT_NE(series.missing.find("joint angles"), std::string::npos);
    } else {
      EXPECT_EQ(series.missing, "") << name;
    }
  }
  const Profile profile = withComputedSeries(plain, {});
  EXPECT_NE(refusal(profile, "hand_force_n - m1_sum").find("needs a calibration: --calibration"),
            std::string::npos);
  EXPECT_NE(refusal(profile, "hand_sphere_x_mm").find("needs joint angles"), std::string::npos);
  EXPECT_NE(refusal(profile, "wrist_fz").find("hand_force_n, hand_sphere_diameter_mm, t"),
            std::string::npos)
      << refusal(profile, "wrist_fz");
  EXPECT_EQ(refusal(profile, "m0_centroid_x_mm"), "");
}

TEST(ComputedSeries, AFormulaTakesThemWithWhatWasRecorded) {
  const Profile profile = withComputedSeries(recorded(), {.calibration = tenth(110.0)});
  const Series difference = formulaSeries(profile, Formula("2*m2_force_n - m2_mean"), 0.0, 9.0);
  const Series force = read(profile, "m2_force_n");
  ASSERT_EQ(difference.values.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(difference.values[i], 2.0 * force.values[i] - (i % 2 == 1 ? 400.0 : 0.0), 1e-9);
}

TEST(ComputedSeries, NothingIsComputedBeforeItIsWanted) {
  const Profile profile = withComputedSeries(recorded(), {});
  const auto series = profile.seriesNamed("m1_centroid"), slip = profile.seriesNamed("m1_slip");
  ASSERT_TRUE(series && slip);
  EXPECT_FALSE(profile.isReady(*series));
  EXPECT_FALSE(isReady(profile, *signalNamed("m1_centroid_x_mm", profile)));
  EXPECT_FALSE(
      isReady(profile, {.kind = SeriesChoice::Kind::kFormula, .formula = "2*m1_centroid_x_mm"}));
  EXPECT_THROW(profile.prepare(*series, [](double) { return false; }), Cancelled);
  EXPECT_FALSE(profile.isReady(*series)) << "cancelled";
  profile.prepare(*series);
  EXPECT_TRUE(profile.isReady(*series));
  EXPECT_TRUE(isReady(profile, *signalNamed("m1_centroid_x_mm", profile)));
  EXPECT_TRUE(isReady(profile, *signalNamed("m1_mean", profile)));
  EXPECT_FALSE(profile.isReady(*slip)) << "another kind";
}

TEST(ComputedSeries, ADamagedFrameIsNotKnownAndCostsNoOther) {
  const Profile damaged = testing::withDamage(recorded(), 4, 4);
  const Profile profile = withComputedSeries(damaged, {.calibration = tenth(110.0)});
  for (const char* name : {"m0_centroid_x_mm", "m2_pressure_kpa"}) {
    const Series series = read(profile, name);
    ASSERT_EQ(series.values.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_EQ(std::isnan(series.values[i]), i == 4) << name << " " << i;
  }
}

TEST(ComputedSeries, TheRecordingKeepsWhatItHas) {
  ProfileBuilder builder(sdh2());
  builder.addFrame(1'000'000, std::vector<float>(sdh2().layout->numCells(), 0.0F));
  const std::size_t own = builder.addSeries(
      {.name = "hand_force", .role = {}, .columns = {{"n", "N"}}, .source = "load cell"});
  builder.addSample(own, 1'000'000, std::vector<double>{7.5});
  const Profile source = builder.finish({});
  const Profile profile = withComputedSeries(source, {.calibration = tenth(110.0)});
  EXPECT_EQ(read(profile, "hand_force_n").values, std::vector<double>{7.5});
  EXPECT_EQ(profile.frame(0).values, source.frame(0).values);
  EXPECT_EQ(read(profile, "m0_force_n").values, std::vector<double>{0.0});
}

}  // namespace
}  // namespace palpate::computed_series_test
