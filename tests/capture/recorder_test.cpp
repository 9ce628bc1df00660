#include "palpate/capture/recorder.h"

#include <sys/statvfs.h>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_details.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace palpate::recorder_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;

TEST(Recorder, writesFirstWhatCameInTheTwoSecondsBeforeTheStart) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.run(5.0);
  const std::int64_t startUs = scripted.clock.hostUs();
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(1.0);
  const RecordingReport report = scripted.session->stopRecording();
  const Profile profile = openRecording(folder / "a.palpate");
  // A frame every 10 ms, from exactly 2 s before the start.
  EXPECT_EQ(profile.numFrames(), 301u);
  EXPECT_EQ(profile.frameTimeUs(0), startUs - 2'000'000);
  EXPECT_EQ(profile.frameTimeUs(300), startUs + 1'000'000);
  EXPECT_EQ(profile.numAngles(), 601u);
  EXPECT_EQ(profile.angleTimeUs(0), startUs - 2'000'000);
  EXPECT_EQ(profile.numTemperatures(), 4u);
  EXPECT_EQ(report.frames, 301);
}

TEST(Recorder, thePreTriggerIsAnOption) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.run(3.0);
  RecordingOptions options = to(folder / "a.palpate");
  options.preTriggerS = 0.0;
  scripted.session->startRecording(options);
  scripted.run(1.0);
  // A frame exactly at the start belongs to the recording.
  EXPECT_EQ(scripted.session->stopRecording().frames, 101);
}

TEST(Recorder, neverReplacesAnything) {
  const TemporaryFolder folder;
  writeFile(folder / "a.palpate", "precious");
  ScriptedSession scripted;
  EXPECT_THROW(scripted.session->startRecording(to(folder / "a.palpate")), FileError);
  EXPECT_THROW(scripted.session->startRecording(to(folder / "a.dsa")), std::invalid_argument);
  EXPECT_THROW(scripted.session->startRecording(to(folder / "no/a.palpate")), FileError);
  EXPECT_FALSE(scripted.session->recording());
  // A file with the name is created between the start and the first frame: the next part's name is
  // used.
  scripted.session->startRecording(to(folder / "b.palpate"));
  writeFile(folder / "b.palpate", "precious, too");
  scripted.run(0.5);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.paths, std::vector{folder / "b_002.palpate"});
  EXPECT_EQ(readFile(folder / "b.palpate"), "precious, too");
  EXPECT_EQ(numbersIn(report.paths[0]).size(), 50u);
}

TEST(Recorder, splitsByTimeWithoutLosingOrDoublingAnItem) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  RecordingOptions options = to(folder / "a.palpate");
  options.splitS = 1.0;
  scripted.session->startRecording(options);
  scripted.run(3.5);
  const RecordingReport report = scripted.session->stopRecording();
  ASSERT_EQ(report.paths.size(), 4u);
  EXPECT_EQ(report.paths[1], folder / "a_002.palpate");
  EXPECT_EQ(report.paths[3], folder / "a_004.palpate");
  std::vector<std::size_t> all;
  std::size_t angles = 0;
  for (const fs::path& path : report.paths) {
    for (const std::size_t number : numbersIn(path)) all.push_back(number);
    const Profile profile = openRecording(path);
    for (std::size_t i = 0; i < profile.numAngles(); ++i)
      ASSERT_EQ(profile.angles(i).values, numberedAngles(angles++, 0).values);
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  }
  EXPECT_EQ(all, upTo(0, 350));
  EXPECT_EQ(angles, 700u);
  EXPECT_EQ(openRecording(report.paths[0]).numFrames(), 100u);
  EXPECT_TRUE(report.complete) << report.message;
}

TEST(Recorder, anMcapFileBesideEachPartHoldsTheSame) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  RecordingOptions options = to(folder / "a.palpate");
  options.splitS = 1.0;
  options.mcap.emplace();
  scripted.session->startRecording(options);
  scripted.run(1.5);
  scripted.session->mark("here");
  scripted.run(0.5);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.mcapPaths, (std::vector{folder / "a.mcap", folder / "a_002.mcap"}));
  EXPECT_EQ(report.mcapFailure, "");
  for (std::size_t part = 0; part < 2; ++part) {
    EXPECT_EQ(numbersIn(report.mcapPaths[part]), numbersIn(report.paths[part]));
    const Profile mcap = openRecording(report.mcapPaths[part]);
    const Profile native = openRecording(report.paths[part]);
    EXPECT_EQ(mcap.numAngles(), native.numAngles());
    EXPECT_EQ(mcap.numTemperatures(), native.numTemperatures());
    EXPECT_EQ(mcap.hand().name, native.hand().name);
    EXPECT_EQ(readEvents(report.mcapPaths[part]).events, readEvents(report.paths[part]).events);
  }
}

TEST(Recorder, anMcapFileThatCanNotBeWrittenStopsAndTheRecordingGoesOn) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  RecordingOptions options = to(folder / "a.palpate");
  options.mcap.emplace();
  writeFile(folder / "a.mcap", "precious");
  EXPECT_THROW(scripted.session->startRecording(options), FileError);
  fs::remove(folder / "a.mcap");
  // More than can wait.
  options.mcapQueueItems = 1;
  scripted.session->startRecording(options);
  scripted.run(3.0);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_NE(report.mcapFailure.find("could not keep up"), std::string::npos) << report.mcapFailure;
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(numbersIn(folder / "a.palpate"), upTo(0, 300));
  std::size_t alarms = 0;
  for (const Event& event : readEvents(folder / "a.palpate").events)
    alarms += event.kind == "alarm" && event.text.find("MCAP") != std::string::npos ? 1u : 0u;
  EXPECT_EQ(alarms, 1u);
}

TEST(Recorder, splitsBySize) {
  const TemporaryFolder folder;
  CaptureOptions capture;
  capture.recorder.commitIntervalMs = 400.0;
  ScriptedSession scripted(capture);
  RecordingOptions options = to(folder / "a.palpate");
  options.splitBytes = 128 << 10;
  scripted.session->startRecording(options);
  scripted.run(20.0);
  const RecordingReport report = scripted.session->stopRecording();
  ASSERT_GE(report.paths.size(), 2u);
  std::vector<std::size_t> all;
  for (const fs::path& path : report.paths)
    for (const std::size_t number : numbersIn(path)) all.push_back(number);
  EXPECT_EQ(all, upTo(0, 2000));
  EXPECT_LT(fs::file_size(report.paths[0]), 192u << 10);
  EXPECT_GT(fs::file_size(report.paths[0]), 96u << 10);
}

TEST(Recorder, stopsByItselfAfterTimeFramesOrBytes) {
  const TemporaryFolder folder;
  CaptureOptions capture;
  capture.recorder.commitIntervalMs = 400.0;
  ScriptedSession scripted(capture);
  scripted.run(1.0);  // the pre-trigger data are added
  RecordingOptions options = to(folder / "s.palpate");
  options.stopAfterS = 1.5;
  scripted.session->startRecording(options);
  scripted.run(3.0);
  EXPECT_FALSE(scripted.session->recording());
  // The frame at the time of the start counts as the first one: 150 frames from there, 99 before.
  EXPECT_EQ(scripted.session->stopRecording().frames, 249);
  const Profile profile = openRecording(folder / "s.palpate");
  EXPECT_EQ(profile.numAngles(), 499u);  // none after the end

  options = to(folder / "n.palpate");
  options.preTriggerS = 0.0;
  options.stopAfterFrames = 17;
  scripted.session->startRecording(options);
  scripted.run(3.0);
  EXPECT_FALSE(scripted.session->recording());
  EXPECT_EQ(scripted.session->stopRecording().frames, 17);

  options = to(folder / "b.palpate");
  options.stopAfterBytes = 100'000;
  scripted.session->startRecording(options);
  scripted.run(20.0);
  EXPECT_FALSE(scripted.session->recording());
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_GE(report.bytes, 100'000);
  EXPECT_LT(report.bytes, 200'000);
}

TEST(Recorder, endsInTimeEvenWhenFramesCease) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  RecordingOptions options = to(folder / "a.palpate");
  options.stopAfterS = 2.0;
  scripted.session->startRecording(options);
  scripted.run(1.0);
  for (int i = 0; i < 500 && scripted.session->recording(); ++i) {
    scripted.clock.pass(10'000);
    scripted.session->step();
  }
  EXPECT_FALSE(scripted.session->recording());
  EXPECT_EQ(scripted.session->stopRecording().frames, 100);
}

TEST(Recorder, withoutAFrameThereIsNoFile) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  for (int i = 0; i < 300; ++i) {
    scripted.clock.pass(10'000);
    scripted.device->angles(static_cast<std::size_t>(i), scripted.clock.hostUs());
    scripted.session->step();
  }
  const LinkHealth health = scripted.session->health();
  ASSERT_EQ(health.alarms.size(), 1u);
  EXPECT_EQ(health.alarms[0].kind, AlarmKind::kEmptyRecording);
  EXPECT_EQ(health.recorder.state, RecorderStatus::State::kWaiting);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_TRUE(report.paths.empty());
  EXPECT_FALSE(report.complete);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Recorder, commitsWhatCameWithin150MillisecondsThoughNothingFollows) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(1.0);
  scripted.device->frame(777, scripted.clock.hostUs() + 1);
  for (int i = 0; i < 7; ++i) {
    scripted.clock.pass(20'000);
    scripted.session->step();
  }
  EXPECT_EQ(scripted.session->recorderStatus().framesOnDisk, 101);
  // as another process sees it, unfinished
  EXPECT_EQ(numbersIn(folder / "a.palpate").back(), 777u);
}

// A commit costs processor time and wears the disk: none comes before the promise needs it.
TEST(Recorder, commits80MillisecondsAfterTheOldestItemMayHaveCome) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  RecordingOptions options = to(folder / "a.palpate");
  options.preTriggerS = 0.0;
  scripted.session->startRecording(options);
  scripted.device->frame(0, scripted.clock.hostUs());
  scripted.session->step();  // the file is made with its first frame
  EXPECT_EQ(scripted.session->recorderStatus().framesOnDisk, 1);
  scripted.clock.pass(1'000);
  scripted.device->frame(1, scripted.clock.hostUs());
  scripted.clock.pass(19'000);
  for (int ms = 20; ms < 80; ms += 20) {
    scripted.session->step();
    EXPECT_EQ(scripted.session->recorderStatus().framesOnDisk, 1) << ms;
    scripted.clock.pass(20'000);
  }
  scripted.session->step();
  EXPECT_EQ(scripted.session->recorderStatus().framesOnDisk, 2);
}

TEST(Recorder, aJumpOfTheWallClockIsAnEventAndStampsGoOn) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(1.0);
  scripted.clock.jumpWall(-3'600'000'000);
  scripted.run(1.0);
  scripted.clock.jumpWall(40'000);  // a small correction, no jump
  scripted.run(0.5);
  scripted.session->stopRecording();
  const Profile profile = openRecording(folder / "a.palpate");
  for (std::size_t i = 1; i < profile.numFrames(); ++i)
    ASSERT_EQ(profile.frameTimeUs(i) - profile.frameTimeUs(i - 1), 10'000);
  const auto events = readEvents(folder / "a.palpate").events;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "clock");
  EXPECT_NE(events[0].text.find("-3600.000 s"), std::string::npos);
  EXPECT_NEAR(static_cast<double>(events[0].tUs - kWallStartUs), 1e6, 25'000);
}

TEST(Recorder, whatCanNotBeRecordedIsRefusedAndCounted) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  scripted.device->frame(1, kWallStartUs);  // earlier than the last one
  Sample bad = numberedAngles(1, scripted.clock.hostUs() + 1);
  bad.values[3] = std::numeric_limits<double>::quiet_NaN();
  scripted.device->sink->onSample(std::move(bad));
  scripted.run(0.5);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.frames, 100);
  EXPECT_EQ(report.refused, 2);
  EXPECT_FALSE(report.complete);
}

TEST(Recorder, namesOfParts) {
  EXPECT_EQ(partPath("/d/a.palpate", 1), "/d/a.palpate");
  EXPECT_EQ(partPath("/d/a.palpate", 2), "/d/a_002.palpate");
  EXPECT_EQ(partPath("a.b.palpate", 1234), "a.b_1234.palpate");
}

TEST(Recorder, optionsOutOfRangeAreNamed) {
  const auto refused = [](auto change, const std::string& name) {
    RecordingOptions options = to("a.palpate");
    change(options);
    try {
      options.validate();
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  refused([](auto& o) { o.path = "a.dsa"; }, ".palpate");
  refused([](auto& o) { o.path = ".palpate"; }, ".palpate");
  refused([](auto& o) { o.splitS = 0.5; }, "splitS");
  refused([](auto& o) { o.splitBytes = 1; }, "splitBytes");
  refused([](auto& o) { o.stopAfterS = -1.0; }, "stopAfterS");
  refused([](auto& o) { o.stopAfterFrames = 0; }, "stopAfterFrames");
  refused([](auto& o) { o.stopAfterBytes = 0; }, "stopAfterBytes");
  refused([](auto& o) { o.preTriggerS = 61.0; }, "preTriggerS");
  refused([](auto& o) { o.meta["finished"] = "1"; }, "finished");
  RecorderOptions recorder;
  recorder.commitIntervalMs = 0.0;
  EXPECT_THROW(Recorder{recorder}, std::invalid_argument);
}

TEST(Recorder, rateAndGapsOfTheReportAreThoseOfTheFile) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(1.0);
  scripted.clock.pass(2'500'000);
  scripted.run(1.0);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_DOUBLE_EQ(report.rateHz, 100.0);
  EXPECT_EQ(report.gaps, 1);
  EXPECT_DOUBLE_EQ(report.gapsS, timingOf(openRecording(folder / "a.palpate")).gaps.at(0).seconds);
  EXPECT_DOUBLE_EQ(report.durationS, 4.49);
  EXPECT_DOUBLE_EQ(report.meanRateHz, 199.0 / 4.49);
}

// C-A11: only the recorder's own gaps are reported as its own.
TEST(Recorder, onlyItsOwnGapsAreToldAsItsOwn) {
  std::vector<Event> told;
  CaptureOptions options;
  options.recorder.notice = [&told](const Event& event) { told.push_back(event); };
  ScriptedSession scripted(options);
  const std::int64_t atUs = scripted.clock.hostUs();
  scripted.device->sink->onEvent(
      {atUs, atUs, "gap", {}, "of the device", R"({"reason":"the recorder could not keep up"})"});
  scripted.session->step();
  EXPECT_TRUE(told.empty());
}

// C-A11: only the recorder empties its queues, so it must not wait for room in them.
TEST(Recorder, aClockThatJumpsWhileTheEventsWaitIsTold) {
  std::vector<Event> told;
  CaptureOptions options;
  options.recorder.queue.blockWhenFull = true;
  options.recorder.queue.eventItems = 2;
  options.recorder.notice = [&told](const Event& event) { told.push_back(event); };
  const TemporaryFolder folder;
  ScriptedSession scripted(options);
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.1);
  scripted.session->mark("one");
  scripted.session->mark("two");
  scripted.clock.jumpWall(5'000'000);
  scripted.session->step();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, "clock");
  EXPECT_TRUE(scripted.session->stopRecording().complete);
  std::size_t recorded = 0;
  for (const Event& event : readEvents(folder / "a.palpate").events)
    recorded += event.kind == "clock" ? 1 : 0;
  EXPECT_EQ(recorded, 1u);
}

// R-10: a wrong clock may be set to a time before 1970.
TEST(Recorder, aRecordingBegunBefore1970HasItsDuration) {
  const TemporaryFolder folder;
  for (const std::int64_t beginUs : {std::int64_t{-3'000'000}, std::int64_t{-500'000}}) {
    ScriptedSession scripted;
    scripted.clock.jumpWall(beginUs - kWallStartUs);
    scripted.session->stop();
    scripted.session->start();
    const fs::path path = folder / (std::to_string(beginUs) + ".palpate");
    scripted.session->startRecording(to(path));
    for (std::size_t n = 0; n < 91; ++n) {
      scripted.clock.pass(10'000);
      scripted.device->frame(n, beginUs + static_cast<std::int64_t>(n) * 10'000);
      scripted.session->step();
    }
    const RecordingReport report = scripted.session->stopRecording();
    EXPECT_EQ(report.frames, 91);
    EXPECT_NEAR(report.durationS, 0.9, 1e-9);
    EXPECT_EQ(openRecording(path).durationUs(), 900'000);
    const RecordingDetails details = readDetails(path);
    EXPECT_EQ(details.startUs, beginUs);
    EXPECT_EQ(details.durationUs, 900'000);
  }
}

TEST(Recorder, tellsTheFreeSpaceOfARunningRecordingOnly) {
  const TemporaryFolder folder;
  CaptureOptions options;
  options.recorder.freeBytes = [](const fs::path&) { return std::uint64_t{1'000'000}; };
  ScriptedSession scripted(std::move(options));
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(2.0);
  const LinkHealth recording = scripted.session->health();
  EXPECT_EQ(recording.freeBytes, 1'000'000u);
  EXPECT_TRUE(std::any_of(recording.alarms.begin(), recording.alarms.end(), [](const Alarm& alarm) {
    return alarm.kind == AlarmKind::kLowDisk;
  }));
  scripted.session->stopRecording();
  scripted.run(1.0);
  const LinkHealth ended = scripted.session->health();
  EXPECT_FALSE(ended.freeBytes);
  EXPECT_TRUE(ended.alarms.empty());
}

TEST(Recorder, freeSpaceIsThatOfTheFileSystem) {
  const TemporaryFolder folder;
  struct statvfs facts {};
  ASSERT_EQ(statvfs(folder.path().c_str(), &facts), 0);
  const auto free = freeBytesOf(folder.path());
  ASSERT_TRUE(free);
  EXPECT_NEAR(static_cast<double>(*free),
              static_cast<double>(facts.f_bavail) * static_cast<double>(facts.f_frsize),
              1e9);
  // For a folder that does not exist yet, the existing one above it counts.
  EXPECT_TRUE(freeBytesOf(folder / "not/made/yet"));
}

}  // namespace
}  // namespace palpate::recorder_test
