// The baseline of a connected hand whose readings aren't 0 at rest: taken, refused, undone, and in
// every part of a recording that one of its frames.
#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::baseline_session_test {
namespace {

using namespace testing;
using Values = std::vector<float>;

HandDescription pad() {
  return parseHand(R"({"format": "palpate-hand", "version": 1, "name": "pad", "full_scale": 1000,
      "touch_threshold": 1, "touch_sigma": 3,
      "matrices": [{"name": "a", "rows": 1, "columns": 2, "pitch_mm": 4}]})",
                   "",
                   "hand.json");
}

struct PadSession : ScriptedSession {
  PadSession() {
    session->stop();
    device->described = pad();
    session->start();
  }
  // A frame every 10 ms whose readings are these, with noise of 2.
  void read(double seconds, const Values& readings) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      clock.pass(10'000);
      TactileFrame frame(device->described.layout);
      frame.hostUs = clock.hostUs();
      frame.readings = readings;
      for (float& reading : frame.readings) reading += i % 2 == 0 ? 2.0F : -2.0F;
      device->sink->onFrame(std::move(frame));
      session->step();
    }
  }
  Values seen() { return session->takeFrame()->values; }
};

TEST(BaselineSession, IsTakenAndUndone) {
  PadSession pad;
  pad.read(2.0, {100.0F, 50.0F});
  EXPECT_EQ(pad.seen(), (Values{98.0F, 48.0F}));
  EXPECT_FALSE(pad.session->canUndoBaseline());
  EXPECT_THROW(pad.session->undoBaseline(), Error);
  const Rest rest = pad.session->restNow();
  EXPECT_EQ(rest.numFrames, 101u) << "of the last second";
  EXPECT_NEAR(rest.baseline.rest[0], 100.0F, 0.1F);
  EXPECT_NEAR(rest.baseline.noise[1], 2.0F, 0.1F);
  pad.session->takeEvents();
  EXPECT_EQ(pad.session->takeBaseline(),
            "101 frames: 2 readings at rest from 50.0 to 100.0, noise up to 2.0");
  const auto events = pad.session->takeEvents();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "baseline");
  pad.read(1.5, {100.0F, 50.0F});
  EXPECT_EQ(pad.seen(), (Values{0.0F, 0.0F})) << "rest noise is no contact";
  pad.read(0.1, {140.0F, 50.0F});
  EXPECT_NEAR(pad.seen()[0], 38.0F, 0.1F);
  EXPECT_TRUE(pad.session->canUndoBaseline());
  pad.session->undoBaseline();
  EXPECT_EQ(pad.session->takeEvents().size(), 1u);
  pad.read(0.1, {100.0F, 50.0F});
  EXPECT_EQ(pad.seen(), (Values{98.0F, 48.0F}));
}

TEST(BaselineSession, OfADisconnectedSensorThereIsNone) {
  PadSession pad;
  pad.read(2.0, {100.0F, 50.0F});
  pad.clock.pass(4'000'000);
  try {
    pad.session->takeBaseline();
    FAIL() << "no frame came for 4 s";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("fewer than two frames"), std::string::npos);
  }
  EXPECT_FALSE(pad.session->canUndoBaseline());
  pad.read(0.1, {100.0F, 50.0F});
  EXPECT_EQ(pad.session->restNow().numFrames, 10u) << "the old ones don't count";
}

TEST(BaselineSession, RefusesWhatIsNoRest) {
  PadSession pad;
  EXPECT_THROW(pad.session->takeBaseline(), Error) << "no frame came";
  pad.read(1.0, {100.0F, 50.0F});
  pad.read(0.4, {160.0F, 50.0F});
  try {
    pad.session->takeBaseline();
    FAIL() << "it was pressed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("1 reading moved"), std::string::npos) << error.what();
  }
  ScriptedSession sdh2;
  sdh2.run(1.0);
  EXPECT_THROW(sdh2.session->takeBaseline(), Error) << "its controller decides what is touched";
  EXPECT_FALSE(sdh2.session->canUndoBaseline());
}

// The pre-trigger is over the baseline before, and each part begins with its own.
TEST(BaselineSession, EveryPartIsSeenAsItWasRecorded) {
  const TemporaryFolder folder;
  PadSession pad;
  pad.read(1.5, {100.0F, 50.0F});
  pad.session->takeBaseline();
  pad.read(0.5, {130.0F, 50.0F});
  RecordingOptions options;
  options.path = folder / "a.palpate";
  options.splitS = 1.0;
  pad.session->startRecording(options);
  pad.read(2.5, {200.0F, 50.0F});
  pad.session->takeBaseline();
  pad.read(1.0, {230.0F, 50.0F});
  const RecordingReport report = pad.session->stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  ASSERT_GE(report.paths.size(), 4u);
  std::int64_t frames = 0;
  for (const auto& path : report.paths) {
    EXPECT_TRUE(recoverPalpateProfile(path).whole()) << path;
    EXPECT_EQ(recoverPalpateProfile(path).damagedRows, 0u) << path;
    const Recording read = readRecording(path);
    EXPECT_FALSE(read.profile.baselines().empty()) << path;
    frames += static_cast<std::int64_t>(read.profile.numFrames());
  }
  EXPECT_EQ(frames, report.frames);
  EXPECT_EQ(readRecording(report.paths.front()).profile.frame(0).values[0], 102.0F)
      << "before any baseline";
  const Profile last = readRecording(report.paths.back()).profile;
  EXPECT_NEAR(last.frame(last.numFrames() - 1).values[0], 28.0F, 0.1F);
}

}  // namespace
}  // namespace palpate::baseline_session_test
