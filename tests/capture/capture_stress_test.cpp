// Long runs and many repetitions, short form: R11 (recorded = sent, no growth) and R14 (starts and
// stops while all consumers read; the tsan build detects data races). The long forms run the same
// tests with more frames and cycles: capture/stress_long.
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

#include "palpate/core/number_text.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::capture_stress_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;

std::size_t countFrom(const char* variable, std::size_t usual) {
  const char* given = std::getenv(variable);
  return given ? static_cast<std::size_t>(parseInteger(given).value_or(0)) : usual;
}

// A hand with two ports and a thread for each: delivers frames and angles as fast as they are
// accepted.
class EagerDevice : public ScriptedDevice {
 public:
  explicit EagerDevice(std::size_t frames) : frames_(frames) {}
  ~EagerDevice() override { EagerDevice::stop(); }

  void start(DeviceSink& to) override {
    sink_ = &to;
    done = false;
    threads_.emplace_back([this](const std::stop_token& stop) { deliverFrames(stop); });
    threads_.emplace_back([this](const std::stop_token& stop) { deliverAngles(stop); });
  }
  void stop() noexcept override { threads_.clear(); }
  DeviceStatus status() const override {
    DeviceStatus now;
    now.tactile.state = PortState::kStreaming;
    now.tactile.items = sentFrames;
    return now;
  }

  std::atomic<std::size_t> sentFrames = 0;
  std::atomic<std::size_t> sentAngles = 0;
  std::atomic<bool> done = false;

 private:
  void deliverFrames(const std::stop_token& stop) {
    for (std::size_t n = 0; n < frames_ && !stop.stop_requested(); ++n) {
      sink_->onFrame(numberedFrame(n, kWallStartUs + static_cast<std::int64_t>(n) * 31'500));
      sentFrames = n + 1;
    }
    done = true;
  }
  void deliverAngles(const std::stop_token& stop) {
    // A recording begins with its first frame; of the angles before it, only the last minute is
    // kept.
    while (sentFrames == 0 && !stop.stop_requested()) std::this_thread::yield();
    for (std::size_t n = 0; n < 3 * frames_ && !stop.stop_requested(); ++n) {
      const std::int64_t atUs = kWallStartUs + static_cast<std::int64_t>(n) * 9'000;
      sink_->onSample(numberedAngles(n, atUs));
      if (n % 111 == 0) sink_->onSample({atUs, std::vector<double>(9, 30.0), kTemperatureSeries});
      if (n % 1000 == 0) sink_->onEvent({atUs, atUs, "motion", {}, "moved", ""});
      sentAngles = n + 1;
    }
  }

  const std::size_t frames_;
  DeviceSink* sink_ = nullptr;
  std::vector<std::jthread> threads_;
};

// Sanitizers keep their own history, so the memory size has no meaning then.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kMemoryScatterKb = 1u << 20;
#else
constexpr std::size_t kMemoryScatterKb = 16u << 10;
#endif

struct Footprint {
  std::size_t kilobytes = 0;  // resident
  std::size_t threads = 0;
  std::size_t descriptors = 0;
};

Footprint footprint() {
  Footprint now;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:") status >> now.kilobytes;
    if (word == "Threads:") status >> now.threads;
  }
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd"))
    ++now.descriptors;
  return now;
}

// R11.
TEST(CaptureStress, everyFrameOfALongRunIsRecordedAndNothingGrows) {
  const std::size_t frames = countFrom("PALPATE_STRESS_FRAMES", 100'000);
  const TemporaryFolder folder;
  CaptureOptions options;
  options.recorder.queue.blockWhenFull = true;  // as fast as the disk takes it
  options.recorder.queue.tactileItems = 256;  // a queue that fills late is not memory that grows
  options.recorder.queue.motionItems = 256;
  auto owned = std::make_unique<EagerDevice>(frames);
  EagerDevice& device = *owned;
  CaptureSession session(std::move(owned), options);
  RecordingOptions recording;
  recording.path = folder / "a.palpate";
  session.startRecording(recording);
  session.start();
  std::optional<Footprint> warm;
  Footprint last;
  while (!device.done || device.sentAngles < 3 * frames) {
    session.takeFrame();
    session.takeEvents();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!warm && device.sentFrames > frames / 4 && device.sentAngles > 3 * frames / 4)
      warm = footprint();
    last = footprint();
  }
  session.stop();
  const RecordingReport report = session.stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(report.frames, static_cast<std::int64_t>(frames));
  EXPECT_EQ(report.angles, static_cast<std::int64_t>(3 * frames));
  ASSERT_TRUE(warm);
  EXPECT_LE(last.kilobytes, warm->kilobytes + kMemoryScatterKb) << "memory grows";
  EXPECT_LE(last.descriptors, warm->descriptors + 2);  // SQLite opens and closes its journal
  EXPECT_LE(last.threads, warm->threads);
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.numFrames(), frames);
  ASSERT_EQ(profile.numAngles(), 3 * frames);
  TactileFrame frame;
  for (std::size_t i = 0; i < frames; ++i) {
    const TactileFrame sent =
        numberedFrame(i, kWallStartUs + static_cast<std::int64_t>(i) * 31'500);
    profile.readFrame(i, frame);
    ASSERT_EQ(frame.values, sent.values) << i;
    ASSERT_EQ(frame.hostUs, sent.hostUs) << i;
    ASSERT_EQ(frame.deviceUs, sent.deviceUs) << i;
  }
  std::printf("%zu frames: %zu kB when warm, %zu kB at the end, %.0f MB on disk\n",
              frames,
              warm->kilobytes,
              last.kilobytes,
              static_cast<double>(report.bytes) / 1e6);
}

// R14: capture, recording, a live consumer and a display, started and stopped repeatedly.
TEST(CaptureStress, startsAndStopsWhileEverythingPulls) {
  const std::size_t cycles = countFrom("PALPATE_STRESS_CYCLES", 60);
  const TemporaryFolder folder;
  auto owned = std::make_unique<EagerDevice>(std::size_t{1} << 40);
  EagerDevice& device = *owned;
  CaptureOptions options;
  options.recorder.queue.tactileItems = 256;  // small enough to overflow, too
  options.recorder.queue.motionItems = 256;
  CaptureSession session(std::move(owned), options);
  std::atomic<std::size_t> seen = 0;
  std::atomic<std::size_t> processed = 0;
  std::jthread screen([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      seen += session.takeFrame() ? 1 : 0;
      session.takeAngles();
      session.takeTemperatures();
      session.takeEvents();
      session.health();
      session.checkPreflight(folder.path());
      std::this_thread::yield();
    }
  });
  std::size_t recorded = 0;
  Footprint early;
  for (std::size_t cycle = 0; cycle < cycles; ++cycle) {
    const auto queue = session.subscribe("live processing");
    std::jthread live([&](const std::stop_token& stop) {
      std::vector<CaptureItem> items;
      while (!stop.stop_requested()) {
        queue->wait(std::chrono::milliseconds(5), stop);
        processed += queue->take(items);
        items.clear();
      }
    });
    session.start();
    const std::size_t before = device.sentFrames;
    RecordingOptions recording;
    recording.path = folder / (std::to_string(cycle) + ".palpate");
    const bool records = cycle % 2 == 0;
    if (records) session.startRecording(recording);
    while (device.sentFrames < 50 || device.sentFrames == before) std::this_thread::yield();
    session.mark("now");
    if (cycle % 4 == 0) {
      const RecordingReport report = session.stopRecording();
      recorded += static_cast<std::size_t>(report.frames);
    }
    session.stop();  // ends a running recording
    if (records) {
      const RecordingReport report = session.stopRecording();
      if (cycle % 4 != 0) recorded += static_cast<std::size_t>(report.frames);
      for (const fs::path& path : report.paths) {
        const bool look = cycle % 50 == 0;
        EXPECT_TRUE(!look || verifyRecording(path).state == VerifyReport::State::kSound) << path;
        fs::remove(path);
      }
    }
    if (cycle == cycles / 4) early = footprint();
  }
  const Footprint late = footprint();
  screen = {};
  EXPECT_GT(recorded, 0u);
  EXPECT_GT(seen, 0u);
  EXPECT_GT(processed, 0u);
  EXPECT_LE(late.descriptors, early.descriptors + 2);
  EXPECT_LE(late.threads, early.threads + 2);
  EXPECT_LE(late.kilobytes, early.kilobytes + 4 * kMemoryScatterKb);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace palpate::capture_stress_test
