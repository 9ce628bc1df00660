#include "palpate/capture/capture_session.h"

#include <map>
#include <thread>

#include <sqlite3.h>

#include "palpate/core/json.h"
#include "palpate/device/live_hand.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "emulator/numbered_hand.h"
#include "testing/testing.h"

namespace palpate::capture_session_test {
namespace {
using namespace testing;

// Rows of two columns as text, read by SQLite itself.
std::map<std::string, std::string> readTable(const std::filesystem::path& path, const char* sql) {
  std::map<std::string, std::string> rows;
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  sqlite3_exec(
      database,
      sql,
      [](void* to, int, char** values, char**) {
        (*static_cast<std::map<std::string, std::string>*>(to))[values[0]] = values[1];
        return 0;
      },
      &rows,
      nullptr);
  sqlite3_close(database);
  return rows;
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
    ASSERT_EQ(frame.deviceUs, expected.deviceUs);
  }
  ASSERT_EQ(profile.numAngles(), 600u);
  EXPECT_EQ(profile.angles(599).values, numberedAngles(599, 0).values);
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
}

// A recording of 2 s, the second of which is silent: what is missing is in the file, up to its end.
TEST(CaptureSession, ASilenceAtTheEndOfTheRecordingIsAGap) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  RecordingOptions options = to(folder / "a.palpate");
  options.stopAfterS = 2.0;
  scripted.session->startRecording(options);
  scripted.run(1.0);
  scripted.device->silentSinceUs = scripted.clock.hostUs();
  for (int i = 0; i < 60 && scripted.session->recording(); ++i) {
    scripted.clock.pass(100'000);
    scripted.session->step();
  }
  ASSERT_FALSE(scripted.session->recording());
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.counters.at("lost"), 7);
  EXPECT_NEAR(report.openGapS, 1.0, 0.02);
  EXPECT_EQ(report.openGapText(), "no frame came in its last 1.0 s");
  const auto events = readableRecording(folder / "a.palpate").events;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "gap");
  EXPECT_EQ(events[0].tUs, scripted.device->silentSinceUs);
  EXPECT_EQ(events[0].t1Us, kWallStartUs + 2'010'000) << "2 s from the first frame";
}

// Frames at 31.25 Hz by their own clock, every second one 20 ms late.
TEST(CaptureSession, KnowsTheClockOfTheSender) {
  ScriptedSession scripted;
  EXPECT_TRUE(scripted.session->health().clocks.empty());
  for (std::size_t n = 0; n < 1000; ++n)
    scripted.device->frame(
        n, testing::kWallStartUs + static_cast<std::int64_t>(n) * 32'000 + (n % 2) * 20'000);
  const auto clocks = scripted.session->health().clocks;
  ASSERT_EQ(clocks.size(), 1u);
  EXPECT_EQ(clocks[0].of, "frames");
  EXPECT_EQ(clocks[0].report.items, 1000u);
  EXPECT_NEAR(clocks[0].report.delaySpreadMs, 20.0, 1e-9);
  EXPECT_NEAR(clocks[0].report.driftPpm.value(), 0.0, 1e-9);
  EXPECT_EQ(clocks[0].report.restarts, 0u);
}

// The sender comes back while the recording ends: the link counts the frames that the gap at the
// end told already, and those of a gap that begins later.
TEST(CaptureSession, AGapAtTheEndIsCountedOnce) {
  for (const bool silent : {false, true}) {
    const TemporaryFolder folder;
    ScriptedSession scripted;
    PortStatus& port = scripted.device->state.tactile;
    port.lost = 100;  // before the recording
    scripted.session->startRecording(to(folder / "a.palpate"));
    scripted.run(0.5);
    port.lost += 2;
    if (silent) scripted.device->silentSinceUs = scripted.clock.hostUs();
    scripted.clock.pass(1'000'000);
    scripted.device->afterOpenGap = [&] {
      port.lost += 7;
      port.estimatedLost += 7;
    };
    const auto counters = scripted.session->stopRecording().counters;
    EXPECT_EQ(counters.at("lost"), silent ? 9 : 2);
    EXPECT_EQ(counters.contains("lost_estimated") ? counters.at("lost_estimated") : 0,
              silent ? 7 : 0);
  }
}

TEST(CaptureSession, notesWhatTheDeviceSaysAboutItselfAndWhatTheLinkCounted) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  DeviceInfo& says = scripted.device->says;
  says.serial = "1D9B0057";
  says.firmware = "2.9.0.0";
  says.sensorRevision = 105;
  says.motionFirmware = "0.0.3.3";
  says.matrices = std::vector<MatrixSettings>(6, {0.5, 150});
  scripted.device->state.tactile.badChecksums = 10;  // before the recording
  RecordingOptions options = to(folder / "a.palpate");
  options.meta = {{"operator", "Ada"}, {"object", "cup"}, {"run", "3"}, {"notes", "a\nb"}};
  scripted.session->startRecording(options);
  scripted.run(0.5);
  scripted.device->state.tactile.badChecksums = 14;
  scripted.device->state.tactile.lost = 2;
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.counters.at("bad_checksums"), 4);
  EXPECT_EQ(report.counters.at("lost"), 2);
  const auto meta = readTable(folder / "a.palpate", "SELECT key, value FROM meta");
  EXPECT_EQ(meta.at("operator"), "Ada");
  EXPECT_EQ(meta.at("object"), "cup");
  EXPECT_EQ(meta.at("run"), "3");
  EXPECT_EQ(meta.at("notes"), "a\nb");
  EXPECT_EQ(meta.at("serial"), "1D9B0057");
  EXPECT_EQ(meta.at("firmware"), "2.9.0.0");
  EXPECT_EQ(meta.at("sensor_revision"), "105");
  EXPECT_EQ(meta.at("motion_firmware"), "0.0.3.3");
  EXPECT_EQ(meta.at("program").rfind("palpate ", 0), 0u);
  const Json settings = Json::parse(meta.at("settings"));
  ASSERT_EQ(settings.size(), 6u);
  EXPECT_EQ(settings.at(5).at("threshold_counts").asInteger(), 150);
  const auto counters = readTable(folder / "a.palpate", "SELECT name, value FROM counter");
  EXPECT_EQ(counters.at("bad_checksums"), "4");
  EXPECT_EQ(counters.at("lost"), "2");
  EXPECT_EQ(counters.at("recorder_lost"), "0");
}

TEST(CaptureSession, eventsOfTheDeviceAndMarksAreRecordedAndShown) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  scripted.session->mark();
  const std::int64_t markedUs = scripted.clock.hostUs();
  scripted.run(0.5);
  scripted.session->mark("touch", 3);
  scripted.device->sink->onEvent(
      {markedUs + 1, markedUs + 900, "gap", 2, "no frames came", "{\"missed\":28}"});
  scripted.run(0.1);
  scripted.session->stopRecording();
  const std::vector<Event> expected{
      {markedUs, markedUs, "mark", {}, "", ""},
      {markedUs + 1, markedUs + 900, "gap", 2, "no frames came", "{\"missed\":28}"},
      {markedUs + 500'000, markedUs + 500'000, "label", {}, "touch", "{\"digit\":3}"}};
  EXPECT_EQ(readEvents(folder / "a.palpate").events, expected);
  const auto shown = scripted.session->takeEvents();
  ASSERT_EQ(shown.size(), 3u);  // in the order of arrival
  EXPECT_EQ(shown[1], expected[2]);
  EXPECT_TRUE(scripted.session->takeEvents().empty());
  scripted.session->mark("shown, though nothing is recorded");
  EXPECT_EQ(scripted.session->takeEvents().size(), 1u);
}

TEST(CaptureSession, keepsTheLastThousandEventsForTheScreen) {
  ScriptedSession scripted;
  for (int i = 0; i < 1500; ++i) scripted.session->mark(std::to_string(i));
  const auto shown = scripted.session->takeEvents();
  ASSERT_EQ(shown.size(), 1000u);
  EXPECT_EQ(shown.front().text, "500");
}

TEST(CaptureSession, theScreenGetsTheNewestOnce) {
  ScriptedSession scripted;
  EXPECT_FALSE(scripted.session->takeFrame());
  scripted.run(1.0);
  const SharedFrame frame = scripted.session->takeFrame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(numberOf(*frame), 99u);
  EXPECT_FALSE(scripted.session->takeFrame());
  EXPECT_EQ(scripted.session->screenStats().skipped, 99u);
  EXPECT_EQ(scripted.session->takeAngles()->values, numberedAngles(199, 0).values);
  EXPECT_FALSE(scripted.session->takeAngles());
  EXPECT_EQ(scripted.session->takeTemperatures()->values[0], 30.0);
}

TEST(CaptureSession, aSubscriberGetsEverythingInOrderWhateverTheRecorderDoes) {
  ScriptedSession scripted;
  const auto queue = scripted.session->subscribe("live processing");
  scripted.run(1.0, false);  // the recorder does nothing
  std::vector<CaptureItem> items;
  EXPECT_EQ(queue->take(items), 100u + 200u + 1u);
  for (std::size_t i = 1; i < items.size(); ++i)
    ASSERT_LE(stampOf(items[i - 1]), stampOf(items[i]));
}

TEST(CaptureSession, aSubscriberThatIsTooSlowLosesItsOwnItemsOnly) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  CaptureQueueOptions few;
  few.tactileItems = few.motionItems = 10;
  const auto queue = scripted.session->subscribe("live processing", few);
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(1.0);
  EXPECT_EQ(queue->stats().lost[0], 90u);
  EXPECT_TRUE(scripted.session->stopRecording().complete);
  EXPECT_EQ(openRecording(folder / "a.palpate").numFrames(), 100u);
  EXPECT_TRUE(readEvents(folder / "a.palpate").events.empty());
}

TEST(CaptureSession, aSubscriptionLetGoIsForgotten) {
  ScriptedSession scripted;
  auto queue = scripted.session->subscribe("one");
  const auto other = scripted.session->subscribe("two");
  scripted.run(0.1);
  queue.reset();
  scripted.run(0.1);
  EXPECT_EQ(other->stats().tactile.depth, 20u);
  scripted.session.reset();
  EXPECT_TRUE(other->closed());  // a waiting consumer is woken
}

TEST(CaptureSession, linkHealthCountsWhatCame) {
  CaptureOptions options;
  options.recorder.commitIntervalMs = 500.0;
  options.recorder.freeBytes = [](const std::filesystem::path&) {
    return std::uint64_t{7'200'000};
  };
  const TemporaryFolder folder;
  ScriptedSession scripted(options);
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(10.0);
  TactileFrame hot = numberedFrame(0, scripted.clock.hostUs() + 1);
  hot.values[5] = sdh2().saturationCounts;
  scripted.device->sink->onFrame(std::move(hot));
  scripted.run(1.0);
  const LinkHealth health = scripted.session->health();
  EXPECT_EQ(health.frames.frames, 1101u);
  EXPECT_NEAR(health.frames.rateHz, 100.0, 0.6);
  EXPECT_EQ(health.frames.saturatedFrames, 1u);
  EXPECT_NEAR(health.frames.saturatedFraction, 1.0 / 202.0, 1e-4);
  EXPECT_EQ(health.queues.tactile.depth, 0u);
  EXPECT_GE(health.queues.tactile.highWater, 1u);
  ASSERT_TRUE(health.diskHours);
  const double bytesPerS =
      static_cast<double>(health.recorder.bytesOnDisk) / health.recorder.recordedS;
  EXPECT_NEAR(*health.diskHours, 7.2e6 / bytesPerS / 3600.0, 1e-9);
  ASSERT_EQ(health.alarms.size(), 1u);
  EXPECT_EQ(health.alarms[0].kind, AlarmKind::kLowDisk);
  // The space is that of a recording: without one it is not known any more.
  scripted.session->stopRecording();
  scripted.run(0.1);
  EXPECT_FALSE(scripted.session->health().diskHours);
  EXPECT_TRUE(scripted.session->health().alarms.empty());
  // No more frames arrive.
  scripted.clock.pass(1'500'000);
  const LinkHealth silent = scripted.session->health();
  EXPECT_EQ(silent.alarms[0].kind, AlarmKind::kNoData);
  EXPECT_NEAR(*silent.frames.ageMs, 1500.0, 1e-6);
}

TEST(CaptureSession, theCheckBeforeARunLooksAtTheFolderToo) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  EXPECT_FALSE(scripted.session->checkPreflight(folder.path()).ready);
  scripted.run(3.0);
  const PreflightCheck good = scripted.session->checkPreflight(folder.path());
  EXPECT_TRUE(good.ready) << good.text;
  EXPECT_NE(good.text.find("up to 30 °C"), std::string::npos);
  EXPECT_FALSE(scripted.session->checkPreflight(folder / "none").ready);
  scripted.session->stop();
  EXPECT_FALSE(scripted.session->checkPreflight(folder.path()).ready);
}

TEST(CaptureSession, startedAgainItForgetsWhatWasBefore) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.run(3.0);
  scripted.session->mark("old");
  scripted.session->stop();
  EXPECT_FALSE(scripted.session->started());
  scripted.clock.pass(500'000);
  scripted.session->start();
  scripted.session->start();  // has no effect
  EXPECT_EQ(scripted.session->health().frames.frames, 0u);
  EXPECT_TRUE(scripted.session->takeEvents().empty());
  scripted.run(0.5);
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  // Contains nothing from before the stop, although it is within the two seconds.
  EXPECT_EQ(scripted.session->stopRecording().frames, 100);
}

TEST(CaptureSession, aStopEndsTheRecordingWhole) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  EXPECT_THROW(scripted.session->startRecording(to(folder / "b.palpate")), std::logic_error);
  scripted.run(0.5);
  scripted.session->stop();
  EXPECT_FALSE(scripted.session->recording());
  EXPECT_EQ(scripted.session->stopRecording().frames, 50);
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
}

TEST(CaptureSession, needsADevice) { EXPECT_THROW(CaptureSession(nullptr), std::invalid_argument); }

TEST(CaptureSession, RefusesABaselineOfNoTime) {
  for (const double seconds : {-1.0, 0.0, 61.0}) {
    CaptureOptions options;
    options.baselineS = seconds;
    EXPECT_THROW(ScriptedSession{options}, std::invalid_argument) << seconds;
  }
}

// Marks during a replay have the recording's time, not the present one.
TEST(CaptureSession, marksAreInTheTimeOfTheStamps) {
  ScriptedSession scripted;
  const std::int64_t longAgo = 1'400'000'000'000'000;
  scripted.device->frame(1, longAgo);
  scripted.session->mark("then");
  EXPECT_EQ(scripted.session->takeEvents().at(0).tUs, longAgo);
}

// the file of a process that is killed now also states the frames lost on the connection.
TEST(CaptureSession, whatTheLinkLostIsOnDiskWithTheFrameBehindIt) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  scripted.device->state.tactile.lost = 1;
  scripted.run(0.1);
  EXPECT_EQ(readTable(folder / "a.palpate", "SELECT name, value FROM counter").at("lost"), "1");
}

// a live hand with a clock that is set to 1969.
TEST(CaptureSession, aHandIsStampedBefore1970WhenTheClockStandsThere) {
  class WrongClock : public Clock {
   public:
    std::int64_t monotonicUs() const override { return systemClock().monotonicUs(); }
    // About three centuries before 1970, for any running time of the machine.
    std::int64_t wallUs() const override { return monotonicUs() - 10'000'000'000'000'000; }
  };
  const TemporaryFolder folder;
  const WrongClock clock;
  EmulatedHandOptions emulated;
  emulated.rate = EmulationRate::kFixed;
  emulated.hz = 100.0;
  const EmulatedHand hand(std::make_unique<NumberedHand>(), emulated);
  LiveHandOptions ports;
  ports.dsaPort = hand.dsaPort();
  CaptureSession session(std::make_unique<LiveHand>(ports, clock), {}, clock);
  RecordingOptions options = to(folder / "a.palpate");
  options.stopAfterFrames = 30;
  session.startRecording(options);
  session.start();
  while (session.recording()) std::this_thread::yield();
  session.stop();
  const RecordingReport report = session.stopRecording();
  EXPECT_EQ(report.frames, 30);
  EXPECT_GT(report.durationS, 0.1);
  EXPECT_LT(openRecording(folder / "a.palpate").frameTimeUs(0), 0);
}

}  // namespace
}  // namespace palpate::capture_session_test
