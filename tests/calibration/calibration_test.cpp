#include "palpate/calibration/calibration.h"

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::calibration_test {
namespace {

Calibration example() {
  Calibration calibration;
  calibration.programVersion = "0.1.0";
  calibration.madeAt = "2026-01-01T00:00:00Z";
  calibration.hand = "a hand";
  calibration.matrix = 1;
  calibration.settings = {0.8, 90.0, true};
  calibration.sensitivityOffset = -11.4;
  for (int i = 0; i < 12; ++i) {
    PressureSample s;
    s.file = "file" + std::to_string(i) + ".dsa";
    s.sha256 = std::string(64, 'a');
    s.staticResponseCounts = 60.0 * i;
    s.driftCountsPerS = 1.0 + i;
    s.nearestDegC = 28.0 + 3.0 * (i % 4);
    s.pressureKpa = 10.0 + 5.9 * i + (i % 3);
    calibration.samples.push_back(s);
  }
  calibration.samples[11].used = false;
  calibration.samples[11].notes = {"cut off"};
  calibration.pressure = fitPressureModel(calibration.samples);
  calibration.noise.emplace();
  calibration.noise->lines.resize(1);
  calibration.noise->lines[0].slope = 0.35;
  calibration.options = Json::object().set("loss", "squares");
  return calibration;
}

TEST(Calibration, PassesThroughItsFile) {
  const testing::TemporaryFolder folder;
  const Calibration calibration = example();
  saveCalibration(calibration, folder / "c.json");
  const Calibration back = loadCalibration(folder / "c.json");
  EXPECT_EQ(back.programVersion, "0.1.0");
  EXPECT_EQ(back.madeAt, calibration.madeAt);
  EXPECT_EQ(back.hand, "a hand");
  EXPECT_EQ(back.matrix, 1u);
  EXPECT_EQ(back.settings, calibration.settings);
  EXPECT_EQ(back.sensitivityOffset, -11.4);
  ASSERT_EQ(back.samples.size(), 12u);
  EXPECT_EQ(back.samples[2].sha256, std::string(64, 'a'));
  EXPECT_EQ(back.samples[2].nearestDegC, calibration.samples[2].nearestDegC);
  EXPECT_FALSE(back.samples[11].used);
  EXPECT_EQ(back.samples[11].notes, std::vector<std::string>{"cut off"});
  EXPECT_EQ(back.noise->lines.at(0).slope, 0.35);
  EXPECT_EQ(back.options.at("loss").asString(), "squares");
  EXPECT_EQ(back.pressure.pressureAt(300.0, 30.0).kpa,
            calibration.pressure.pressureAt(300.0, 30.0).kpa);
  EXPECT_EQ(jsonOf(back).text(), jsonOf(calibration).text());
  EXPECT_THROW(saveCalibration(calibration, folder / "c.json"), FileError)
      << "nothing is overwritten unasked";
}

TEST(Calibration, RefusesWhatIsNone) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(loadCalibration(folder / "missing.json"), FileError);
  EXPECT_THROW(loadCalibration(folder.path()), FileError);
  for (const char* bad : {"",
                          "{",
                          "[]",
                          "{\"kind\":\"other\"}",
                          "{\"kind\":\"palpate calibration\"}",
                          "{\"kind\":\"palpate calibration\",\"format_version\":2}"}) {
    testing::writeFile(folder / "bad.json", bad);
    EXPECT_THROW(loadCalibration(folder / "bad.json"), FormatError) << bad;
  }
  const Json good = jsonOf(example());
  for (const char* key : {"kind", "format_version", "matrix", "settings", "K"}) {
    Json less = Json::object();
    for (const std::string& k : good.keys())
      if (k != key) less.set(k, good.at(k));
    testing::writeFile(folder / "less.json", less.text());
    EXPECT_THROW(loadCalibration(folder / "less.json"), FormatError) << key;
  }
}

TEST(Calibration, SaysThatALaterFormatNeedsANewerProgram) {
  try {
    calibrationFrom(Json::object().set("kind", "palpate calibration").set("format_version", 7));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("newer palpate"), std::string::npos);
  }
}

}  // namespace
}  // namespace palpate::calibration_test
