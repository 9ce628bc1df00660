#include "palpate/batch/derived_series.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/profile_builder.h"
#include "palpate/slip/slip_segments.h"

namespace palpate::derived_series_test {
namespace {

Profile onePad(const std::vector<std::vector<float>>& frames) {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(2, 3, 2.0), MatrixLayout::full(1, 2, 5.0)});
  ProfileBuilder builder(layout);
  std::int64_t timeUs = 1'000;
  for (const auto& values : frames) builder.addFrame(timeUs += 10'000, values);
  return builder.finish({});
}

std::map<std::string, double> nextRow(ExportedSeries& series) {
  std::vector<double> values(series.columns().size());
  std::int64_t timeUs = 0;
  EXPECT_TRUE(series.next(timeUs, values));
  std::map<std::string, double> row{{"time", static_cast<double>(timeUs)}};
  for (std::size_t i = 0; i < values.size(); ++i) row[series.columns()[i].name] = values[i];
  return row;
}

TEST(DerivedSeries, signalsAreThoseOfEachMatrixAndOfAllTogether) {
  const Profile profile = onePad({{0, 0, 0, 0, 0, 0, 0, 0}, {10, 0, 30, 0, 0, 0, 8, 0}});
  const auto all = derivedSeries(profile, {.withSlip = false});
  ASSERT_EQ(all.size(), 1u);
  ExportedSeries& signals = *all[0];
  EXPECT_EQ(signals.name(), "signals");
  EXPECT_EQ(signals.numRows(), 2u);
  ASSERT_EQ(signals.columns().size(), 21u);  // seven of each matrix, and of both
  EXPECT_EQ(nextRow(signals).at("m0/sum"), 0.0);
  const auto row = nextRow(signals);
  EXPECT_EQ(row.at("time"), 21'000.0);
  EXPECT_EQ(row.at("m0/mean"), 20.0);
  EXPECT_EQ(row.at("m0/min"), 10.0);
  EXPECT_EQ(row.at("m0/max"), 30.0);
  EXPECT_EQ(row.at("m0/sum"), 40.0);
  EXPECT_EQ(row.at("m0/active"), 2.0);
  EXPECT_EQ(row.at("m0/area_mm2"), 8.0);
  EXPECT_EQ(row.at("m1/mean"), 8.0);
  EXPECT_EQ(row.at("m1/area_mm2"), 25.0);
  EXPECT_EQ(row.at("whole/mean"), 16.0);
  EXPECT_EQ(row.at("whole/active"), 3.0);
  std::int64_t timeUs = 0;
  std::vector<double> values(21);
  EXPECT_FALSE(signals.next(timeUs, values));
}

TEST(DerivedSeries, theUnitsAreThoseOfTheHandAndOfEachColumn) {
  const auto all = derivedSeries(onePad({}));
  ASSERT_EQ(all.size(), 2u);
  std::map<std::string, std::string> units;
  for (const auto& series : all)
    for (const auto& column : series->columns())
      units[series->name() + " " + column.name] = column.unit;
  EXPECT_EQ(units.at("signals m0/mean"), "counts");
  EXPECT_EQ(units.at("signals m1/active"), "taxels");
  EXPECT_EQ(units.at("signals whole/area_mm2"), "mm^2");
  EXPECT_EQ(units.at("slip m1/ref_dx"), "taxels");
  EXPECT_EQ(units.at("slip m0/rotation_deg"), "deg");
  EXPECT_EQ(units.at("slip m0/p_moved"), "");
}

// The detector is run over the same frames by the function that the commands use.
TEST(DerivedSeries, slipIsWhatTheDetectorSaysOfEveryFrame) {
  const Profile profile = synthesize({.durationS = 4.0, .grasps = 1, .noiseCounts = 4.0});
  const auto all = derivedSeries(profile, {.withSignals = false});
  ASSERT_EQ(all.size(), 1u);
  ExportedSeries& slip = *all[0];
  EXPECT_EQ(slip.name(), "slip");
  std::size_t known = 0;
  std::size_t untouched = 0;
  runSlipDetector(
      profile,
      {},
      [&](std::size_t, std::int64_t timeUs, const std::vector<SlipDetection>& detections) {
        const auto row = nextRow(slip);
        EXPECT_EQ(row.at("time"), static_cast<double>(timeUs));
        for (std::size_t m = 0; m < detections.size(); ++m) {
          const std::string matrix = "m" + std::to_string(m) + "/";
          const SlipDetection& detection = detections[m];
          EXPECT_EQ(row.at(matrix + "active"), static_cast<double>(detection.motion.active));
          EXPECT_EQ(row.at(matrix + "slipping"), detection.slipping ? 1.0 : 0.0);
          if (detection.motion.active == 0) {
            ++untouched;
            for (const char* name : {"dx", "ref_dy", "rotation_deg", "confidence", "state"})
              EXPECT_TRUE(std::isnan(row.at(matrix + name))) << name;
            continue;
          }
          EXPECT_EQ(row.at(matrix + "state"), static_cast<double>(detection.state));
          if (detection.motion.valid) {
            ++known;
            EXPECT_EQ(row.at(matrix + "dx"), detection.motion.dx);
            EXPECT_EQ(row.at(matrix + "dy"), detection.motion.dy);
          } else {
            EXPECT_TRUE(std::isnan(row.at(matrix + "dx")));
          }
        }
      });
  EXPECT_GT(known, 20u);
  EXPECT_GT(untouched, 20u);
}

}  // namespace
}  // namespace palpate::derived_series_test
