// All shared real recordings, against the facts known about them (survey of 1052 files).
#include <algorithm>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::real_recordings_test {
namespace {
namespace fs = std::filesystem;

std::vector<fs::path> allRecordings(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".dsa") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(RealRecordings, allReadWithTheHandsLayoutAndWithinTheSurveysBounds) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const auto paths = allRecordings(*folder);
  ASSERT_GE(paths.size(), 600u);
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path.string());
    const Profile profile = openRecording(path);
    EXPECT_EQ(profile.info().serial, "1D9B0057");
    EXPECT_EQ(profile.info().firmware, "105");
    EXPECT_EQ(profile.info().valueType, ValueType::kCounts);
    ASSERT_EQ(profile.layout().numCells(), 486u);
    EXPECT_EQ(profile.layout().numTaxels(), 456u);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_EQ(profile.layout().matrix(i).staticMask, sdh2().layout->matrix(i).staticMask);
    EXPECT_GE(profile.numFrames(), 2u);
    EXPECT_GE(profile.frameTimeUs(0), 1'387'147'688'890'000);
    EXPECT_LE(profile.frameTimeUs(profile.numFrames() - 1), 1'417'170'971'302'000);
    float highest = 0.0F;
    TactileFrame frame;
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      profile.readFrame(i, frame);
      highest = std::max(highest, *std::max_element(frame.values.begin(), frame.values.end()));
    }
    EXPECT_LE(highest, 3567.0F);
    for (const std::string& warning : profile.info().warnings)
      EXPECT_EQ(warning.substr(0, 11), "no element ") << warning;
  }
}

TEST(RealRecordings, theSingleGraspsLastAsLongAsSurveyed) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  std::size_t files = 0;
  for (const fs::path& path : allRecordings(*folder / "grasps_by_class")) {
    SCOPED_TRACE(path.string());
    const Profile profile = openRecording(path);
    const TimingReport timing = timingOf(profile);
    ++files;
    EXPECT_GE(profile.numFrames(), 34u);
    EXPECT_LE(profile.numFrames(), 231u);
    EXPECT_GE(timing.durationS, 1.0);
    EXPECT_LE(timing.durationS, 7.3);
    EXPECT_GE(timing.meanRateHz, 31.0);
    EXPECT_LE(timing.meanRateHz, 31.9);
    EXPECT_NEAR(1000.0 / timing.rateHz, 32.0, 1.0);  // median interval [ms]
    EXPECT_GE(profile.numAngles(), 114u);
    EXPECT_LE(profile.numAngles(), 930u);
    EXPECT_EQ(profile.numTemperatures(), 0u);
    // The name holds first and last frame of the long recording it was cut from.
    const std::string name = path.stem().string();
    const int first = std::stoi(name.substr(name.size() - 13, 6));
    const int last = std::stoi(name.substr(name.size() - 6));
    EXPECT_EQ(profile.numFrames(), static_cast<std::size_t>(last - first + 1));
  }
  EXPECT_EQ(files, 571u);
}

struct Known {
  const char* path;
  std::size_t frames;
  std::size_t angles;
  std::size_t temperatures;
};

// Counts that the files declare themselves (frame_count and so on; the survey found no mismatch).
TEST(RealRecordings, countsAreTheDeclaredOnes) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  for (const Known& known :
       {Known{"grasps/foam_ball.dsa", 3289, 10952, 103},
        Known{"grasps/hockey_ball.dsa", 3121, 11303, 98},
        Known{"calibration_noise/temperature-noise.dsa", 1297, 0, 1298},
        Known{"calibration_sensitivity/sensitivity_0.1-1.0.dsa", 6912, 34022, 225},
        Known{"misc/masked_matrix.dsa", 519, 0, 0},
        Known{"slip-detection/slip_test.dsa", 5390, 0, 0},
        Known{"frequency_analysis/roughness_test_rough.dsa", 3236, 0, 45}}) {
    SCOPED_TRACE(known.path);
    const Profile profile = openRecording(*folder / known.path);
    EXPECT_EQ(profile.numFrames(), known.frames);
    EXPECT_EQ(profile.numAngles(), known.angles);
    EXPECT_EQ(profile.numTemperatures(), known.temperatures);
  }
}

TEST(RealRecordings, ratesAndGapsAreTheSurveyedOnes) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const auto timing = [&](const char* path) { return timingOf(openRecording(*folder / path)); };
  EXPECT_NEAR(timing("misc/masked_matrix.dsa").meanRateHz, 54.8, 0.1);
  EXPECT_NEAR(timing("calibration_noise/temperature-noise.dsa").meanRateHz, 0.33, 0.005);
  const TimingReport fast = timing("frequency_analysis/roughness_test_rough.dsa");
  EXPECT_NEAR(1000.0 / fast.rateHz, 14.0, 0.01);
  const TimingReport slip = timing("slip-detection/slip_test.dsa");
  const auto longest =
      std::max_element(slip.gaps.begin(), slip.gaps.end(), [](const Gap& a, const Gap& b) {
        return a.seconds < b.seconds;
      });
  ASSERT_NE(longest, slip.gaps.end());
  EXPECT_NEAR(longest->seconds, 147.5, 0.05);
}

TEST(RealRecordings, theMaskedRecordingHasItsMasks) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  const Profile profile = openRecording(*folder / "misc/masked_matrix.dsa");
  std::size_t off = 0;
  for (const MatrixLayout& matrix : profile.layout().matrices()) {
    const auto on = std::count(matrix.dynamicMask.begin(), matrix.dynamicMask.end(), 1);
    if (on == 0) ++off;
    // Either all off, all on, or only the two places of row 9, columns 2 and 3.
    if (on == 2) {
      EXPECT_EQ(matrix.dynamicMask[9 * 6 + 2], 1);
      EXPECT_EQ(matrix.dynamicMask[9 * 6 + 3], 1);
    } else {
      EXPECT_TRUE(on == 0 || on == static_cast<std::ptrdiff_t>(matrix.numCells()));
    }
  }
  EXPECT_GE(off, 1u);
}

TEST(RealRecordings, allAreSound) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  for (const fs::path& path : allRecordings(*folder)) {
    const VerifyReport report = verifyRecording(path);
    EXPECT_EQ(report.state, VerifyReport::State::kSound) << path << ": " << report.message;
  }
}

}  // namespace
}  // namespace palpate::real_recordings_test
