// Tests of recordings during which the layout changes: other sensors, other masks.
#include "palpate/capture/recorder.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::recorder_layout_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;

TEST(RecorderLayout, aSensorOfAnotherShapeBeginsAPartOfItsOwn) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  const auto pad = std::make_shared<const SensorLayout>(std::vector{MatrixLayout::full(4, 5, 3.4)});
  for (int i = 0; i < 10; ++i) {
    scripted.clock.pass(10'000);
    TactileFrame frame(pad);
    frame.hostUs = scripted.clock.hostUs();
    scripted.device->sink->onFrame(std::move(frame));
    scripted.session->step();
  }
  const RecordingReport report = scripted.session->stopRecording();
  ASSERT_EQ(report.paths.size(), 2u);
  EXPECT_EQ(openRecording(report.paths[0]).numFrames(), 50u);
  EXPECT_EQ(openRecording(report.paths[1]).numFrames(), 10u);
  EXPECT_EQ(openRecording(report.paths[1]).layout().numCells(), 20u);
}

// A frame of the SDH-2, with one taxel of the first matrix switched off if `masked`.
TactileFrame maskedFrame(std::size_t n, std::int64_t hostUs, bool masked) {
  static const auto maskedLayout = [] {
    std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
    matrices[0].dynamicMask[40] = 0;
    return std::make_shared<const SensorLayout>(std::move(matrices));
  }();
  TactileFrame frame = numberedFrame(n, hostUs);
  if (masked) frame.layout = maskedLayout;
  return frame;
}

// C-A4: a part states of every taxel whether it was scanned.
TEST(RecorderLayout, aMaskThatChangesBeginsANewPart) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  std::size_t n = 0;
  const auto send = [&](std::size_t count, bool masked) {
    for (std::size_t i = 0; i < count; ++i) {
      scripted.clock.pass(10'000);
      scripted.device->sink->onFrame(maskedFrame(n++, scripted.clock.hostUs(), masked));
    }
  };
  // The items from before the start already have two layouts.
  send(5, false);
  send(5, true);
  scripted.session->step();
  scripted.session->startRecording(to(folder / "a.palpate"));
  send(10, true);
  scripted.session->step();
  send(10, false);
  scripted.session->step();
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  ASSERT_EQ(report.paths.size(), 3u);
  std::vector<std::size_t> all;
  for (std::size_t part = 0; part < 3; ++part) {
    const Profile profile = openRecording(report.paths[part]);
    EXPECT_EQ(profile.layout().matrix(0).dynamicMask[40], part == 1 ? 0 : 1) << part;
    for (const std::size_t number : numbersIn(report.paths[part])) all.push_back(number);
  }
  EXPECT_EQ(all, upTo(0, 30));
}

}  // namespace
}  // namespace palpate::recorder_layout_test
