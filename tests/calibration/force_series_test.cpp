#include "palpate/calibration/force_series.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::force_series_test {
namespace {

// P = .1 K [kPa], whatever the temperature.
Calibration tenth() {
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
                                     .activeAreaMm2 = 100.0});
  calibration.pressure = fitPressureModel(calibration.samples, {});
  return calibration;
}

// Whole rows of matrix 2 read `counts` in every second frame, 50 ms apart; temperatures where told.
Profile recorded(float counts, bool temperatures) {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  for (int i = 0; i < 10; ++i) {
    TactileFrame frame(hand.layout);
    if (i % 2 == 1) frame.matrix(2).setConstant(counts);
    builder.addFrame(1'000'000 + i * 50'000, frame.values);
  }
  if (temperatures)
    builder.addTemperatures(1'000'000, std::vector<double>(hand.temperatureSensors.size(), 36.0));
  return builder.finish({});
}

TEST(ForceSeries, IsPressureTimesActiveArea) {
  const ForceSeries series = forceSeries(recorded(400.0F, true), tenth());
  ASSERT_EQ(series.timeS.size(), 10u);
  EXPECT_EQ(series.numMatrices, 6u);
  EXPECT_DOUBLE_EQ(series.timeS[3], 0.15);
  const MatrixForce& contact = series.at(3, 2);
  // K is the mean of the filtered matrix over what it is active on: less than 400 at the borders.
  EXPECT_NEAR(contact.kpa, 0.1F * contact.staticResponseCounts, 0.2F);
  const double areaMm2 = contact.active * 11.56;
  EXPECT_NEAR(contact.forceN, static_cast<double>(contact.kpa) * 1e-3 * areaMm2, 0.02);
  EXPECT_EQ(series.at(2, 2).forceN, 0.0F);
  EXPECT_EQ(series.at(3, 1).forceN, 0.0F);
  EXPECT_DOUBLE_EQ(series.forceN(3), static_cast<double>(contact.forceN));
  EXPECT_DOUBLE_EQ(series.sdForceN(3), static_cast<double>(contact.sdForceN));
  EXPECT_TRUE(contact.inRange);
  EXPECT_TRUE(contact.temperatureKnown);
  EXPECT_EQ(series.contacts, 5u);
  EXPECT_EQ(series.beyond, 0u);
}

TEST(ForceSeries, TellsTheFrameOfATime) {
  const ForceSeries series = forceSeries(recorded(400.0F, true), tenth());
  EXPECT_EQ(series.frameAt(-1.0), 0u);
  EXPECT_EQ(series.frameAt(0.0), 0u);
  EXPECT_EQ(series.frameAt(0.149), 2u);
  EXPECT_EQ(series.frameAt(0.151), 3u);
  EXPECT_EQ(series.frameAt(99.0), 9u);
  EXPECT_EQ(ForceSeries{}.frameAt(1.0), 0u);
}

TEST(ForceSeries, SaysWhatIsAssumedAndBeyond) {
  const ForceSeries series = forceSeries(recorded(2000.0F, false), tenth());
  EXPECT_EQ(series.beyond, 5u) << "K was measured up to 850 counts";
  EXPECT_FALSE(series.at(1, 2).inRange);
  EXPECT_FALSE(series.at(1, 2).temperatureKnown);
  const auto says = [&](const std::string& word) {
    return std::any_of(series.assumptions.begin(), series.assumptions.end(), [&](const auto& s) {
      return s.find(word) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("no temperatures"));
  EXPECT_TRUE(says("settings of the calibration"));
  EXPECT_FALSE(says("tare"));
  EXPECT_FALSE(says("loaded in the first frame"));
}

TEST(ForceSeries, SaysThatALoadBeganBeforeTheRecording) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 10; ++i) {
    TactileFrame frame(sdh2().layout);
    frame.matrix(2).setConstant(400.0F);
    builder.addFrame(1'000'000 + i * 50'000, frame.values);
  }
  const Profile profile = builder.finish({});
  const auto says = [](const ForceSeries& series) {
    return std::any_of(series.assumptions.begin(), series.assumptions.end(), [](const auto& s) {
      return s.find("1 matrix was loaded in the first frame") != std::string::npos;
    });
  };
  const ForceSeries series = forceSeries(profile, tenth());
  EXPECT_TRUE(says(series));
  EXPECT_TRUE(series.at(9, 2).startUnknown);
  EXPECT_FALSE(series.at(9, 1).startUnknown);
  EXPECT_FALSE(says(forceSeries(profile, tenth(), {.compensateDrift = false})));
}

TEST(ForceSeries, TakesTheTareOff) {
  const Profile profile = recorded(400.0F, true);
  Tare tare;
  tare.zero.assign(profile.layout().numCells(), 400.0F);
  tare.matrices.resize(6);
  const ForceSeries series = forceSeries(profile, tenth(), {}, tare);
  EXPECT_EQ(series.contacts, 0u);
  EXPECT_EQ(series.at(3, 2).forceN, 0.0F);
}

TEST(ForceSeries, RefusesWhatIsNoCounts) {
  EXPECT_THROW(forceSeries(recorded(1.5F, true), tenth()), Error);
  EXPECT_THROW(forceSeries(recorded(1.0F, true), Calibration{}), std::invalid_argument);
  EXPECT_THROW(
      forceSeries(recorded(1.0F, true), tenth(), {}, std::nullopt, [](double) { return false; }),
      Cancelled);
}

TEST(ForceSeries, SettingsGoThereAndBack) {
  const SensorSettings said{0.25, 150.0, true};
  EXPECT_EQ(sensorSettingsFrom(Json::parse(jsonOf(said).text())), said);
  for (const char* bad : {"{}",
                          "[]",
                          R"({"sensitivity":0,"threshold_counts":5})",
                          R"({"sensitivity":2,"threshold_counts":5})",
                          R"({"sensitivity":"1","threshold_counts":5})",
                          R"({"sensitivity":1,"threshold_counts":-5})"})
    EXPECT_THROW(sensorSettingsFrom(Json::parse(bad)), Error) << bad;
}

TEST(ReportedSettings, AreThoseOfTheRecordingAndItsChangesInOrderOfTime) {
  const std::string two = R"([{"sensitivity":0.5,"threshold_counts":150},)"
                          R"({"sensitivity":1,"threshold_counts":60}])";
  PressureMapOptions options;
  useReportedSettings(options, "", {{5, two}});
  EXPECT_TRUE(options.settings.empty()) << "it doesn't tell";
  EXPECT_TRUE(options.changes.empty());
  useReportedSettings(options,
                      two,
                      {{9, R"({"matrices":[{"sensitivity":0.25,"threshold_counts":0}]})"},
                       {7, ""},
                       {3, R"({"matrices":)" + two + "}"}});
  ASSERT_EQ(options.settings.size(), 2u);
  EXPECT_EQ(options.settings[0], (SensorSettings{0.5, 150.0, false}));
  EXPECT_EQ(options.settings[1], (SensorSettings{1.0, 60.0, false}));
  ASSERT_EQ(options.changes.size(), 2u) << "one says nothing";
  EXPECT_EQ(options.changes[0].fromUs, 3);
  EXPECT_EQ(options.changes[1].fromUs, 9);
  EXPECT_EQ(options.changes[1].settings[0], (SensorSettings{0.25, 0.0, false}));
  for (const char* bad : {"{}", "[{}]", "[{\"sensitivity\":0,\"threshold_counts\":1}]", "nonsense"})
    EXPECT_THROW(useReportedSettings(options, bad, {}), Error) << bad;
}

}  // namespace
}  // namespace palpate::force_series_test
