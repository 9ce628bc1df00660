// Series of other sensors, recorded beside the hand in the same session.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <span>
#include <stdexcept>
#include <thread>

#include "palpate/capture/replay.h"
#include "palpate/core/json.h"
#include "palpate/core/time.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "testing/awaited.h"
#include "testing/testing.h"

namespace palpate::series_recording_test {
namespace {
using namespace testing;

// A sender whose bytes come when the test says so. Shared with the thread of the source.
struct Wire {
  std::mutex mutex;
  std::string waiting;
  bool plugged = true;
  void send(const std::string& text) {
    const std::lock_guard lock(mutex);
    waiting += text;
  }
};

class WireChannel : public ByteChannel {
 public:
  explicit WireChannel(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {}
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard lock(wire_->mutex);
    if (!wire_->plugged) throw DeviceError(DeviceFault::kDisconnected, name_, "unplugged");
    const std::size_t count = std::min(into.size(), wire_->waiting.size());
    for (std::size_t i = 0; i < count; ++i) into[i] = static_cast<std::byte>(wire_->waiting[i]);
    wire_->waiting.erase(0, count);
    return count;
  }
  void write(std::span<const std::byte>) override {}
  void interrupt() noexcept override {}
  const std::string& name() const noexcept override { return name_; }

 private:
  std::shared_ptr<Wire> wire_;
  std::string name_ = "wire";
};

// A session on a scripted device, with series whose senders the test plays.
struct Session {
  HandClock clock;
  ScriptedDevice* device = nullptr;
  std::unique_ptr<CaptureSession> session;
  std::vector<std::shared_ptr<Wire>> wires;
  std::size_t frames = 0;

  explicit Session(const std::vector<std::string>& names, CaptureOptions options = {}) {
    auto owned = std::make_unique<ScriptedDevice>();
    device = owned.get();
    options.ownThread = false;
    session = std::make_unique<CaptureSession>(std::move(owned), std::move(options), clock);
    for (const std::string& name : names) session->addSeries(source(name));
    session->start();
  }
  std::unique_ptr<SeriesSource> source(const std::string& name) {
    wires.push_back(std::make_shared<Wire>());
    SeriesSourceOptions options{.name = name, .source = "wire"};
    options.open = [wire = wires.back()](const std::string& port) -> std::unique_ptr<ByteChannel> {
      const std::lock_guard lock(wire->mutex);
      if (!wire->plugged) throw DeviceError(DeviceFault::kNotFound, port, "no such port");
      return std::make_unique<WireChannel>(wire);
    };
    return std::make_unique<SeriesSource>(std::move(options), clock);
  }
  std::uint64_t rowsOf(std::size_t i) const {
    return session->seriesSources()[i]->status().port.items;
  }
  // Sends rows to a series, each 10 ms after the other, with a frame.
  void rows(std::size_t i, int count) {
    for (int n = 0; n < count; ++n) {
      const std::uint64_t before = rowsOf(i);
      clock.pass(10'000);
      wires[i]->send(std::to_string(n) + "," + std::to_string(2 * n) + "\n");
      ASSERT_TRUE(awaited([&] { return rowsOf(i) == before + 1; }));
      // The source counts a row before it delivers it.
      frame();
    }
  }
  void frame() {
    device->frame(frames++, clock.hostUs());
    session->step();
  }
  void record(const std::filesystem::path& path) {
    RecordingOptions options;
    options.path = path;
    session->startRecording(options);
  }
  // All rows that were sent have been delivered when the sources have stopped.
  RecordingReport stop() {
    session->stop();
    return session->stopRecording();
  }
};

TEST(SeriesRecording, SeriesAreInTheFileWithTheirColumns) {
  const TemporaryFolder folder;
  Session bench({"wrist", "cell"});
  bench.record(folder / "a.palpate");
  bench.frame();
  bench.wires[1]->send("f[N],g[N]\n");  // the second one is known first
  bench.rows(1, 20);
  bench.rows(0, 30);
  const RecordingReport report = bench.stop();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(report.frames, 51);
  ASSERT_EQ(report.series.size(), 2u);
  EXPECT_EQ(report.series[0].name, "wrist");
  EXPECT_EQ(report.series[0].samples, 30);
  EXPECT_EQ(report.series[0].lost, 0);
  EXPECT_NEAR(report.series[0].rateHz, 100.0, 1.0);
  EXPECT_EQ(report.series[1].samples, 20);
  EXPECT_EQ(report.counter("series_wrist_lost"), 0);
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.series().size(), kHandSeries + 2);
  EXPECT_EQ(profile.series()[kHandSeries],
            (SeriesDescription{"cell", "", {{"f", "N"}, {"g", "N"}}, "wire"}));
  EXPECT_EQ(profile.series()[kHandSeries + 1].name, "wrist");
  ASSERT_EQ(profile.numSamples(kHandSeries + 1), 30u);
  EXPECT_EQ(profile.sample(kHandSeries + 1, 29).values, (std::vector<double>{29, 58}));
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);

  // A replay delivers them, and a hand without a motion port doesn't matter.
  Replay replay(profile, {.pace = ReplayPace::kManual});
  ASSERT_EQ(replay.series().size(), 2u);
  EXPECT_EQ(replay.series()[0].name, "cell");
  CaptureOptions options;
  options.ownThread = false;
  HandClock clock;
  auto owned = std::make_unique<Replay>(
      profile, ReplayOptions{.pace = ReplayPace::kManual}, std::vector<Event>(), clock);
  Replay* const again = owned.get();
  CaptureSession second(std::move(owned), options, clock);
  RecordingOptions to;
  to.path = folder / "b.palpate";
  second.startRecording(to);
  second.start();
  again->advance(10'000'000);
  const RecordingReport copied = second.stopRecording();
  EXPECT_EQ(copied.samples, 50);
  const Profile copy = openRecording(folder / "b.palpate");
  ASSERT_EQ(copy.series().size(), profile.series().size());
  for (std::size_t i = kHandSeries; i < copy.series().size(); ++i)
    EXPECT_EQ(copy.series()[i], profile.series()[i]);
}

TEST(SeriesRecording, EachPartHasThem) {
  const TemporaryFolder folder;
  Session bench({"wrist", "cell"});
  RecordingOptions options;
  options.path = folder / "a.palpate";
  options.splitS = 1.0;
  bench.session->startRecording(options);
  bench.frame();
  bench.rows(1, 60);
  bench.rows(0, 60);
  bench.rows(1, 100);
  const RecordingReport report = bench.stop();
  EXPECT_TRUE(report.complete) << report.message;
  ASSERT_GE(report.paths.size(), 2u);
  std::size_t samples = 0;
  for (const auto& path : report.paths) {
    const Profile profile = openRecording(path);
    for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
      samples += profile.numSamples(i);
    EXPECT_EQ(profile.series()[kHandSeries].name, "cell");
  }
  EXPECT_EQ(samples, 220u);
}

TEST(SeriesRecording, AnMcapFileBesideItHoldsTheSameSeries) {
  const TemporaryFolder folder;
  Session bench({"wrist", "cell"});
  RecordingOptions options;
  options.path = folder / "a.palpate";
  options.mcap.emplace();
  bench.session->startRecording(options);
  bench.frame();
  bench.wires[1]->send("f[N],g[N]\n");
  bench.rows(1, 20);
  bench.rows(0, 30);
  const RecordingReport report = bench.stop();
  EXPECT_EQ(report.mcapFailure, "");
  const Profile native = openRecording(folder / "a.palpate");
  const Profile mcap = openRecording(folder / "a.mcap");
  ASSERT_EQ(mcap.furtherSeries().size(), 2u);
  for (std::size_t s = kHandSeries; s < native.series().size(); ++s) {
    const auto same = std::ranges::find(mcap.series(), native.series()[s]);
    ASSERT_NE(same, mcap.series().end()) << native.series()[s].name;
    const auto at = static_cast<std::size_t>(same - mcap.series().begin());
    ASSERT_EQ(mcap.numSamples(at), native.numSamples(s));
    for (std::size_t i = 0; i < native.numSamples(s); ++i) {
      EXPECT_EQ(mcap.sample(at, i).hostUs, native.sample(s, i).hostUs);
      EXPECT_EQ(mcap.sample(at, i).values, native.sample(s, i).values);
    }
  }
}

// Bytes of a sender that are no rows, or rows from another clock, cost nothing of the others.
TEST(SeriesRecording, BadRowsOfOneSourceLeaveTheOthersAsTheyAre) {
  const TemporaryFolder folder;
  Session bench({"early", "late", "bad"});
  bench.record(folder / "a.palpate");
  bench.frame();
  const auto send = [&](std::size_t i, const std::string& text) {
    const std::uint64_t before = bench.rowsOf(i);
    bench.clock.pass(5'000);
    bench.wires[i]->send(text);
    ASSERT_TRUE(awaited([&] { return bench.rowsOf(i) == before + 1; })) << text;
    bench.frame();
  };
  bench.wires[0]->send("time_s,f[N]\n");
  bench.wires[1]->send("time_s,f[N]\n");
  bench.wires[2]->send("time_s,f[N],g[N]\n");
  for (int n = 0; n < 20; ++n) {
    const std::string row = std::to_string(n) + "\n";
    send(0, std::to_string(1'000.0 + 0.01 * n) + "," + row);
    send(1, std::to_string(4'600.0 + 0.01 * n) + "," + row);  // an hour later
    // A time that is back, and NaN; then other columns, too many numbers, none, an infinite one.
    send(2,
         std::to_string(100 - n) + ",nan," + row +
             "u[V],v[V]\n1,2\ntime_s,f[N],g[N]\n1,2,3,4\n;;;;\n1,inf,2\n");
  }
  ASSERT_TRUE(
      awaited([&] { return bench.session->seriesSources()[2]->status().port.suspect == 100; }));
  const RecordingReport report = bench.stop();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(report.counter("series_early_lost"), 0);
  EXPECT_EQ(report.counter("series_bad_lost"), 0);
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(profile.furtherSeries().size(), 3u);
  EXPECT_EQ(profile.numFrames(), 61u);
  for (std::size_t s = kHandSeries; s < kHandSeries + 3; ++s) {
    ASSERT_EQ(profile.numSamples(s), 20u);
    const bool isBad = profile.series()[s].name == "bad";
    const double firstS = profile.series()[s].name == "early" ? 1'000.0 : 4'600.0;
    for (std::size_t n = 0; n < 20; ++n) {
      const Sample sample = profile.sample(s, n);
      EXPECT_EQ(sample.values.back(), static_cast<double>(n));
      EXPECT_EQ(std::isnan(sample.values.front()), isBad);
      // Arrivals are in the order of the host, whatever the clocks of the senders say.
      EXPECT_LT(std::abs(sample.hostUs - profile.frameTimeUs(3 * n + 1)), 15'001);
      ASSERT_TRUE(sample.deviceUs.has_value());
      if (isBad) {
        EXPECT_GE(*sample.deviceUs, profile.sample(s, n == 0 ? 0 : n - 1).deviceUs.value_or(-1));
      } else {
        EXPECT_NEAR(static_cast<double>(*sample.deviceUs),
                    1e6 * (firstS + 0.01 * static_cast<double>(n)),
                    1.0);
      }
    }
  }
}

TEST(SeriesRecording, ASeriesThatStopsForGoodIsAnOpenGapAndAnAlarm) {
  const TemporaryFolder folder;
  Session bench({"wrist", "cell"});
  bench.record(folder / "a.palpate");
  bench.frame();
  bench.rows(0, 50);
  bench.rows(1, 50);  // meanwhile the other one is silent
  const auto state = [&] { return bench.session->seriesSources()[0]->status().port.state; };
  ASSERT_TRUE(awaited([&] {
    bench.clock.pass(100'000);
    bench.frame();
    return state() == PortState::kSilent;
  }));
  const RecordingReport report = bench.stop();
  EXPECT_EQ(report.series.at(0).samples, 50);
  EXPECT_GT(report.counter("series_wrist_lost"), 40) << "also those of the gap without an end";
  const Recording read = readableRecording(folder / "a.palpate");
  EXPECT_EQ(std::ranges::count_if(read.events,
                                  [](const Event& event) {
                                    return event.kind == "gap" &&
                                           event.json.find("\"wrist\"") != std::string::npos;
                                  }),
            1);
  EXPECT_TRUE(std::ranges::any_of(read.events, [](const Event& event) {
    return event.kind == "alarm" && event.text.find("wrist") != std::string::npos;
  }));
}

TEST(SeriesRecording, AnUnpluggedSourceIsAGapAndTheHandGoesOn) {
  const TemporaryFolder folder;
  Session bench({"wrist"});
  bench.record(folder / "a.palpate");
  bench.frame();
  bench.rows(0, 50);
  const auto state = [&] { return bench.session->health().series.at(0).port.state; };
  {
    const std::lock_guard lock(bench.wires[0]->mutex);
    bench.wires[0]->plugged = false;
  }
  ASSERT_TRUE(awaited([&] { return state() == PortState::kLost; }));
  const LinkHealth health = bench.session->health();
  EXPECT_TRUE(std::ranges::any_of(
      health.alarms, [](const Alarm& alarm) { return alarm.kind == AlarmKind::kNoRows; }));
  for (int i = 0; i < 100; ++i) {
    bench.clock.pass(10'000);
    bench.frame();
  }
  {
    const std::lock_guard lock(bench.wires[0]->mutex);
    bench.wires[0]->plugged = true;
  }
  ASSERT_TRUE(awaited([&] {
    bench.clock.pass(100'000);  // until it is tried again
    return state() == PortState::kStreaming;
  }));
  bench.rows(0, 10);
  const RecordingReport report = bench.stop();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(report.frames, 161);
  EXPECT_EQ(report.series.at(0).samples, 60);
  EXPECT_GE(report.counter("series_wrist_lost"), 90);
  EXPECT_EQ(report.counter("series_wrist_reconnects"), 1);
  EXPECT_EQ(report.counter("lost"), 0);
  EXPECT_EQ(report.openGapS, 0.0);
  std::size_t gaps = 0;
  for (const Event& event : readableRecording(folder / "a.palpate").events)
    if (event.kind == "gap") {
      ++gaps;
      EXPECT_EQ(Json::parse(event.json).at("stream").asString(), "wrist");
    }
  EXPECT_EQ(gaps, 1u);
}

TEST(SeriesRecording, NamesAreUnique) {
  Session bench({"wrist"});
  for (const char* name : {"wrist", "angles", "temperatures", "tactile", "events"})
    EXPECT_THROW(bench.session->addSeries(bench.source(name)), std::invalid_argument) << name;
  EXPECT_THROW(bench.session->addSeries(nullptr), std::invalid_argument);
  bench.session->addSeries(bench.source("cell"));
  EXPECT_EQ(bench.session->furtherSeries().size(), 2u);
}

TEST(SeriesRecording, SensorsComeAndGoWhileNothingIsRecorded) {
  const TemporaryFolder folder;
  Session bench({"wrist"});
  const auto before = bench.session->subscribe("a consumer");
  bench.frame();
  bench.session->addSeries(bench.source("cell"));  // it starts at once
  bench.rows(1, 3);
  EXPECT_EQ(bench.session->health().series.size(), 2u);
  bench.session->removeSeries("wrist");
  EXPECT_THROW(bench.session->removeSeries("wrist"), std::invalid_argument);
  ASSERT_EQ(bench.session->seriesSources().size(), 1u);
  EXPECT_EQ(bench.session->seriesSources()[0]->name(), "cell");
  ASSERT_EQ(bench.session->furtherSeries().size(), 2u) << "indexes stay";
  EXPECT_EQ(bench.session->furtherSeries()[0].name, "");
  EXPECT_EQ(bench.session->furtherSeries()[1].name, "cell");
  bench.session->addSeries(bench.source("wrist"));  // its name is free again
  bench.record(folder / "a.palpate");
  EXPECT_THROW(bench.session->addSeries(bench.source("other")), std::logic_error);
  EXPECT_THROW(bench.session->removeSeries("cell"), std::logic_error);
  bench.clock.pass(10'000);
  bench.frame();
  for (int i = 0; i < 5; ++i) {
    bench.clock.pass(10'000);
    bench.wires[2]->send("1,2\n");  // of the second "wrist"
    ASSERT_TRUE(awaited([&] {
      return bench.session->seriesSources()[1]->status().port.items == std::uint64_t(i) + 1;
    }));
    bench.frame();
  }
  const RecordingReport report = bench.stop();
  EXPECT_TRUE(report.complete) << report.message;
  const Profile profile = openRecording(folder / "a.palpate");
  const auto wrist = profile.seriesNamed("wrist");
  ASSERT_TRUE(wrist);
  EXPECT_EQ(profile.numSamples(*wrist), 5u);
}

// What came before the recording, of a sensor that is gone, is no loss.
TEST(SeriesRecording, ARemovedSensorLeavesNothingInTheRecording) {
  const TemporaryFolder folder;
  Session bench({"wrist"});
  bench.rows(0, 5);
  bench.session->removeSeries("wrist");
  bench.record(folder / "a.palpate");
  for (int i = 0; i < 3; ++i) {
    bench.clock.pass(10'000);
    bench.frame();
  }
  const RecordingReport report = bench.stop();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(report.refused, 0);
  EXPECT_TRUE(report.series.empty());
  EXPECT_TRUE(openRecording(folder / "a.palpate").furtherSeries().empty());
}

TEST(SeriesRecording, TheClockOfARemovedSensorIsGone) {
  Session bench({"wrist"});
  bench.wires[0]->send("time_ms,fx\n1,2\n");
  ASSERT_TRUE(awaited([&] { return bench.session->health().clocks.size() == 1; }));
  EXPECT_EQ(bench.session->health().clocks[0].of, "wrist");
  bench.session->removeSeries("wrist");
  EXPECT_TRUE(bench.session->health().clocks.empty());
}

// A writer that is killed leaves what was committed.
TEST(SeriesRecording, AKilledWriterLeavesTheSeries) {
  const TemporaryFolder folder;
  Session bench({"wrist"});
  bench.record(folder / "a.palpate");
  bench.frame();
  bench.rows(0, 50);
  ASSERT_TRUE(awaited([&] {
    bench.session->step();
    return bench.session->recorderStatus().samples == 50;
  }));
  bench.clock.pass(200'000);
  bench.session->step();
  const auto copy = folder / "killed.palpate";
  std::filesystem::copy_file(folder / "a.palpate", copy);
  const Recording read = readableRecording(copy);
  ASSERT_EQ(read.profile.series().size(), kHandSeries + 1);
  EXPECT_EQ(read.profile.numSamples(kHandSeries), 50u);
  bench.stop();
}

// However fast a series is, the hand's samples find room.
TEST(SeriesRecording, AFullQueueLosesSamplesOfTheSeriesOnly) {
  CaptureQueueOptions options;
  options.motionItems = 100;
  CaptureQueue queue("the test", options);
  queue.nameSeries({"angles", "temperatures", "wrist"});
  for (int i = 1; i <= 500; ++i) queue.put(Sample{i, {1.0}, kHandSeries});
  for (int i = 1; i <= 50; ++i) EXPECT_TRUE(queue.put(Sample{i, {1.0}, kAngleSeries}));
  std::vector<CaptureItem> items;
  queue.take(items);
  EXPECT_EQ(items.size(), 100u);
  EXPECT_EQ(queue.stats().lost[1 + kHandSeries], 450u);
  EXPECT_EQ(queue.stats().lost[1 + kAngleSeries], 0u);
  items.clear();
  queue.nameSeries({"angles", "temperatures", "", "cell"});  // it is removed, its loss stays
  queue.takeOpenGaps(items);
  ASSERT_EQ(items.size(), 1u);
  EXPECT_EQ(Json::parse(std::get<Event>(items[0]).json).at("stream").asString(), "wrist");
}

TEST(SeriesRecording, WhoMovesTheHandReceivesNoneOfThem) {
  Session bench({"wrist"});
  CaptureQueueOptions options;
  options.onlyHand = true;
  const auto hand = bench.session->subscribe("the hand", options);
  const auto all = bench.session->subscribe("all");
  bench.rows(0, 5);
  bench.session->stop();
  std::vector<CaptureItem> items;
  hand->take(items);
  for (const CaptureItem& item : items) EXPECT_EQ(streamOf(item), CaptureStream::kTactile);
  EXPECT_EQ(items.size(), 5u);
  items.clear();
  all->take(items);
  EXPECT_GE(items.size(), 10u);
}

}  // namespace
}  // namespace palpate::series_recording_test
