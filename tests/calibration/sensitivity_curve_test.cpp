#include "palpate/calibration/sensitivity_curve.h"

#include <cmath>

#include "palpate/calibration/step_report.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::sensitivity_curve_test {
namespace {

// The study's recording: 700 g at ten sensitivities; methods.md: 589.3 s - 11.4.
TEST(SensitivityCurve, IsALineThroughTheRealSteps) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const StepReport report = reportSteps(
      openRecording(*recordings / "calibration_sensitivity/sensitivity_0.1-1.0.dsa"), 1);
  ASSERT_EQ(report.steps.size(), 10u);
  std::vector<SensitivityPoint> points;
  for (std::size_t i = 0; i < 10; ++i)
    points.push_back(
        {0.1 * static_cast<double>(i + 1), report.steps[i].fit.parameters.staticResponseCounts});
  const SensitivityCurve curve = fitSensitivityCurve(points, 100.0);
  ASSERT_TRUE(curve.valid);
  EXPECT_NEAR(curve.slope, 589.3, 0.012 * 589.3) << "where a step ends is a matter of taste";
  EXPECT_NEAR(curve.offset, -11.4, 1.0);
  EXPECT_GT(curve.r2, 0.995);
}

TEST(SensitivityCurve, FindsALineAndItsErrors) {
  // y = 500 s - 20, disturbed by 1, -2, 1 (orthogonal to line and mean): slope and offset stay.
  const std::vector<SensitivityPoint> points = {{0.2, 81.0}, {0.4, 178.0}, {0.6, 281.0}};
  const SensitivityCurve curve = fitSensitivityCurve(points, 100.0);
  EXPECT_NEAR(curve.slope, 500.0, 1e-9);
  EXPECT_NEAR(curve.offset, -20.0, 1e-9);
  // Residual sum 6, one degree of freedom; Sxx .08.
  EXPECT_NEAR(curve.slopeSd, std::sqrt(6.0 / 0.08), 1e-9);
  EXPECT_NEAR(curve.offsetSd, std::sqrt(6.0 * (1.0 / 3.0 + 0.16 / 0.08)), 1e-9);
  EXPECT_NEAR(curve.r2, 1.0 - 6.0 / 20006.0, 1e-6);
  EXPECT_NEAR(curve.zeroSensitivity, 0.04, 1e-9);
  EXPECT_NE(curve.notes.back().find("20 % of it"), std::string::npos) << "the threshold's share";
}

TEST(SensitivityCurve, SaysWhatIsMissing) {
  EXPECT_FALSE(fitSensitivityCurve({}).valid);
  const std::vector<SensitivityPoint> one = {{0.5, 100.0}};
  EXPECT_NE(fitSensitivityCurve(one).notes.at(0).find("takes two"), std::string::npos);
  const std::vector<SensitivityPoint> same = {{0.5, 100.0}, {0.5, 104.0}};
  EXPECT_NE(fitSensitivityCurve(same).notes.at(0).find("one sensitivity"), std::string::npos);
  const std::vector<SensitivityPoint> two = {{0.5, 100.0}, {1.0, 200.0}};
  EXPECT_TRUE(fitSensitivityCurve(two).valid);
  EXPECT_TRUE(std::isnan(fitSensitivityCurve(two).slopeSd));
  const std::vector<SensitivityPoint> bad = {
      {0.5, 100.0}, {0.7, std::nan("")}, {1.0, 200.0}, {0.9, 1.0, false}};
  const SensitivityCurve left = fitSensitivityCurve(bad);
  EXPECT_NEAR(left.slope, 200.0, 1e-9);
  EXPECT_NE(left.notes.at(0).find("2 steps"), std::string::npos);
}

TEST(SensitivityCurve, KeepsThePromiseOfItsJson) {
  const std::vector<SensitivityPoint> two = {{0.5, 100.0}, {1.0, 200.0}};
  const Json json = jsonOf(fitSensitivityCurve(two));
  EXPECT_EQ(json.at("points").at(1).at("sensitivity").asDouble(), 1.0);
  EXPECT_EQ(json.at("points").at(1).at("K").asDouble(), 200.0);
  EXPECT_NEAR(json.at("slope").asDouble(), 200.0, 1e-9);
  EXPECT_TRUE(json.at("offset").isNumber());
  EXPECT_TRUE(json.at("r2").isNumber());
}

}  // namespace
}  // namespace palpate::sensitivity_curve_test
