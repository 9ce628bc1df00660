#include "palpate/calibration/pressure_model.h"

#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::pressure_model_test {
namespace {

// P = 30 - .6 T + .1 K exactly, but for +-.5 kPa in turn.
std::vector<PressureSample> samples() {
  std::vector<PressureSample> all;
  int i = 0;
  for (const double t : {28.0, 36.0, 43.0})
    for (double k = 100.0; k <= 800.0; k += 100.0) {
      PressureSample s;
      s.file = "a.dsa";
      s.staticResponseCounts = k;
      s.driftCountsPerS = 0.02 * k + 0.1 * t + (i % 3 == 0 ? 0.4 : -0.2);
      s.nearestDegC = t;
      s.studyDegC = t + 5.0;
      s.pressureKpa = 30.0 - 0.6 * t + 0.1 * k + (i++ % 2 == 0 ? 0.5 : -0.5);
      s.activeAreaMm2 = 220.5;
      all.push_back(s);
    }
  return all;
}

TEST(PressureModel, TellsPressureWithItsBand) {
  const PressureModel model = fitPressureModel(samples());
  ASSERT_TRUE(model.valid());
  const PressureEstimate at = model.pressureAt(450.0, 36.0);
  EXPECT_NEAR(at.kpa, 30.0 - 0.6 * 36.0 + 45.0, 0.2);
  EXPECT_GT(at.sdKpa, 0.5);
  EXPECT_LT(at.sdKpa, 0.7);
  EXPECT_TRUE(at.inRange);
  EXPECT_TRUE(at.temperatureKnown);
  EXPECT_FALSE(model.pressureAt(2000.0, 36.0).inRange);
  EXPECT_FALSE(model.pressureAt(450.0, 60.0).inRange);
  EXPECT_EQ(model.pressureAt(-5000.0, 36.0).kpa, 0.0) << "never below 0";
}

TEST(PressureModel, WithoutATemperatureItTakes35AndWidensTheBand) {
  const PressureModel model = fitPressureModel(samples());
  const PressureEstimate known = model.pressureAt(450.0, 35.0);
  for (const std::optional<double> none :
       {std::optional<double>(), std::optional(0.0), std::optional(std::nan(""))}) {
    const PressureEstimate unknown = model.pressureAt(450.0, none);
    EXPECT_FALSE(unknown.temperatureKnown);
    EXPECT_EQ(unknown.kpa, known.kpa);
    EXPECT_NEAR(unknown.sdKpa, std::hypot(known.sdKpa, 0.6 * 8.0), 0.3);
  }
}

TEST(PressureModel, TakesTheStudysChoicesWhenAsked) {
  PressureModelOptions options;
  options.study = true;
  const PressureModel model = fitPressureModel(samples(), options);
  EXPECT_EQ(model.gain.numTerms, 4u);
  EXPECT_EQ(model.drift.numTerms, 9u);
  // Its temperature is 5 deg C higher.
  EXPECT_NEAR(model.pressureAt(450.0, 41.0).kpa, 30.0 - 0.6 * 36.0 + 45.0, 0.3);
}

TEST(PressureModel, KnowsTheShareOfTheAreaThatIsLoaded) {
  PressureModelOptions options;
  options.indenterAreaMm2 = 110.25;
  EXPECT_NEAR(fitPressureModel(samples(), options).areaFraction, 0.5, 1e-12);
  const PressureModel unknown = fitPressureModel(samples());
  EXPECT_EQ(unknown.areaFraction, 1.0);
  EXPECT_NE(unknown.notes.at(0).find("indenter"), std::string::npos);
}

TEST(PressureModel, SaysWhatIsMissing) {
  EXPECT_FALSE(fitPressureModel({}).valid());
  EXPECT_TRUE(std::isnan(fitPressureModel({}).pressureAt(100.0, 30.0).kpa));
  std::vector<PressureSample> cold = samples();
  cold.resize(8);
  const PressureModel one = fitPressureModel(cold);
  EXPECT_TRUE(one.valid()) << "it holds at this temperature";
  EXPECT_NE(one.notes.back().find("one temperature only"), std::string::npos);
  EXPECT_FALSE(one.pressureAt(450.0, 43.0).inRange);
  std::vector<PressureSample> two = samples();
  two.resize(2);
  EXPECT_FALSE(fitPressureModel(two, {.study = true}).valid());
  std::vector<PressureSample> unknown = samples();
  for (PressureSample& s : unknown) s.nearestDegC.reset();
  bool said = false;
  for (const std::string& note : fitPressureModel(unknown).notes)
    said = said || note.find("24 steps have no temperature") != std::string::npos;
  EXPECT_TRUE(said);
  std::vector<PressureSample> some = samples();
  some[3].used = false;
  some[4].staticResponseCounts = std::nan("");
  EXPECT_EQ(fitPressureModel(some).gain.numPoints, 22u);
}

TEST(PressureModel, PassesThroughJson) {
  PressureModelOptions options;
  options.indenterAreaMm2 = 110.25;
  PressureModel model = fitPressureModel(samples(), options);
  model.steadyS = 1.62;
  model.creepMeasuredS = 11.3;
  const PressureModel back = pressureModelFrom(Json::parse(jsonOf(model).text()));
  const PressureEstimate a = model.pressureAt(333.0, 31.0), b = back.pressureAt(333.0, 31.0);
  EXPECT_EQ(a.kpa, b.kpa);
  EXPECT_NEAR(a.sdKpa, b.sdKpa, 1e-12);
  EXPECT_EQ(a.inRange, b.inRange);
  EXPECT_EQ(back.areaFraction, model.areaFraction);
  EXPECT_EQ(back.steadyS, 1.62);
  EXPECT_EQ(back.creepMeasuredS, 11.3);
  EXPECT_EQ(back.driftOfGain.at(300.0, 30.0).value, model.driftOfGain.at(300.0, 30.0).value);
}

TEST(PressureModel, KnowsForHowLongCreepWasMeasured) {
  std::vector<PressureSample> some = samples();
  EXPECT_EQ(fitPressureModel(some).creepMeasuredS, 0.0);
  some[0].durationS = 8.0;
  some[1].durationS = 12.0;
  some[2].durationS = 13.0;
  some[3].durationS = 100.0;
  some[3].used = false;
  EXPECT_EQ(fitPressureModel(some).creepMeasuredS, 12.0) << "the median of the used samples";
  Json older = Json::object();
  const Json json = jsonOf(fitPressureModel(some));
  for (const std::string& key : json.keys())
    if (key != "creep_measured_s") older.set(key, json.at(key));
  EXPECT_EQ(pressureModelFrom(older).creepMeasuredS, 0.0);
  Json wrong = json;
  wrong.set("creep_measured_s", -1.0);
  EXPECT_THROW(pressureModelFrom(wrong), Error);
}

TEST(PressureModel, RefusesJsonThatIsNone) {
  const Json good = jsonOf(fitPressureModel(samples()));
  EXPECT_NO_THROW(pressureModelFrom(good));
  EXPECT_THROW(pressureModelFrom(Json::array()), Error);
  for (const char* key : {"K", "m", "drift_of_K", "area_share", "assumed_temperature_c"}) {
    Json less = Json::object();
    for (const std::string& k : good.keys())
      if (k != key) less.set(k, good.at(k));
    EXPECT_THROW(pressureModelFrom(less), Error) << key;
  }
  Json bad = good;
  bad.set("K", Json::object().set("c", Json::array().push(1.0)));
  EXPECT_THROW(pressureModelFrom(bad), Error);
}

TEST(PressureModel, RefusesBadOptions) {
  EXPECT_THROW(fitPressureModel({}, {.assumedDegC = 1000.0}), std::invalid_argument);
  EXPECT_THROW(fitPressureModel({}, {.assumedSdDegC = 0.0}), std::invalid_argument);
  EXPECT_THROW(fitPressureModel({}, {.indenterAreaMm2 = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::pressure_model_test
