#include "palpate/calibration/step_report.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::step_report_test {
namespace {

std::vector<std::vector<std::string>> csvRows(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

// K to 0.1 %, m to 0.5 %, time constants and temperatures besides: 24 real loading steps against
// another program.
TEST(StepReport, AgreesWithTheIndependentFitsOfRealSteps) {
  const auto golden = testing::goldenFolder(), recordings = testing::recordingsFolder();
  PALPATE_NEED(golden && recordings);
  const auto rows = csvRows(*golden / "pressure_calibration.csv");
  ASSERT_EQ(rows.size(), 25u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    SCOPED_TRACE(rows[i][2]);
    const auto number = [&](std::size_t column) { return parseDouble(rows[i][column]).value(); };
    const StepReport report = reportSteps(openRecording(*recordings / rows[i][2]), 1);
    ASSERT_EQ(report.steps.size(), 1u);
    const FittedStep& step = report.steps[0];
    const StepParameters& p = step.fit.parameters;
    EXPECT_TRUE(step.fit.converged);
    EXPECT_TRUE(step.fit.usable());
    EXPECT_NEAR(p.staticResponseCounts / number(4), 1.0, 1e-3);
    EXPECT_NEAR(p.driftCountsPerS / number(5), 1.0, 5e-3);
    const double d = number(7), sum = d + std::sqrt(d * d - 1.0);
    EXPECT_NEAR(p.t1S() / (number(6) * sum), 1.0, 5e-3);
    EXPECT_NEAR(p.t2S(), number(6) / sum, 5e-3 * p.t1S());
    ASSERT_TRUE(step.studyDegC && step.nearestDegC);
    EXPECT_NEAR(*step.studyDegC, number(8), 1e-9);
    EXPECT_NEAR(*step.nearestDegC, number(9), 0.03) << "which frames count is a matter of taste";
  }
}

TEST(StepReport, SaysThatTheHeaviestHotStepSaturates) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const StepReport report =
      reportSteps(openRecording(*recordings / "pressure_calibration/high/H1.dsa"), 1);
  ASSERT_EQ(report.steps.size(), 1u);
  EXPECT_GT(report.steps[0].saturatedFrames, 0u);
  EXPECT_FALSE(report.steps[0].usable());
  EXPECT_NE(report.steps[0].notes.at(0).find("saturated"), std::string::npos);
}

// One matrix of 4x4, all taxels equal; frame rate 31.25 Hz.
class Recorder {
 public:
  Recorder()
      : builder_(std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(4, 4, 3.4)})) {}
  void add(float value, float oddTaxel = 0.0F) {
    std::vector<float> values(16, value);
    if (oddTaxel > 0.0F) values[5] = oddTaxel;
    builder_.addFrame(1'000'000 + 32'000 * frame_++, values);
  }
  // A step response of 300 counts that begins now.
  void addStep(int frames, double gain = 300.0) {
    const StepParameters p = StepParameters::ofTimes(gain, 5.0, 0.4, 0.05);
    for (int i = 1; i <= frames; ++i) add(static_cast<float>(stepResponse(p, 0.032 * i)));
  }
  void temperatures(double degC) {
    builder_.addTemperatures(1'000'000 + 32'000 * frame_, std::vector<double>{0.0, degC, 50.0});
  }
  Profile finish() { return builder_.finish({}); }

 private:
  ProfileBuilder builder_;
  int frame_ = 0;
};

TEST(StepReport, FitsEveryStepOfARecording) {
  Recorder recorder;
  for (const double gain : {100.0, 300.0, 500.0}) {
    for (int i = 0; i < 40; ++i) recorder.add(0.0F);
    recorder.addStep(200, gain);
  }
  recorder.add(0.0F);
  const StepReport report = reportSteps(recorder.finish(), 0);
  ASSERT_EQ(report.steps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(report.steps[i].usable());
    EXPECT_NEAR(report.steps[i].fit.parameters.staticResponseCounts,
                100.0 + 200.0 * static_cast<double>(i),
                0.01);
    EXPECT_FALSE(report.steps[i].nearestDegC);
  }
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("no temperatures"), std::string::npos);
}

TEST(StepReport, SaysWhyThereIsNoStep) {
  Recorder idle;
  for (int i = 0; i < 100; ++i) idle.add(0.0F);
  EXPECT_NE(reportSteps(idle.finish(), 0).notes.at(0).find("never loaded"), std::string::npos);
  Recorder brief;
  for (int i = 0; i < 100; ++i) brief.add(i % 20 == 5 ? 80.0F : 0.0F);
  EXPECT_NE(reportSteps(brief.finish(), 0).notes.at(0).find("no contact"), std::string::npos);
  Recorder empty;
  EXPECT_NE(reportSteps(empty.finish(), 0).notes.at(0).find("no frame"), std::string::npos);
  Recorder one;
  one.add(1.0F);
  EXPECT_THROW(reportSteps(one.finish(), 1), std::out_of_range);
}

TEST(StepReport, NotesWhatSpeaksAgainstAStep) {
  Recorder loaded;  // from the first frame on
  loaded.addStep(200);
  const FittedStep unseen = reportSteps(loaded.finish(), 0).steps.at(0);
  EXPECT_FALSE(unseen.usable());
  EXPECT_NE(unseen.notes.at(0).find("first frame"), std::string::npos);

  Recorder cut;
  cut.add(0.0F);
  cut.addStep(32);
  const FittedStep early = reportSteps(cut.finish(), 0).steps.at(0);
  EXPECT_FALSE(early.usable());
  EXPECT_NE(early.fit.notes.at(0).find("cut off"), std::string::npos);

  Recorder stairs;  // a second weight on top
  stairs.add(0.0F);
  stairs.addStep(100);
  for (int i = 0; i < 100; ++i) stairs.add(900.0F);
  const FittedStep changed = reportSteps(stairs.finish(), 0).steps.at(0);
  EXPECT_FALSE(changed.usable());

  Recorder flicker;
  flicker.add(0.0F);
  const StepParameters p = StepParameters::ofTimes(30.0, 0.5, 0.4, 0.05);
  std::vector<float> values(16);
  ProfileBuilder builder(
      std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(4, 4, 3.4)}));
  builder.addFrame(1, values);
  for (int i = 1; i <= 200; ++i) {
    for (std::size_t t = 0; t < 16; ++t)
      values[t] = t < 6 && (static_cast<std::size_t>(i) + t) % 2 == 0
                      ? 0.0F
                      : static_cast<float>(stepResponse(p, 0.032 * i));
    builder.addFrame(1 + 32'000 * i, values);
  }
  const FittedStep flickering = reportSteps(builder.finish({}), 0).steps.at(0);
  EXPECT_GT(flickering.toggledPerFrame, 5.0);
  EXPECT_NE(flickering.notes.at(0).find("flickering"), std::string::npos);
}

TEST(StepReport, KeepsThePromiseOfItsJson) {
  Recorder recorder;
  recorder.add(0.0F);
  recorder.addStep(300);
  const Json json = Json::parse(jsonOf(reportSteps(recorder.finish(), 0)).text());
  ASSERT_EQ(json.at("steps").size(), 1u);
  const Json step = json.at("steps").at(0);
  EXPECT_EQ(step.at("begin").asInteger(), 0);
  EXPECT_EQ(step.at("end").asInteger(), 300);
  EXPECT_NEAR(step.at("K").asDouble(), 300.0, 0.01);
  EXPECT_NEAR(step.at("m").asDouble(), 5.0, 0.01);
  EXPECT_NEAR(step.at("T1").asDouble(), 0.4, 1e-4);
  EXPECT_NEAR(step.at("T2").asDouble(), 0.05, 1e-4);
  EXPECT_NEAR(step.at("T").asDouble(), std::sqrt(0.02), 1e-4);
  EXPECT_NEAR(step.at("d").asDouble(), 0.225 / std::sqrt(0.02), 1e-3);
  EXPECT_TRUE(step.at("rmse").isNumber());
  EXPECT_TRUE(step.at("converged").asBool());
  EXPECT_TRUE(step.at("identifiable").asBool());
  ASSERT_EQ(step.at("covariance").size(), 4u);
  for (std::size_t r = 0; r < 4; ++r) ASSERT_EQ(step.at("covariance").at(r).size(), 4u);
  EXPECT_EQ(step.at("covariance_of").text(-1), R"(["K","m","T1","T2"])");
}

}  // namespace
}  // namespace palpate::step_report_test
