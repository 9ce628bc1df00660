// Emulated hands stream over loopback to a StreamDevice: every value is compared with what was
// sent, and the live stages run on it.
#include "palpate/emulator/emulated_stream.h"

#include <atomic>
#include <mutex>

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "palpate/capture/capture_session.h"
#include "palpate/core/error.h"
#include "palpate/device/stream_device.h"
#include "palpate/emulator/default_scene.h"
#include "palpate/live/filter_stage.h"
#include "palpate/live/processing_chain.h"
#include "palpate/live/signals_stage.h"
#include "palpate/live/slip_stage.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/recording.h"

#include "device/collecting_sink.h"
#include "device/stream_hands.h"
#include "testing/awaited.h"
#include "testing/testing.h"

namespace palpate::testing::emulated_stream_test {
namespace {

std::unique_ptr<PhysicalHand> modelOf(const HandDescription& hand) {
  PhysicalHandOptions options;
  options.hand = hand;
  return std::make_unique<PhysicalHand>(defaultScene(hand), options);
}

StreamDeviceOptions receiverOf(const EmulatedStream& stream, const HandDescription& hand) {
  StreamDeviceOptions options;
  options.source = stream.name();
  options.hand = hand;
  return options;
}

// What was sent, frame by frame.
struct SentLog {
  EmulatedStreamObserver observer() {
    return [this](const EmulatedStreamFrame& frame) {
      std::lock_guard lock(mutex);
      values.emplace_back(frame.values.begin(), frame.values.end());
      angles.push_back(const_cast<PhysicalHand&>(frame.model).joints().angles());
      numbers.push_back(frame.number);
    };
  }
  std::mutex mutex;
  std::vector<std::vector<float>> values;
  std::vector<std::vector<double>> angles;
  std::vector<std::uint64_t> numbers;
};

const std::vector<std::string> kOtherHands = {
    "parallel_gripper", "four_fingers", "flat_pad_16x16", "sole"};

// A skin whose readings have three components and a sign.
HandDescription skinHand() {
  return parseHand(
      R"({"format": "palpate-hand", "version": 1, "name": "skin", "full_scale": 1000,
          "components": 3, "signed": true, "touch_threshold": 20,
          "matrices": [{"name": "left", "rows": 4, "columns": 3, "pitch_mm": 4.0},
                       {"name": "right", "rows": 2, "columns": 2, "pitch_mm": 4.0,
                        "picture": {"column": 1, "row": 0}}]})",
      "",
      "hand.json");
}

void recordAndCompareHand(const HandDescription& hand, EmulatedStreamFormat format) {
  SCOPED_TRACE(hand.name);
  constexpr std::size_t kFrames = 150;
  constexpr double kRateHz = 40.0;  // 3.75 s of the hand
  const TemporaryFolder folder;
  SentLog log;
  EmulatedStreamOptions options;
  options.format = format;
  options.rateHz = kRateHz;
  options.asFastAsRead = true;
  EmulatedStream stream(modelOf(hand), options, log.observer());
  auto owned = std::make_unique<StreamDevice>(receiverOf(stream, hand));
  const StreamDevice& device = *owned;
  CaptureOptions capture;
  capture.recorder.queue.blockWhenFull = true;
  CaptureSession session(std::move(owned), capture);
  RecordingOptions recording;
  recording.path = folder / "a.palpate";
  recording.stopAfterFrames = static_cast<std::int64_t>(kFrames);
  recording.preTriggerS = 0.0;
  session.startRecording(recording);
  session.start();
  ASSERT_TRUE(awaited([&] { return !session.recording(); })) << device.status().tactile.message;
  const PortStatus status = device.status().tactile;
  session.stop();
  const RecordingReport report = session.stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(status.lost, 0u);
  EXPECT_EQ(status.suspect, 0u) << device.lastFault();
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);

  const Profile profile = openRecording(folder / "a.palpate");
  EXPECT_EQ(profile.hand().name, hand.name);
  ASSERT_EQ(profile.numFrames(), kFrames);
  std::lock_guard lock(log.mutex);
  ASSERT_GE(log.values.size(), kFrames);
  std::size_t active = 0;
  for (std::size_t n = 0; n < kFrames; ++n) {
    EXPECT_EQ(log.numbers[n], n);
    const TactileFrame frame = profile.frame(n);
    ASSERT_EQ(frame.stored(), log.values[n]) << "frame " << n;
    EXPECT_EQ(frame.deviceUs, std::llround(1e6 * static_cast<double>(n) / kRateHz));
    for (const float value : frame.values) active += value > 0.0F ? 1 : 0;
  }
  EXPECT_GT(active, kFrames) << "something was touched";
  if (hand.axes.empty()) {
    EXPECT_EQ(profile.numAngles(), 0u);
    return;
  }
  // One sample of all axes before each frame, of which the last one may follow the last frame.
  ASSERT_GE(profile.numAngles(), kFrames);
  for (std::size_t n = 0; n < kFrames; ++n)
    for (std::size_t axis = 0; axis < hand.axes.size(); ++axis)
      ASSERT_EQ(static_cast<float>(profile.angles(n).values.at(axis)),
                static_cast<float>(log.angles[n].at(axis)))
          << "sample " << n << ", axis " << axis;
}

TEST(EmulatedStream, EveryValueOfEveryOtherHandIsRecordedFromPackets) {
  for (const std::string& key : kOtherHands)
    recordAndCompareHand(builtInHand(key), EmulatedStreamFormat::kBinary);
}

TEST(EmulatedStream, EveryValueOfEveryOtherHandIsRecordedFromLines) {
  for (const std::string& key : kOtherHands)
    recordAndCompareHand(builtInHand(key), EmulatedStreamFormat::kLines);
}

TEST(EmulatedStream, EveryValueOfEveryOtherHandIsRecordedFromJson) {
  for (const std::string& key : kOtherHands)
    recordAndCompareHand(builtInHand(key), EmulatedStreamFormat::kJson);
}

TEST(EmulatedStream, EveryReadingOfASkinWithThreeComponentsIsRecordedFromEachForm) {
  for (const auto format :
       {EmulatedStreamFormat::kBinary, EmulatedStreamFormat::kLines, EmulatedStreamFormat::kJson})
    recordAndCompareHand(skinHand(), format);
}

TEST(EmulatedStream, ABaselineOfASkinAtRestIsThatOfItsSensor) {
  const TemporaryFolder folder;
  PhysicalHandOptions physical;
  physical.hand = skinHand();
  EmulatedStreamOptions options;
  options.rateHz = 40.0;
  options.asFastAsRead = true;
  EmulatedStream stream(std::make_unique<PhysicalHand>(Scene(), physical), options);
  const PhysicalHand same(Scene(), physical);
  CaptureOptions capture;
  capture.recorder.queue.blockWhenFull = true;
  CaptureSession session(std::make_unique<StreamDevice>(receiverOf(stream, physical.hand)),
                         capture);
  session.start();
  ASSERT_TRUE(awaited([&] { return session.health().frames.frames >= 20; }));
  session.takeBaseline();
  RecordingOptions recording;
  recording.path = folder / "a.palpate";
  recording.stopAfterFrames = 50;
  recording.preTriggerS = 0.0;
  session.startRecording(recording);
  ASSERT_TRUE(awaited([&] { return !session.recording(); }));
  session.stop();
  session.stopRecording();
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.baselines().size(), 1u);
  const Baseline taken = *profile.baselines().front().second;
  const Baseline known = same.baseline();
  ASSERT_EQ(taken.rest.size(), known.rest.size());
  for (std::size_t i = 0; i < known.rest.size(); ++i)
    EXPECT_NEAR(taken.rest[i], known.rest[i], 3.0F) << "the noise is 1 count";
  // Over its baseline nothing is touched; without it the offsets would be.
  std::size_t touched = 0, raw = 0;
  const Profile without = profile.withBaselines({});
  for (std::size_t n = 0; n < profile.numFrames(); ++n) {
    for (const float value : profile.frame(n).values) touched += value > 0.0F ? 1 : 0;
    for (const float value : without.frame(n).values) raw += value > 0.0F ? 1 : 0;
  }
  EXPECT_EQ(touched, 0u);
  EXPECT_GT(raw, profile.numFrames());
}

TEST(EmulatedStream, AnglesAndTemperaturesArriveAsTheyAre) {
  HandDescription hand = builtInHand("parallel_gripper");
  hand.temperatureSensors = {{"motor"}, {"board"}};
  for (const EmulatedStreamFormat format :
       {EmulatedStreamFormat::kBinary, EmulatedStreamFormat::kLines, EmulatedStreamFormat::kJson}) {
    SentLog log;
    EmulatedStreamOptions options;
    options.format = format;
    options.asFastAsRead = true;
    options.rateHz = 50.0;
    EmulatedStream stream(modelOf(hand), options, log.observer());
    CollectingSink sink;
    StreamDevice device(receiverOf(stream, hand));
    device.start(sink);
    ASSERT_TRUE(sink.awaitFrames(120));
    device.stop();
    std::lock_guard lock(log.mutex);
    for (std::size_t n = 0; n < 120; ++n)
      EXPECT_EQ(static_cast<float>(sink.angles.at(n).values.at(0)),
                static_cast<float>(log.angles[n].at(0)))
          << n;
    EXPECT_NE(log.angles[119].at(0), log.angles[0].at(0)) << "it closes";
    ASSERT_GE(sink.temperatures.size(), 3u);  // at 0, 1 and 2 s
    // A motor at rest is 2 degrees above the ambient 34.
    EXPECT_NEAR(sink.temperatures[0].values.at(0), 36.0, 1e-4);
    EXPECT_NEAR(sink.temperatures[0].values.at(1), 44.5, 1e-4);
  }
}

// Mean column of the values of a pad of 16 x 16; 0 without values.
double centroidXOf(const TactileFrame& frame) {
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < 256; ++i) {
    sum += static_cast<double>(frame.values[i]) * static_cast<double>(i % 16);
    weight += static_cast<double>(frame.values[i]);
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

// Shows the time of the frame that was sent last.
struct SentClock : Clock {
  std::int64_t monotonicUs() const override { return nowUs; }
  std::int64_t wallUs() const override { return 1'700'000'000'000'000 + nowUs; }
  std::atomic<std::int64_t> nowUs{1'000'000};
  std::atomic<bool> isEnded{false};
};

// A pad with slip and filters, live: the sphere slides over it from 2 to 4 s.
TEST(EmulatedStream, FiltersAndSlipRunLiveOnAnotherHand) {
  const HandDescription& hand = builtInHand("flat_pad_16x16");
  constexpr double kRateHz = 60.0;
  EmulatedStreamOptions options;
  options.rateHz = kRateHz;
  options.asFastAsRead = true;
  std::atomic<std::size_t> frames{0};
  SentClock clock;
  // A frame is sent when all before it were processed, and arrives at its own time.
  EmulatedStream stream(modelOf(hand), options, [&](const EmulatedStreamFrame& frame) {
    if (!clock.isEnded) awaited([&] { return frames >= frame.number || clock.isEnded; });
    clock.nowUs = 1'000'000 + std::llround(frame.timeS * 1e6);
  });
  CaptureSession session(
      std::make_unique<StreamDevice>(receiverOf(stream, hand), clock), {}, clock);
  std::vector<std::unique_ptr<Stage>> stages;
  auto filters = std::make_unique<FilterStage>();
  const std::string median = "median:size=3";
  filters->setRecipe(parseRecipe(std::span(&median, 1)));
  stages.push_back(std::move(filters));
  stages.push_back(std::make_unique<SignalsStage>());
  stages.push_back(std::make_unique<SlipStage>(hand));
  std::mutex mutex;
  std::vector<bool> slipping;
  std::vector<double> centroidX;
  bool wasFiltered = true;
  ChainOptions chainOptions;
  chainOptions.lossless = true;
  chainOptions.onResults = [&](const LiveResults& results) {
    std::lock_guard lock(mutex);
    wasFiltered = wasFiltered && results.unfiltered != nullptr;
    slipping.push_back(results.slip.at(0).slipping);
    centroidX.push_back(centroidXOf(*results.frame));
    ++frames;
  };
  ProcessingChain chain(std::move(stages), chainOptions);
  chain.connect(session);
  chain.start();
  session.start();
  EXPECT_TRUE(awaited([&] { return frames >= 300u; })) << chain.failure();
  clock.isEnded = true;
  session.stop();
  chain.stop();
  EXPECT_EQ(chain.failure(), "");
  EXPECT_TRUE(wasFiltered);
  const auto at = [&](double timeS) { return static_cast<std::size_t>(timeS * kRateHz); };
  const auto anySlip = [&](double fromS, double toS) {
    return std::any_of(slipping.begin() + static_cast<std::ptrdiff_t>(at(fromS)),
                       slipping.begin() + static_cast<std::ptrdiff_t>(at(toS)),
                       [](bool is) { return is; });
  };
  EXPECT_FALSE(anySlip(0.0, 1.9)) << "pressing is no slip";
  EXPECT_TRUE(anySlip(2.0, 4.2)) << "the sphere slides by 3.2 taxels";
  // The sphere slides by a fifth of 16 columns.
  EXPECT_NEAR(centroidX[at(4.3)] - centroidX[at(1.8)], 3.2, 0.25);
}

TEST(EmulatedStream, RestsWhileNobodyIsConnectedAndGoesOnWithTheNextClient) {
  const HandDescription hand = padHand({{2, 2}});
  EmulatedStreamOptions options;
  options.asFastAsRead = true;
  EmulatedStream stream(modelOf(hand), options);
  EXPECT_EQ(stream.counts().frames, 0u);
  std::uint64_t last = 0;
  for (std::uint64_t client = 1; client <= 3; ++client) {
    CollectingSink sink;
    StreamDevice device(receiverOf(stream, hand));
    device.start(sink);
    ASSERT_TRUE(sink.awaitFrames(20));
    EXPECT_EQ(stream.counts().clients, client);
    EXPECT_EQ(device.info().firmware, "emulated");
    const std::int64_t firstUs = sink.takeFrames().front().deviceUs.value();
    EXPECT_TRUE(client == 1 ? firstUs == 0 : firstUs > 0);
    device.stop();
    // The end of the connection is noticed.
    ASSERT_TRUE(awaited([&] {
      const std::uint64_t before = last;
      last = stream.counts().frames;
      return last == before;
    }));
  }
}

TEST(EmulatedStream, FramesThatTheClientDoesNotReadAreLostAndCounted) {
  const HandDescription& hand = builtInHand("flat_pad_16x16");
  EmulatedStreamOptions options;
  options.rateHz = 5000.0;
  options.format = EmulatedStreamFormat::kJson;
  EmulatedStream stream(modelOf(hand), options);
  CollectingSink sink;
  StreamDeviceOptions receiver = receiverOf(stream, hand);
  StreamDevice device(receiver);
  std::mutex gate;
  // A sink that does not return keeps the device from reading.
  class BlockedSink : public DeviceSink {
   public:
    explicit BlockedSink(std::mutex& gate) : gate_(gate) {}
    void onFrame(TactileFrame&&) override {
      ++frames;
      std::lock_guard lock(gate_);
    }
    void onSample(Sample&&) override {}
    void onEvent(Event&&) override {}
    std::atomic<int> frames{0};

   private:
    std::mutex& gate_;
  } blocked(gate);
  gate.lock();
  device.start(blocked);
  // More than a second of frames, which the receiver finds when it reads what waited.
  constexpr std::uint64_t kLost = 10'000;
  EXPECT_TRUE(awaited([&] { return stream.counts().lost > kLost; }, std::chrono::minutes(2)));
  gate.unlock();
  // It first reads all that waits in the buffers.
  EXPECT_TRUE(
      awaited([&] { return device.status().tactile.lost > kLost; }, std::chrono::minutes(2)));
  device.stop();
  EXPECT_EQ(device.status().tactile.badChecksums, 0u);
}

TEST(EmulatedStream, FaultsOfTheConnectionAreFoundByTheReceiver) {
  const HandDescription hand = padHand({{4, 4}});
  EmulatedStreamOptions options;
  // At a rate of its own: whether 50 frames can be missing is judged by the time that passed.
  options.rateHz = 1000.0;
  options.faults = parseFaults("crc=0.05,junk_start=500,stall=0.05@0.2");
  EmulatedStream stream(modelOf(hand), options);
  CollectingSink sink;
  StreamDevice device(receiverOf(stream, hand));
  device.start(sink);
  ASSERT_TRUE(sink.awaitFrames(400));
  device.stop();
  const PortStatus status = device.status().tactile;
  EXPECT_GT(status.badChecksums, 5u);
  EXPECT_GE(status.skippedBytes, 500u);
  // 50 frames of the stall at 1000 Hz, and those with a wrong checksum.
  EXPECT_GE(status.lost, 50u + 5u);
  EXPECT_EQ(stream.counts().faults.stalls, 1u);
}

TEST(EmulatedStream, AnUnplugEndsTheConnectionAndComesBack) {
  const HandDescription hand = padHand({{2, 2}});
  EmulatedStreamOptions options;
  options.rateHz = 1000.0;
  options.faults = parseFaults("unplug=0.2@0.05");
  EmulatedStream stream(modelOf(hand), options);
  CollectingSink sink;
  StreamDevice device(receiverOf(stream, hand));
  device.start(sink);
  ASSERT_TRUE(awaited([&] { return device.status().tactile.reconnects == 1; }));
  const std::size_t before = sink.numFrames();
  EXPECT_TRUE(sink.awaitFrames(before + 20));
  device.stop();
  EXPECT_EQ(stream.counts().faults.unplugs, 1u);
  EXPECT_GE(stream.counts().lost, 199u);
}

TEST(EmulatedStream, SaysWhoCanConnectAndRefusesWhatMakesNoSense) {
  const HandDescription hand = padHand({{2, 2}});
  EmulatedStream local(modelOf(hand));
  EXPECT_TRUE(local.name().starts_with("tcp:127.0.0.1:")) << local.name();
  EXPECT_FALSE(local.isOpenToOthers());
  EXPECT_TRUE(EmulatedStream(modelOf(hand), {.where = "0.0.0.0:0"}).isOpenToOthers());
  EXPECT_TRUE(EmulatedStream(modelOf(hand), {.where = "[::1]:0"}).name().starts_with("tcp:[::1]:"));
  for (const char* where : {"", "x", "70000", "-1", "nohost:1", "127.0.0.1:"})
    EXPECT_THROW(EmulatedStream(modelOf(hand), {.where = where}), std::invalid_argument) << where;
  EXPECT_THROW(EmulatedStream(modelOf(hand), {.rateHz = 0.0}), std::invalid_argument);
  try {
    EmulatedStream second(modelOf(hand), {.where = local.name().substr(4)});
    ADD_FAILURE() << "the port is taken";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kBusy);
    EXPECT_EQ(std::string(error.what()),
              local.name() + ": another program uses this port; name another one");
  }
}

}  // namespace
}  // namespace palpate::testing::emulated_stream_test
