// Recordings that begin and end with contact.
#include <stdexcept>

#include "palpate/capture/recorder.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::contact_recording_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;

// A session whose device delivers a frame every 10 ms, pressed or not.
class ContactRecording : public ::testing::Test {
 protected:
  ContactRecording() {
    options_.path = folder_ / "a.palpate";
    options_.startOnContact = true;
  }
  void run(double seconds, bool pressed) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      scripted_.clock.pass(10'000);
      TactileFrame frame(sdh2().layout);
      frame.hostUs = scripted_.clock.hostUs();
      if (pressed)
        for (std::size_t k = 0; k < 5; ++k) frame.values[k] = 700.0F;
      scripted_.device->sink->onFrame(std::move(frame));
      scripted_.device->angles(static_cast<std::size_t>(i), scripted_.clock.hostUs());
      scripted_.session->step();
    }
  }
  std::int64_t now() const { return scripted_.clock.hostUs(); }
  RecorderStatus::State state() const { return scripted_.session->recorderStatus().state; }

  const TemporaryFolder folder_;
  ScriptedSession scripted_;
  RecordingOptions options_;
};

TEST_F(ContactRecording, WhatWasLostWhileItWaitedIsNotCounted) {
  scripted_.session->startRecording(options_);
  run(3.0, false);
  scripted_.device->state.tactile.lost = 206;
  run(3.0, false);
  run(1.0, true);
  scripted_.device->state.tactile.lost = 209;
  EXPECT_EQ(scripted_.session->stopRecording().counters.at("lost"), 3);
}

TEST_F(ContactRecording, BeginsTwoSecondsBeforeTheContact) {
  run(1.0, false);
  scripted_.session->startRecording(options_);
  run(5.0, false);
  EXPECT_EQ(state(), RecorderStatus::State::kArmed);
  EXPECT_FALSE(fs::exists(options_.path)) << "nothing is written before";
  EXPECT_TRUE(scripted_.session->health().alarms.empty()) << "waiting is no alarm";
  const std::int64_t contactUs = now() + 10'000;
  run(1.0, true);
  EXPECT_EQ(state(), RecorderStatus::State::kRecording);
  EXPECT_NEAR(scripted_.session->recorderStatus().elapsedS, 1.0, 0.1) << "since the contact";
  const RecordingReport report = scripted_.session->stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  const Profile profile = openRecording(options_.path);
  EXPECT_EQ(profile.frameTimeUs(0), contactUs - 2'000'000);
  EXPECT_EQ(profile.numFrames(), 300u) << "a frame every 10 ms: none is missing, none twice";
  EXPECT_EQ(profile.angleTimeUs(0), contactUs - 2'000'000);
}

TEST_F(ContactRecording, ContactThatIsThereAlreadyBeginsItAtOnce) {
  run(3.0, true);
  scripted_.session->startRecording(options_);
  const std::int64_t firstUs = now();
  run(1.0, true);
  EXPECT_EQ(state(), RecorderStatus::State::kRecording);
  scripted_.session->stopRecording();
  // What was touched before the request begins nothing, but is in the two seconds before.
  EXPECT_EQ(openRecording(options_.path).frameTimeUs(0), firstUs - 2'000'000);
}

TEST_F(ContactRecording, StoppedBeforeTheContactItLeavesNoFileAndSaysWhy) {
  scripted_.session->startRecording(options_);
  run(1.0, false);
  const RecordingReport report = scripted_.session->stopRecording();
  EXPECT_TRUE(report.paths.empty());
  EXPECT_EQ(report.message, "nothing was touched");
  EXPECT_FALSE(fs::exists(options_.path));
  EXPECT_FALSE(scripted_.session->recording());
}

TEST_F(ContactRecording, EndsWhenNothingIsTouchedForLongEnough) {
  options_.stopWithoutContactS = 1.5;
  scripted_.session->startRecording(options_);
  run(1.0, false);
  run(1.0, true);
  run(1.0, false);  // shorter than 1.5 s
  run(0.5, true);
  const std::int64_t releasedUs = now() + 10'000;
  run(1.4, false);
  EXPECT_TRUE(scripted_.session->recording());
  run(0.3, false);
  EXPECT_FALSE(scripted_.session->recording());
  const Profile profile = openRecording(options_.path);
  EXPECT_EQ(profile.frameTimeUs(profile.numFrames() - 1), releasedUs + 1'500'000 - 10'000)
      << "the last frame before the end";
}

TEST_F(ContactRecording, StartedByHandItWaitsForAContactBeforeItEnds) {
  options_.startOnContact = false;
  options_.stopWithoutContactS = 0.5;
  scripted_.session->startRecording(options_);
  run(3.0, false);
  EXPECT_TRUE(scripted_.session->recording()) << "nothing was touched yet";
  run(0.2, true);
  run(0.7, false);
  EXPECT_FALSE(scripted_.session->recording());
}

TEST_F(ContactRecording, AnInterruptedStreamIsNoRelease) {
  options_.stopWithoutContactS = 0.5;
  scripted_.session->startRecording(options_);
  run(0.5, true);
  scripted_.clock.pass(5'000'000);
  scripted_.session->step();
  run(0.5, true);
  EXPECT_TRUE(scripted_.session->recording());
  scripted_.clock.pass(5'000'000);
  run(0.3, false);
  EXPECT_TRUE(scripted_.session->recording()) << "released for 0.3 s as far as is known";
  run(0.4, false);
  EXPECT_FALSE(scripted_.session->recording());
}

TEST_F(ContactRecording, TheDurationCountsFromTheContact) {
  options_.stopAfterS = 1.0;
  options_.preTriggerS = 0.0;
  scripted_.session->startRecording(options_);
  run(4.0, false);
  const std::int64_t contactUs = now() + 10'000;
  run(2.5, true);
  EXPECT_FALSE(scripted_.session->recording());
  const Profile profile = openRecording(options_.path);
  EXPECT_EQ(profile.numFrames(), 100u);
  EXPECT_EQ(profile.frameTimeUs(0), contactUs);
}

TEST_F(ContactRecording, OptionsOutOfRangeAreRefused) {
  options_.stopWithoutContactS = 0.0;
  EXPECT_THROW(scripted_.session->startRecording(options_), std::invalid_argument);
  options_.stopWithoutContactS.reset();
  options_.contact.taxels = 0;
  EXPECT_THROW(scripted_.session->startRecording(options_), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::contact_recording_test
