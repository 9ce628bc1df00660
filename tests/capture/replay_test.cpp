#include "palpate/capture/replay.h"

#include <set>
#include <thread>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "recording/palpate_damage.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::replay_test {
namespace {
using namespace testing;

// Stores the delivered items in their order.
class Listener : public DeviceSink {
 public:
  struct Item {
    char kind;
    std::int64_t tUs;
  };
  std::vector<Item> items;
  std::vector<TactileFrame> frames;
  std::vector<Sample> angles;
  std::vector<Sample> temperatures;
  std::vector<Event> events;

  void onFrame(TactileFrame&& frame) override {
    items.push_back({'f', frame.hostUs});
    frames.push_back(std::move(frame));
  }
  void onSample(Sample&& sample) override {
    const bool isAngles = sample.series == kAngleSeries;
    items.push_back({isAngles ? 'a' : 't', sample.hostUs});
    (isAngles ? angles : temperatures).push_back(std::move(sample));
  }
  void onEvent(Event&& event) override {
    items.push_back({'e', event.tUs});
    events.push_back(std::move(event));
  }
  std::string order() const {
    std::string text;
    for (const Item& item : items) text += item.kind;
    return text;
  }
};

// Frames at 0, 10, 20, 40 ms; angles at 5, 10, 35 ms; a temperature at 10 ms.
Profile shortProfile() {
  ProfileBuilder builder(sdh2().layout);
  for (const std::int64_t ms : {0, 10, 20, 40})
    builder.addFrame(kWallStartUs + ms * 1000,
                     numberedFrame(static_cast<std::size_t>(ms), 0).values,
                     ms % 20 == 0 ? std::optional(ms * 1000) : std::nullopt);
  for (const std::int64_t ms : {5, 10, 35})
    builder.addAngles(kWallStartUs + ms * 1000, numberedAngles(1, 0).values);
  builder.addTemperatures(kWallStartUs + 10'000, std::vector<double>(9, 33.25));
  return builder.finish({});
}

ReplayOptions byHand() { return {ReplayPace::kManual, 1.0}; }

TEST(Replay, deliversInOrderOfTimeAndWhatBelongsToAFrameBeforeIt) {
  Listener listener;
  const Event label{kWallStartUs + 10'000, kWallStartUs + 12'000, "label", 2, "x", "{}"};
  Replay replay(shortProfile(), byHand(), {label});
  replay.start(listener);
  EXPECT_EQ(listener.order(), "");
  replay.advance(0);
  EXPECT_EQ(listener.order(), "f");
  replay.advance(9'999);
  EXPECT_EQ(listener.order(), "fa");
  replay.advance(1);
  EXPECT_EQ(listener.order(), "faetaf");
  EXPECT_FALSE(replay.finished());
  replay.advance(1'000'000);
  EXPECT_EQ(listener.order(), "faetaffafe");
  EXPECT_TRUE(replay.finished());
  EXPECT_EQ(listener.events[0].kind, "label");
  EXPECT_EQ(listener.events[0].matrix, 2);
  EXPECT_EQ(listener.events[0].t1Us, kWallStartUs + 12'000);
  EXPECT_EQ(listener.events[1].text, "the recording has ended");
  EXPECT_EQ(listener.frames[1].deviceUs, std::nullopt);
  EXPECT_EQ(listener.frames[2].deviceUs, 20'000);
  replay.advance(1'000'000);  // nothing is delivered twice
  EXPECT_EQ(listener.items.size(), 10u);
}

TEST(Replay, startsAnewFromTheBeginning) {
  Listener listener;
  Replay replay(shortProfile(), byHand());
  EXPECT_THROW(replay.advance(1), std::logic_error);
  replay.start(listener);
  EXPECT_THROW(replay.start(listener), std::logic_error);
  replay.advance(15'000);
  replay.stop();
  EXPECT_EQ(replay.status().tactile.state, PortState::kClosed);
  listener = {};
  replay.start(listener);
  replay.advance(100'000);
  EXPECT_EQ(listener.order(), "fataffafe");
}

TEST(Replay, itsStatusIsThatOfAHand) {
  Listener listener;
  Replay replay(shortProfile(), byHand());
  replay.start(listener);
  replay.advance(20'000);
  DeviceStatus status = replay.status();
  EXPECT_EQ(status.tactile.state, PortState::kStreaming);
  EXPECT_EQ(status.tactile.items, 3u);
  EXPECT_EQ(status.tactile.lastItemUs, kWallStartUs + 20'000);
  ASSERT_TRUE(status.motion);
  EXPECT_EQ(status.motion->items, 3u);
  replay.advance(20'000);
  status = replay.status();
  EXPECT_EQ(status.tactile.state, PortState::kSilent);
  EXPECT_EQ(status.tactile.message, "the recording has ended");
  EXPECT_EQ(replay.hand().name, shortProfile().hand().name);
}

TEST(Replay, takesNoCommand) {
  Replay replay(shortProfile());
  try {
    replay.submit(StopMotion{}).get();
    FAIL();
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kUnsupported);
  }
}

TEST(Replay, anEmptyRecordingEndsAtOnce) {
  Listener listener;
  Replay replay(ProfileBuilder(sdh2().layout).finish({}), {ReplayPace::kRecorded, 1.0});
  replay.start(listener);
  while (!replay.finished()) std::this_thread::yield();
  replay.stop();
  EXPECT_EQ(listener.order(), "e");
  EXPECT_FALSE(replay.status().motion);
}

TEST(Replay, keepsTimeTimesItsSpeed) {
  for (const double speed : {16.0, 4.0}) {
    Listener listener;
    SyntheticOptions options;
    options.durationS = 2.0;
    options.grasps = 1;
    const Profile profile = synthesize(options);
    Replay replay(profile, {ReplayPace::kRecorded, speed});
    const auto begin = std::chrono::steady_clock::now();
    replay.start(listener);
    while (!replay.finished()) std::this_thread::yield();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    replay.stop();
    EXPECT_EQ(listener.frames.size(), profile.numFrames());
    // Never early; late only by the delay of a busy machine.
    EXPECT_GE(took.count(), static_cast<double>(profile.durationUs()) / 1e6 / speed - 0.001);
    EXPECT_LT(took.count(), testing::timeLimit(10.0));
  }
  EXPECT_THROW(Replay(shortProfile(), {ReplayPace::kRecorded, 17.0}), std::invalid_argument);
  Replay replay(shortProfile());
  EXPECT_THROW(replay.setSpeed(0.05), std::invalid_argument);
}

Profile twoFrames(double apartS) {
  ProfileBuilder builder(sdh2().layout);
  const std::vector<float> zero(sdh2().layout->numCells());
  builder.addFrame(kWallStartUs, zero);
  builder.addFrame(kWallStartUs + static_cast<std::int64_t>(apartS * 1e6), zero);
  return builder.finish({});
}

TEST(Replay, itsSpeedChangesWhileItWaits) {
  Listener listener;
  Replay replay(twoFrames(3.0), {ReplayPace::kRecorded, 0.1});  // 30 s
  const auto begin = std::chrono::steady_clock::now();
  replay.start(listener);
  while (replay.status().tactile.items < 1) std::this_thread::yield();
  replay.setSpeed(16.0);  // 0.2 s
  while (!replay.finished()) std::this_thread::yield();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, testing::timeLimit(std::chrono::seconds(15)));
  EXPECT_EQ(listener.frames.size(), 2u);
}

TEST(Replay, stopsAtOnceThoughItWaits) {
  Listener listener;
  Replay replay(twoFrames(3600.0));
  const auto begin = std::chrono::steady_clock::now();
  replay.start(listener);
  while (replay.status().tactile.items < 1) std::this_thread::yield();
  replay.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, testing::timeLimit(std::chrono::seconds(2)));
  EXPECT_EQ(listener.frames.size(), 1u);
}

void expectSame(const Profile& a, const Profile& b) {
  ASSERT_EQ(a.numFrames(), b.numFrames());
  ASSERT_EQ(a.numAngles(), b.numAngles());
  ASSERT_EQ(a.numTemperatures(), b.numTemperatures());
  for (std::size_t i = 0; i < a.numFrames(); ++i) {
    const TactileFrame x = a.frame(i);
    const TactileFrame y = b.frame(i);
    ASSERT_EQ(x.values, y.values) << i;
    ASSERT_EQ(x.hostUs, y.hostUs) << i;
    ASSERT_EQ(x.deviceUs, y.deviceUs) << i;
  }
  for (std::size_t i = 0; i < a.numAngles(); ++i) {
    ASSERT_EQ(a.angles(i).values, b.angles(i).values) << i;
    ASSERT_EQ(a.angleTimeUs(i), b.angleTimeUs(i)) << i;
  }
  for (std::size_t i = 0; i < a.numTemperatures(); ++i) {
    ASSERT_EQ(a.temperatures(i).values, b.temperatures(i).values) << i;
    ASSERT_EQ(a.temperatureTimeUs(i), b.temperatureTimeUs(i)) << i;
  }
}

// Replays a profile through a session into a new recording.
Profile recordedAgain(const Profile& profile, const std::filesystem::path& path) {
  CaptureOptions options;
  options.recorder.queue.blockWhenFull = true;
  auto replay = std::make_unique<Replay>(profile, ReplayOptions{ReplayPace::kUnpaced, 1.0});
  const Replay& running = *replay;
  CaptureSession session(std::move(replay), options);
  RecordingOptions recording;
  recording.path = path;
  recording.preTriggerS = 60.0;
  session.startRecording(recording);
  session.start();
  while (!running.finished()) std::this_thread::yield();
  session.stop();
  const RecordingReport report = session.stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  return openRecording(path);
}

// R17: a recording that is replayed and recorded again has the same content.
TEST(Replay, aRealRecordingReplayedAndRecordedIsTheSameBitByBit) {
  const auto recordings = recordingsFolder();
  PALPATE_NEED(recordings);
  const TemporaryFolder folder;
  const Profile original = openRecording(*recordings / "grasps/foam_ball.dsa");
  ASSERT_GT(original.numFrames(), 1000u);
  const Profile first = recordedAgain(original, folder / "1.palpate");
  expectSame(original, first);
  expectSame(first, recordedAgain(first, folder / "2.palpate"));
}

TEST(Replay, aSyntheticRecordingReplayedAndRecordedIsTheSameBitByBit) {
  const TemporaryFolder folder;
  SyntheticOptions options;
  options.noiseCounts = 8.0;
  const Profile original = synthesize(options);
  expectSame(original, recordedAgain(original, folder / "1.palpate"));
}

// Writes a recording of `frames` frames with one byte flipped in its third tactile block. Returns
// the number of frames in that block.
std::size_t writeDamaged(const std::filesystem::path& path, std::size_t frames) {
  writeSamples(path, frames);
  const BlockBytes block = blockBytes(path).at(2);
  std::string bytes = readFile(path);
  bytes[block.end - 1] = static_cast<char>(bytes[block.end - 1] ^ 1);
  writeFile(path, bytes);
  return block.n;
}

// C-A1: frames in a damaged block are counted, reported and skipped.
TEST(Replay, whatADamagedBlockHeldIsCountedToldAndPassedOver) {
  constexpr std::size_t kFrames = 60;
  const TemporaryFolder folder;
  const std::size_t lost = writeDamaged(folder / "damaged.palpate", kFrames);
  ASSERT_GE(lost, 3u);  // a frame in the middle of the block has no stamp in the index
  for (const ReplayOptions& options :
       {byHand(), ReplayOptions{ReplayPace::kUnpaced, 1.0}, ReplayOptions{}}) {
    Listener listener;
    Replay replay(openRecording(folder / "damaged.palpate"), options);
    if (options.pace == ReplayPace::kRecorded) replay.setSpeed(16.0);
    replay.start(listener);
    if (options.pace == ReplayPace::kManual) replay.advance(60'000'000);
    while (!replay.finished()) std::this_thread::yield();
    replay.stop();
    EXPECT_EQ(listener.frames.size(), kFrames - lost);
    EXPECT_EQ(replay.status().tactile.items, kFrames - lost);
    EXPECT_EQ(replay.status().tactile.lost, lost);
    EXPECT_EQ(listener.angles.size(), 4 * kFrames);
    std::size_t alarms = 0;
    for (const Event& event : listener.events) alarms += event.kind == "alarm" ? 1 : 0;
    EXPECT_EQ(alarms, 1u);
    for (std::size_t i = 1; i < listener.items.size(); ++i)
      EXPECT_LE(listener.items[i - 1].tUs, listener.items[i].tUs);
  }
}

// Frames every 10 ms, of which the times of some can't be read, and two temperatures.
class LostTimes final : public ProfileStorage {
 public:
  explicit LostTimes(std::set<std::size_t> lost) : lost_(std::move(lost)) {}
  std::size_t numFrames() const override { return 6; }
  std::int64_t frameTimeUs(std::size_t frame) const override {
    if (lost_.contains(frame)) throw FormatError("a.h5", "libhdf5 could not read it (crashed)");
    return kWallStartUs + static_cast<std::int64_t>(frame) * 10'000;
  }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    out = numberedFrame(frame, frameTimeUs(frame));
  }
  std::size_t numSamples(std::size_t series) const override {
    return series == kTemperatureSeries ? 2 : 0;
  }
  std::int64_t sampleTimeUs(std::size_t, std::size_t sample) const override {
    return kWallStartUs + 45'000 + static_cast<std::int64_t>(sample) * 10'000;
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    return {sampleTimeUs(series, sample), {33.0}, series};
  }

 private:
  std::set<std::size_t> lost_;
};

TEST(Replay, aFrameWhoseTimeCanNotBeReadIsCountedToldAndPassedOver) {
  const auto replayed = [](std::set<std::size_t> lost, ReplayPace pace) {
    Listener listener;
    Replay replay(Profile({}, sdh2(), std::make_shared<LostTimes>(lost)), {pace, 16.0});
    replay.start(listener);
    if (pace == ReplayPace::kManual) replay.advance(1'000'000);
    while (!replay.finished()) std::this_thread::yield();
    EXPECT_EQ(replay.status().tactile.state, PortState::kSilent);
    EXPECT_EQ(replay.status().tactile.lost, lost.size());
    EXPECT_EQ(listener.frames.size(), 6 - lost.size());
    EXPECT_EQ(listener.temperatures.size(), 2u);
    EXPECT_EQ(listener.events.front().kind, "alarm");
    EXPECT_NE(listener.events.front().text.find("crashed"), std::string::npos);
    EXPECT_GE(listener.events.front().tUs, kWallStartUs);
    return listener.order();
  };
  for (const ReplayPace pace : {ReplayPace::kManual, ReplayPace::kUnpaced, ReplayPace::kRecorded}) {
    EXPECT_EQ(replayed({2, 3}, pace), "ffeftfte");
    EXPECT_EQ(replayed({0}, pace), "efffftfte");
    EXPECT_EQ(replayed({5}, pace), "fffffette");
  }
}

// C-A2: no exception in the delivering thread ends the process.
TEST(Replay, aSinkThatFailsEndsTheReplayNotTheProcess) {
  class Failing : public Listener {
   public:
    void onFrame(TactileFrame&& frame) override {
      if (frames.size() == 2) throw std::runtime_error("the sink is broken");
      Listener::onFrame(std::move(frame));
    }
  };
  Failing listener;
  Replay replay(shortProfile(), {ReplayPace::kUnpaced, 1.0});
  replay.start(listener);
  while (!replay.finished()) std::this_thread::yield();
  replay.stop();
  EXPECT_EQ(listener.frames.size(), 2u);
  ASSERT_FALSE(listener.events.empty());
  EXPECT_EQ(listener.events.back().kind, "alarm");
  EXPECT_NE(listener.events.back().text.find("the sink is broken"), std::string::npos);
  EXPECT_NE(replay.status().tactile.message.find("the sink is broken"), std::string::npos);
}

}  // namespace
}  // namespace palpate::replay_test
