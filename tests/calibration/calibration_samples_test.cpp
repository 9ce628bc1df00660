#include "palpate/calibration/calibration_samples.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::calibration_samples_test {
namespace {

constexpr double kRateHz = 40.0;

// A load on one matrix from 1 s on: a(t) = K (1 - (1 + t/T) e^(-t/T)) + m t, the same on 3 x 3
// taxels.
Profile loaded(std::size_t matrix, double gain) {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  for (int i = 0; i < 400; ++i) {
    TactileFrame frame(hand.layout);
    const double t = i / kRateHz - 1.0;
    const double value =
        t > 0.0 ? gain * (1.0 - (1.0 + t / 0.2) * std::exp(-t / 0.2)) + 2.0 * t : 0.0;
    for (int y = 4; y < 7; ++y)
      for (int x = 1; x < 4; ++x) frame.matrix(matrix)(y, x) = static_cast<float>(value);
    builder.addFrame(1'000'000 + static_cast<std::int64_t>(i * 1e6 / kRateHz), frame.values);
  }
  return builder.finish({});
}

CalibrationSource open(const std::filesystem::path& file, const Progress&) {
  if (file == "t/a.dsa") return {loaded(3, 900.0), "aa"};
  if (file == "t/b.dsa") return {loaded(3, 1800.0), "bb"};
  throw FileError(file, "can't be opened");
}

TEST(PressureGathering, TheLoadedMatrixIsTheOneWithTheLargestSum) {
  EXPECT_EQ(loadedMatrix(loaded(3, 900.0)), 3u);
  EXPECT_EQ(loadedMatrix(loaded(0, 900.0)), 0u);
  EXPECT_THROW(loadedMatrix(loaded(0, 900.0), [](double) { return false; }), Cancelled);
}

TEST(PressureGathering, TakesTheStepsOfEveryRowAndSaysWhatIsMissing) {
  const std::vector<PressureTableRow> rows = {{.line = 2, .file = "a.dsa", .pressureKpa = 10.0},
                                              {.line = 3, .file = "none.dsa", .pressureKpa = 15.0},
                                              {.line = 4, .file = "b.dsa", .pressureKpa = 20.0},
                                              {.line = 5, .file = "x", .problem = "no number"}};
  std::vector<double> told;
  const CalibrationSteps all = collectCalibrationSteps(rows, "t", open, {}, [&](double done) {
    told.push_back(done);
    return true;
  });
  ASSERT_EQ(all.samples.size(), 4u);
  EXPECT_EQ(all.matrix, 3u);
  EXPECT_EQ(all.hand, sdh2().name);
  EXPECT_EQ(all.reports.size(), 2u);
  EXPECT_EQ(all.numUnused(), 2u);
  EXPECT_TRUE(all.samples[0].used);
  EXPECT_EQ(all.samples[0].sha256, "aa");
  EXPECT_FALSE(all.samples[1].used);
  EXPECT_NE(all.samples[1].notes.at(0).find("can't be opened"), std::string::npos);
  // Twice the load: twice the gain.
  EXPECT_NEAR(all.samples[2].staticResponseCounts / all.samples[0].staticResponseCounts, 2.0, 1e-3);
  EXPECT_NE(all.samples[3].notes.at(0).find("line 5"), std::string::npos);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  const Calibration calibration = calibrationOf(all);
  EXPECT_EQ(calibration.matrix, 3u);
  EXPECT_EQ(calibration.samples.size(), 4u);
  EXPECT_GT(calibration.pressure.steadyS, 0.0);
}

TEST(PressureGathering, AMatrixThatIsNotThereIsSaid) {
  const std::vector<PressureTableRow> rows = {{.line = 2, .file = "a.dsa", .pressureKpa = 10.0}};
  const CalibrationSteps all = collectCalibrationSteps(rows, "t", open, {.matrix = 9});
  ASSERT_EQ(all.samples.size(), 1u);
  EXPECT_NE(all.samples[0].notes.at(0).find("no matrix 9"), std::string::npos);
  EXPECT_THROW(collectCalibrationSteps(rows, "t", open, {}, [](double) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace palpate::calibration_samples_test
