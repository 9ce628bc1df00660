#include "palpate/calibration/noise_floor.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::noise_floor_test {
namespace {

// methods.md section 4, to the digits given.
TEST(NoiseFloor, GivesTheStudysNumbersOfTheRealRecording) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const NoiseFloor floor =
      fitNoiseFloor(openRecording(*recordings / "calibration_noise/temperature-noise.dsa"));
  ASSERT_EQ(floor.lines.size(), 6u);
  const double slopes[] = {.3317, .1999, .3604, .1632, .4078, .1741};
  const double intercepts[] = {33.628, 42.565, 41.551, 40.170, 30.616, 45.296};
  const double rmses[] = {2.425417, .708428, 2.894096, .930476, 2.646151, .850922};
  for (std::size_t m = 0; m < 6; ++m) {
    const NoiseLine& line = floor.lines[m];
    EXPECT_TRUE(line.valid);
    EXPECT_NEAR(line.slope, slopes[m], 5e-5) << m;
    EXPECT_NEAR(line.intercept, intercepts[m], 5e-4) << m;
    EXPECT_NEAR(line.rmse, rmses[m], 5e-7) << m;
    EXPECT_GE(line.rmseTrue, 1.005 * line.rmse) << m;
    EXPECT_LE(line.rmseTrue, 1.105 * line.rmse) << m;
    EXPECT_EQ(line.bins.size(), 20u);
    EXPECT_EQ(line.numFrames, 1297u);
    EXPECT_NEAR(line.threshold(40.0), line.intercept + 40.0 * line.slope + 3.0 * line.rmse, 1e-12);
  }
}

// Maximum y = 30 + 0.4 T with normal noise.
void makeLine(double sd,
              std::vector<double>& degC,
              std::vector<double>& counts,
              std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    degC.push_back(25.0 + 30.0 * i / 2000.0);
    counts.push_back(30.0 + 0.4 * degC.back() + sd * normal(random));
  }
}

TEST(NoiseFloor, FindsAKnownLine) {
  std::vector<double> degC, counts;
  makeLine(2.0, degC, counts);
  const NoiseLine line = fitNoiseLine(degC, counts);
  EXPECT_NEAR(line.slope, 0.4, 0.02);
  EXPECT_NEAR(line.at(40.0), 46.0, 0.2);
  EXPECT_NEAR(line.rmse, 2.0, 0.1);
  EXPECT_NEAR(line.rmseTrue, line.rmse, 0.02);
  EXPECT_TRUE(line.covers(30.0));
  EXPECT_FALSE(line.covers(56.0));
}

TEST(NoiseFloor, PredictionIntervalHoldsNewFrames) {
  std::vector<double> degC, counts, newDegC, newCounts;
  makeLine(2.0, degC, counts);
  makeLine(2.0, newDegC, newCounts, 2);
  const NoiseLine line = fitNoiseLine(degC, counts);
  int inside = 0;
  for (std::size_t i = 0; i < newDegC.size(); ++i)
    inside += std::abs(newCounts[i] - line.at(newDegC[i])) <= line.predictionHalfWidth(newDegC[i])
                  ? 1
                  : 0;
  EXPECT_NEAR(inside / 2000.0, 0.95, 0.015);
}

TEST(NoiseFloor, CountsFramesThatStandOut) {
  std::vector<double> degC, counts;
  makeLine(1.0, degC, counts);
  counts[700] += 200.0;
  const NoiseLine line = fitNoiseLine(degC, counts);
  EXPECT_EQ(line.numOutliers, 1u);
  EXPECT_NE(line.notes.at(0).find("touched"), std::string::npos);
}

TEST(NoiseFloor, SaysWhatOneTemperatureOrSilenceAllows) {
  const std::vector<double> one(50, 31.25);
  std::vector<double> counts(50, 40.0);
  counts[3] = 42.0;
  const NoiseLine flat = fitNoiseLine(one, counts);
  EXPECT_FALSE(flat.valid);
  EXPECT_NEAR(flat.at(31.25), 40.04, 1e-9);
  EXPECT_NE(flat.notes.at(0).find("one temperature only"), std::string::npos);
  // 49 times 40 and once 42: mean 40.04, standard deviation sqrt(0.08).
  EXPECT_NE(flat.notes.at(0).find("the mean is 40.0 counts, sd 0.3."), std::string::npos)
      << flat.notes.at(0);
  std::vector<double> rising, zeros(50, 0.0);
  for (int i = 0; i < 50; ++i) rising.push_back(30.0 + i);
  EXPECT_NE(fitNoiseLine(rising, zeros).notes.at(0).find("reads 0"), std::string::npos);
  const NoiseLine none = fitNoiseLine({}, {});
  EXPECT_FALSE(none.valid);
  EXPECT_TRUE(std::isnan(none.predictionHalfWidth(30.0)));
  // Two points: no spread in any bin.
  EXPECT_FALSE(fitNoiseLine(std::vector{30.0, 40.0}, std::vector{50.0, 55.0}).valid);
}

TEST(NoiseFloor, LeavesOutWhatIsNoNumberAndSensorsThatHaveNotReported) {
  std::vector<double> degC, counts;
  makeLine(2.0, degC, counts);
  const NoiseLine whole = fitNoiseLine(degC, counts);
  degC.insert(degC.end(), {0.0, std::nan(""), 30.0});
  counts.insert(counts.end(), {500.0, 500.0, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(fitNoiseLine(degC, counts).slope, whole.slope);
}

TEST(NoiseFloor, SaysThatTemperaturesAreMissing) {
  ProfileBuilder builder(sdh2().layout);
  builder.addFrame(1, std::vector<float>(sdh2().layout->numCells(), 40.0F));
  const NoiseFloor floor = fitNoiseFloor(builder.finish({}));
  ASSERT_EQ(floor.lines.size(), 6u);
  EXPECT_FALSE(floor.lines[0].valid);
  EXPECT_NE(floor.notes.at(0).find("no temperatures"), std::string::npos);
}

TEST(NoiseFloor, PassesThroughXmlAndJson) {
  NoiseFloor floor;
  for (std::size_t m = 0; m < 2; ++m) {
    NoiseLine line;
    line.matrix = m;
    line.slope = 0.35 + static_cast<double>(m);
    line.intercept = 38.0;
    line.rmse = 2.425417;
    line.rmseTrue = 2.5;
    line.valid = true;
    floor.lines.push_back(line);
  }
  const NoiseFloor xml = parseNoiseXml(noiseXml(floor), "noise.xml");
  const NoiseFloor json = noiseFloorFrom(Json::parse(jsonOf(floor).text()));
  for (const NoiseFloor* back : {&xml, &json}) {
    ASSERT_EQ(back->lines.size(), 2u);
    EXPECT_EQ(back->lines[1].slope, 1.35);
    EXPECT_EQ(back->lines[1].intercept, 38.0);
    EXPECT_EQ(back->lines[1].rmse, 2.425417);
    EXPECT_TRUE(back->lines[1].valid);
  }
  EXPECT_EQ(json.lines[0].rmseTrue, 2.5);
}

// Hand-written in the prior program's form (dsa_format.md).
TEST(NoiseFloor, ReadsThePriorProgramsFile) {
  const NoiseFloor floor = parseNoiseXml(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?><calibration><matrix id=\"0\"><slope>0.35</slope>"
      "<intercept>38.00</intercept><RMSE>2.425417</RMSE></matrix></calibration>",
      "n.xml");
  ASSERT_EQ(floor.lines.size(), 1u);
  EXPECT_NEAR(floor.lines[0].threshold(40.0), 0.35 * 40 + 38 + 3 * 2.425417, 1e-12);
}

TEST(NoiseFloor, RefusesFilesThatAreNone) {
  for (const char* bad : {"",
                          "<root/>",
                          "<calibration/>",
                          "<calibration><matrix id=\"0\"></matrix></calibration>",
                          "<calibration><matrix id=\"1\"/></calibration>",
                          "<calibration><matrix id=\"0\"><slope>x</slope></matrix></calibration>"})
    EXPECT_THROW(parseNoiseXml(bad, "n.xml"), FormatError) << bad;
  EXPECT_THROW(noiseFloorFrom(Json::object()), Error);
  EXPECT_THROW(noiseFloorFrom(Json::parse("{\"matrices\":[{\"slope\":1}]}")), Error);
  EXPECT_THROW(fitNoiseLine({}, {}, {.bins = 1}), std::invalid_argument);
  EXPECT_THROW(fitNoiseLine(std::vector{1.0}, {}), std::invalid_argument);
}

// 100 s at 10 frames/s from 30 deg C to `lastDegC`; matrix 1 rests at 20 counts, which rise by 0.5
// per deg C, and is touched with `load` in the last `touchedS` seconds.
NoiseFloor floorOf(double lastDegC, float load, int touchedS) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t us = 1'000'000 + 100'000LL * i;
    const double degC = 30.0 + (lastDegC - 30.0) * i / 999.0;
    TactileFrame frame(sdh2().layout);
    frame.matrix(1)(7, 2) = static_cast<float>(20.0 + 0.5 * (degC - 30.0) + i % 2) +
                            (i >= 1000 - 10 * touchedS ? load : 0.0F);
    builder.addFrame(us, frame.values);
    builder.addTemperatures(us, std::vector<double>(sdh2().temperatureSensors.size(), degC));
  }
  return fitNoiseFloor(builder.finish({}));
}

TEST(NoiseFloor, SaysWhichMatrixWasTouched) {
  const NoiseFloor free = floorOf(31.0, 0.0F, 0);
  EXPECT_EQ(free.notAtRest, "");
  EXPECT_TRUE(free.lines.at(1).atRest);
  const NoiseFloor touched = floorOf(31.0, 50.0F, 40);
  EXPECT_NE(touched.notAtRest.find("touched or moved in 40 % of the time"), std::string::npos)
      << touched.notAtRest;
  EXPECT_FALSE(touched.lines.at(1).atRest);
  EXPECT_TRUE(touched.lines.at(0).atRest);
  EXPECT_EQ(floorOf(31.0, 50.0F, 5).notAtRest, "") << "nine tenths at rest are enough";
  EXPECT_EQ(floorOf(70.0, 0.0F, 0).notAtRest, "") << "20 counts more, since it became warmer";
  EXPECT_NE(floorOf(70.0, 500.0F, 40).notAtRest, "");
  const NoiseFloor read = noiseFloorFrom(jsonOf(touched));
  EXPECT_EQ(read.notAtRest, touched.notAtRest);
  EXPECT_FALSE(read.lines.at(1).atRest);
}

TEST(NoiseFloor, TellsNoiseFromGraspsInRealRecordings) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  EXPECT_EQ(fitNoiseFloor(openRecording(*recordings / "calibration_noise/temperature-noise.dsa"))
                .notAtRest,
            "");
  const NoiseFloor grasps = fitNoiseFloor(openRecording(*recordings / "grasps/foam_ball.dsa"));
  for (std::size_t m = 0; m < grasps.lines.size(); ++m)
    EXPECT_EQ(grasps.lines[m].atRest, m != 1 && m != 5) << m;
}

}  // namespace
}  // namespace palpate::noise_floor_test
