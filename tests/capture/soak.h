// Test of a day of one hand in a short time: an emulated hand at full speed, both ports, driver,
// session, recorder and disk; then the recording is replayed (reliability R11, R17).
#pragma once

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "palpate/capture/capture_session.h"
#include "palpate/capture/replay.h"
#include "palpate/device/live_hand.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "device/collecting_sink.h"
#include "emulator/numbered_hand.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::testing {

// Compares what a replay delivers with the recording's frames.
class ReplayCheck : public DeviceSink {
 public:
  explicit ReplayCheck(const Profile& profile) : profile_(profile) {}
  void onFrame(TactileFrame&& frame) override {
    if (frames < profile_.numFrames()) {
      profile_.readFrame(frames, expected_);
      if (expected_.values != frame.values || expected_.hostUs != frame.hostUs) ++different;
    }
    ++frames;
  }
  void onSample(Sample&& sample) override {
    if (sample.series == kAngleSeries) ++angles;
  }
  void onEvent(Event&&) override {}
  std::size_t frames = 0, angles = 0, different = 0;

 private:
  const Profile& profile_;
  TactileFrame expected_;
};

inline void soak(std::size_t frames) {
  const TemporaryFolder folder;
  EmulatedHandOptions options;
  options.dsaPort = folder / "dsa";
  options.sdhPort = folder / "sdh";
  options.rate = EmulationRate::kMax;
  EmulatedHand hand(std::make_unique<NumberedHand>(), options);
  LiveHandOptions ports;
  ports.dsaPort = hand.dsaPort();
  ports.sdhPort = hand.sdhPort();
  CaptureOptions capture;
  // The hand waits for the disk, because it runs faster than any real one.
  capture.recorder.queue.blockWhenFull = true;
  CaptureSession session(std::make_unique<LiveHand>(ports), capture);
  RecordingOptions recording;
  recording.path = folder / "day.palpate";
  recording.preTriggerS = 0.0;
  recording.stopAfterFrames = static_cast<std::int64_t>(frames);
  session.startRecording(recording);
  session.start();
  ProcessFacts warm, end;
  const auto from = std::chrono::steady_clock::now();
  bool isWarm = false;
  while (session.recording() &&
         std::chrono::steady_clock::now() - from < std::chrono::minutes(30)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const auto done = static_cast<std::size_t>(session.recorderStatus().frames);
    if (!isWarm && done > frames / 10) {
      isWarm = true;
      warm = leastProcessFacts();
    }
    if (done < frames * 9 / 10 || end.threads != 0) continue;
    end = leastProcessFacts();
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
  if (end.threads == 0) end = leastProcessFacts();
  ASSERT_TRUE(isWarm);
  const RecordingReport report = session.stopRecording();
  session.stop();
  EXPECT_TRUE(report.complete) << report.message;
  ASSERT_EQ(report.frames, static_cast<std::int64_t>(frames));
  EXPECT_EQ(session.health().badChecksums, 0u);
  // Fewer are possible: the recording may have ended while they were counted.
  EXPECT_LE(end.descriptors, warm.descriptors);
  EXPECT_LE(end.threads, warm.threads);
  // The queues fill while the disk syncs; they contain 64 MB at most. Memory does not grow with the
  // length of the recording.
  if (kMemoryIsOurs) {
    EXPECT_LT(end.residentBytes, warm.residentBytes + (80u << 20));
  }

  const Profile profile = openRecording(folder / "day.palpate");
  ASSERT_EQ(profile.numFrames(), frames);
  TactileFrame frame;
  std::optional<std::uint64_t> first;
  for (std::size_t i = 0; i < frames; ++i) {
    profile.readFrame(i, frame);
    const auto number = NumberedHand::numberOf(frame.values);
    ASSERT_TRUE(number) << "frame " << i << " was never sent";
    if (!first) first = number;
    ASSERT_EQ(*number, *first + i) << "recorded = sent";
  }
  ReplayCheck check(profile);
  ReplayOptions pace;
  pace.pace = ReplayPace::kManual;
  Replay replay(profile, pace);
  replay.start(check);
  while (!replay.finished()) replay.advance(1'000'000);
  replay.stop();
  EXPECT_EQ(check.frames, frames);
  EXPECT_EQ(check.angles, profile.numAngles());
  EXPECT_EQ(check.different, 0u);
  std::printf(
      "%zu frames (%.1f h of a hand) in %.0f s, %lld MB; memory %zu -> %zu MB, descriptors %zu, "
      "threads %zu\n",
      frames,
      static_cast<double>(frames) / 31.7 / 3600.0,
      seconds,
      static_cast<long long>(report.bytes >> 20),
      warm.residentBytes >> 20,
      end.residentBytes >> 20,
      end.descriptors,
      end.threads);
}

}  // namespace palpate::testing
