#include "palpate/live/pressure_stage.h"

#include <stdexcept>

#include "palpate/calibration/force_series.h"
#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/live/filter_stage.h"
#include "palpate/live/processing_chain.h"
#include "palpate/live/signals_stage.h"
#include "palpate/model/hand_description.h"

#include "calibration/sample_calibrations.h"
#include "testing/testing.h"

namespace palpate::pressure_stage_test {
namespace {

Calibration calibration() { return testing::linearCalibration({0.5, 100.0, false}); }

Profile grasps() { return synthesize({.durationS = 5.0, .grasps = 2, .noiseCounts = 12.0}); }

struct Seen {
  std::vector<std::shared_ptr<const PressureFrame>> pressures;
  std::string problem;
  std::vector<std::string> assumptions;
};

Seen seen(const Profile& profile,
          const std::optional<Calibration>& by,
          PressureStage::AskSettings settings = {},
          std::vector<Event> events = {},
          const std::string& filter = {}) {
  std::vector<std::unique_ptr<Stage>> stages;
  if (!filter.empty()) {
    auto filters = std::make_unique<FilterStage>();
    filters->setRecipe(parseRecipe(std::vector<std::string>{filter}));
    stages.push_back(std::move(filters));
  }
  auto stage = std::make_unique<PressureStage>(profile.hand(), std::move(settings));
  PressureStage& pressure = *stage;
  pressure.setCalibration(by);
  stages.push_back(std::move(stage));
  Seen result;
  ChainOptions options;
  options.onResults = [&](const LiveResults& results) {
    result.pressures.push_back(results.pressure);
    result.problem = pressure.problem();
    result.assumptions = pressure.assumptions();
  };
  ProcessingChain(std::move(stages), options).runOver(profile, std::move(events));
  return result;
}

TEST(PressureStage, WithoutACalibrationThereIsNone) {
  for (const auto& pressure : seen(grasps(), std::nullopt).pressures) EXPECT_EQ(pressure, nullptr);
}

TEST(PressureStage, GivesWhatTheRecordingGivesAndOfTheFrameAsItCame) {
  const Profile profile = grasps();
  const std::vector<SensorSettings> settings(6, {0.5, 100.0, false});
  PressureMapOptions offline;
  offline.settings = settings;
  const ForceSeries expected = forceSeries(profile, calibration(), offline);
  for (const char* filter : {"", "gaussian:size=5"}) {
    const Seen live = seen(
        profile, calibration(), [&] { return settings; }, {}, filter);
    ASSERT_EQ(live.pressures.size(), profile.numFrames());
    double most = 0.0;
    for (std::size_t i = 0; i < live.pressures.size(); ++i)
      for (std::size_t m = 0; m < 6; ++m) {
        const MatrixPressure& matrix = live.pressures[i]->matrices[m];
        ASSERT_EQ(static_cast<float>(matrix.forceN), expected.at(i, m).forceN) << i;
        ASSERT_EQ(static_cast<float>(matrix.sdKpa), expected.at(i, m).sdKpa) << i;
        most = std::max(most, matrix.forceN);
      }
    EXPECT_GT(most, 1.0) << "something was pressed";
  }
}

// With half the sensitivity all counts are halved: the pressure is the same (K is proportional to
// it).
TEST(PressureStage, FollowsSettingsThatChange) {
  const Profile profile = grasps();
  const std::int64_t us = profile.frameTimeUs(60);
  const std::string json = [] {
    Json matrices = Json::array();
    for (int i = 0; i < 6; ++i) matrices.push(jsonOf(SensorSettings{0.25, 100.0, false}));
    return Json::object().set("matrices", matrices).text(-1);
  }();
  const std::vector<SensorSettings> before(6, {0.5, 100.0, false}), after(6, {0.25, 100.0, false});
  PressureMapOptions offline;
  offline.settings = before;
  offline.changes = {{us, after}};
  const ForceSeries expected = forceSeries(profile, calibration(), offline);
  const ForceSeries unchanged = forceSeries(profile, calibration(), {.settings = before});
  // The settings come from the event, or from a request to the device.
  for (const bool said : {true, false}) {
    int asked = 0;
    const Seen live =
        seen(profile,
             calibration(),
             [&] { return asked++ == 0 ? before : after; },
             {{us, us, "settings", std::nullopt, "sensitivity 0.25", said ? json : ""}});
    EXPECT_EQ(asked, said ? 1 : 2);
    std::size_t others = 0;
    for (std::size_t i = 0; i < live.pressures.size(); ++i)
      for (std::size_t m = 0; m < 6; ++m) {
        ASSERT_EQ(static_cast<float>(live.pressures[i]->matrices[m].kpa), expected.at(i, m).kpa);
        others += expected.at(i, m).kpa != unchanged.at(i, m).kpa ? 1 : 0;
      }
    EXPECT_GT(others, 50u);
  }
}

TEST(PressureStage, SaysWhatIsWrongAndGoesOn) {
  const Profile profile = grasps();
  const Seen unknown = seen(profile, calibration(), [] { return std::vector<SensorSettings>{}; });
  EXPECT_TRUE(unknown.problem.empty());
  ASSERT_FALSE(unknown.assumptions.empty());
  const Seen bad = seen(profile, calibration(), []() -> std::vector<SensorSettings> {
    throw Error("sensor settings: 'sensitivity' isn't in (0..1]");
  });
  EXPECT_EQ(bad.problem, "sensor settings: 'sensitivity' isn't in (0..1]");
  for (const auto& pressure : bad.pressures) EXPECT_EQ(pressure, nullptr);
  const Seen damaged = seen(profile,
                            calibration(),
                            {},
                            {{profile.frameTimeUs(5),
                              profile.frameTimeUs(5),
                              "settings",
                              std::nullopt,
                              "?",
                              "{\"matrices\":[{}]}"}});
  EXPECT_FALSE(damaged.problem.empty());
  EXPECT_NE(damaged.pressures.front(), nullptr);
  EXPECT_EQ(damaged.pressures.back(), nullptr);
  Calibration none = calibration();
  none.pressure = {};
  EXPECT_THROW(PressureStage(sdh2(), {}).setCalibration(none), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::pressure_stage_test
