#include "palpate/capture/capture_session.h"

#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate {
namespace {
using namespace testing;

RecordingOptions to(const std::filesystem::path& path) {
  RecordingOptions options;
  options.path = path;
  return options;
}

TEST(CaptureSession, RecordsWhatTheDeviceDelivers) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.device->says.serial = "1D9B0057";
  RecordingOptions options = to(folder / "a.palpate");
  options.meta["operator"] = "Ada";
  scripted.session->startRecording(options);
  scripted.run(3.0);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(report.frames, 300);
  EXPECT_EQ(report.angles, 600);
  EXPECT_EQ(report.temperatures, 3);
  EXPECT_NEAR(report.rateHz, 100.0, 1e-9);
  EXPECT_NEAR(report.meanRateHz, 100.0, 1e-9);
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.numFrames(), 300u);
  EXPECT_EQ(profile.info().serial, "1D9B0057");
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame expected =
        numberedFrame(i, kWallStartUs + 10'000 * static_cast<std::int64_t>(i + 1));
    const TactileFrame frame = profile.frame(i);
    ASSERT_EQ(frame.values, expected.values) << i;
    ASSERT_EQ(frame.hostUs, expected.hostUs);
    ASSERT_EQ(frame.deviceMs, expected.deviceMs);
  }
  ASSERT_EQ(profile.numAngles(), 600u);
  EXPECT_EQ(profile.angles(599).deg, numberedAngles(599, 0).deg);
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
}

}  // namespace
}  // namespace palpate
