#include "palpate/interop/signal_json.h"

#include <limits>

#include "palpate/core/json.h"

#include "interop/sample_results.h"
#include "testing/testing.h"

namespace palpate::signal_json_test {
namespace {
using testing::sampleResults;

Json parsed(const LiveResults& results, const LinkHealth* link = nullptr) {
  std::string text;
  appendSignalJson(text, results, 12, link);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  return Json::parse(text);
}

TEST(SignalJson, SaysTheSignalsOfEveryMatrix) {
  LiveResults results = sampleResults();
  const Json json = parsed(results);
  EXPECT_DOUBLE_EQ(json.at("t").asDouble(), 1'416'996'123.250007);
  EXPECT_EQ(json.at("sequence").asInteger(), 12);
  for (int m = 0; m < 6; ++m) {
    const Json matrix = json.at("m" + std::to_string(m));
    ASSERT_TRUE(matrix.isObject()) << m;
    EXPECT_EQ(matrix.at("active").asInteger(), m == 1 ? 2 : 0);
  }
  const Json matrix = json.at("m1");
  EXPECT_EQ(matrix.at("mean").asDouble(), 200.0);
  EXPECT_EQ(matrix.at("min").asDouble(), 100.0);
  EXPECT_EQ(matrix.at("max").asDouble(), 300.0);
  EXPECT_EQ(matrix.at("sum").asDouble(), 400.0);
  EXPECT_NEAR(matrix.at("area_mm2").asDouble(), 2 * 3.4 * 3.4, 1e-9);
  EXPECT_EQ(json.at("whole").at("sum").asDouble(), 400.0);
  EXPECT_EQ(json.at("peak").at("matrix").asInteger(), 1);
  EXPECT_EQ(json.at("peak").at("y").asInteger(), 8);
  EXPECT_EQ(json.at("peak").at("x").asInteger(), 2);
  EXPECT_EQ(json.at("peak").at("value").asDouble(), 300.0);
  EXPECT_EQ(json.at("peak").at("counts").asDouble(), 300.0) << "its older name";
}

// An unknown value is neither null nor zero, because a curve would show it.
TEST(SignalJson, WhatIsNotKnownHasNoKey) {
  const Json json = parsed(sampleResults());
  for (const char* key : {"device_ms", "angles_deg", "temperatures_degc", "link"})
    EXPECT_FALSE(json.contains(key)) << key;
  for (const char* key : {"force_n", "pressure_kpa", "slip"})
    EXPECT_FALSE(json.at("m1").contains(key)) << key;
  EXPECT_FALSE(json.at("whole").contains("force_n"));

  LiveResults results = sampleResults();
  results.slip.resize(6);  // slip is unknown
  const Json slip = parsed(results).at("m1").at("slip");
  EXPECT_EQ(slip.keys(), (std::vector<std::string>{"state", "slipping"}));
  EXPECT_EQ(slip.at("state").asString(), "invalid");
}

TEST(SignalJson, SaysSlipForceAndTheHand) {
  LiveResults results = sampleResults();
  results.slip.resize(6);
  SlipDetection& slip = results.slip[1];
  slip.state = SlipState::kSlip;
  slip.indicator = SlipIndicator::kSlipping;
  slip.slipping = true;
  slip.confidence = 0.75;
  slip.pMoved = 0.9375;
  slip.motion.valid = slip.motion.refValid = true;
  slip.motion.dx = 0.25;
  slip.motion.dy = -0.5;
  slip.motion.refDx = 1.5;
  slip.motion.refDy = -2.0;
  slip.motion.rotation.valid = slip.motion.rotation.refValid = true;
  slip.motion.rotation.rotationDeg = 1.25;
  slip.motion.rotation.refRotationDeg = -12.5;
  auto pressure = std::make_shared<PressureFrame>();
  pressure->matrices.resize(6);
  pressure->matrices[1].kpa = 12.5;
  pressure->matrices[1].forceN = 1.5;
  pressure->matrices[1].inRange = false;
  pressure->forceN = 1.75;
  results.pressure = pressure;
  results.angles = Sample{1, {0.0, -60.5, std::numeric_limits<double>::quiet_NaN()}};
  results.temperatures = Sample{1, {41.25, 38.0}, kTemperatureSeries};
  LinkHealth link;
  link.frames.rateHz = 31.5;
  link.frames.ageMs = 12.0;
  link.lost = 3;
  link.badChecksums = 4;
  link.recorder.state = RecorderStatus::State::kRecording;
  link.recorder.frames = 77;
  link.recorder.framesOnDisk = 76;

  const Json json = parsed(results, &link);
  const Json slipJson = json.at("m1").at("slip");
  EXPECT_EQ(slipJson.at("state").asString(), "slip");
  EXPECT_EQ(slipJson.at("slipping").asInteger(), 1);
  EXPECT_EQ(slipJson.at("confidence").asDouble(), 0.75);
  EXPECT_EQ(slipJson.at("p_moved").asDouble(), 0.9375);
  EXPECT_EQ(slipJson.at("dx").asDouble(), 0.25);
  EXPECT_EQ(slipJson.at("dy").asDouble(), -0.5);
  EXPECT_EQ(slipJson.at("ref_dx").asDouble(), 1.5);
  EXPECT_EQ(slipJson.at("ref_dy").asDouble(), -2.0);
  EXPECT_EQ(slipJson.at("rotation_deg").asDouble(), 1.25);
  EXPECT_EQ(slipJson.at("ref_rotation_deg").asDouble(), -12.5);
  EXPECT_EQ(json.at("m1").at("pressure_kpa").asDouble(), 12.5);
  EXPECT_EQ(json.at("m1").at("force_n").asDouble(), 1.5);
  EXPECT_EQ(json.at("m1").at("in_range").asInteger(), 0);
  EXPECT_EQ(json.at("whole").at("force_n").asDouble(), 1.75);
  // analyst M5: upper limits are not sent as forces.
  pressure->areaKnown = false;
  const Json limits = parsed(results, &link);
  for (const char* key : {"force_n", "force_sd_n"})
    EXPECT_FALSE(limits.at("m1").contains(key)) << key;
  EXPECT_FALSE(limits.at("whole").contains("force_n"));
  EXPECT_EQ(limits.at("m1").at("pressure_kpa").asDouble(), 12.5);
  const Json angles = json.at("angles_deg");
  ASSERT_EQ(angles.size(), 3u);
  EXPECT_EQ(angles.at(1).asDouble(), -60.5);
  EXPECT_TRUE(angles.at(2).isNull());  // the others keep their places
  EXPECT_EQ(json.at("temperatures_degc").at(std::size_t{0}).asDouble(), 41.25);
  EXPECT_EQ(json.at("link").at("rate_hz").asDouble(), 31.5);
  EXPECT_EQ(json.at("link").at("age_ms").asDouble(), 12.0);
  EXPECT_EQ(json.at("link").at("lost").asInteger(), 3);
  EXPECT_EQ(json.at("link").at("bad_checksums").asInteger(), 4);
  EXPECT_EQ(json.at("link").at("recording").asInteger(), 1);
  EXPECT_EQ(json.at("link").at("recorded_frames").asInteger(), 77);
  EXPECT_EQ(json.at("link").at("frames_on_disk").asInteger(), 76);
}

TEST(SignalJson, ComponentsStandOfReadingsOnly) {
  LiveResults results = sampleResults();
  EXPECT_FALSE(parsed(results).at("m1").contains("z"));
  TactileFrame frame = *results.frame;
  frame.readings = {1.0F};
  results.frame = std::make_shared<const TactileFrame>(frame);
  results.matrixSignals.at(1).force = {3.0, -4.0, 12.0};
  const Json json = parsed(results);
  EXPECT_EQ(json.at("m1").at("y").asDouble(), -4.0);
  EXPECT_EQ(json.at("m1").at("norm").asDouble(), 13.0);
  EXPECT_FALSE(json.at("whole").contains("z"));
}

TEST(SignalJson, FurtherSeriesStandByTheirNames) {
  LiveResults results = sampleResults();
  EXPECT_FALSE(parsed(results).contains("series"));
  const auto wrist = std::make_shared<const SeriesDescription>(
      SeriesDescription{"wrist", "", {{"fx", "N"}, {"fy", "N"}, {"\"z\" \\", "N"}}, ""});
  results.further = {{wrist, {1, {1.5, std::numeric_limits<double>::quiet_NaN(), -2.0}, 2}}};
  const Json series = parsed(results).at("series");
  EXPECT_EQ(series.keys(), (std::vector<std::string>{"wrist"}));
  EXPECT_EQ(series.at("wrist").keys(), (std::vector<std::string>{"fx", "\"z\" \\"}));
  EXPECT_EQ(series.at("wrist").at("fx").asDouble(), 1.5);
  EXPECT_EQ(series.at("wrist").at("\"z\" \\").asDouble(), -2.0);
}

}  // namespace
}  // namespace palpate::signal_json_test
