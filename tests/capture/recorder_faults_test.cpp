// Tests of the recorder with a disk that is full, fails or blocks (R3, R10), and with queues that
// overflow.
#include <condition_variable>
#include <thread>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "recording/faulty_vfs.h"
#include "testing/testing.h"

namespace palpate::recorder_faults_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;
using Fault = FaultyVfs::Fault;

CaptureOptions onFaultyDisk() {
  CaptureOptions options;
  options.recorder.vfs = FaultyVfs::name();
  options.recorder.freeBytes = [](const fs::path&) { return std::uint64_t{1} << 40; };
  return options;
}

bool hasAlarm(const CaptureSession& session, AlarmKind kind) {
  for (const Alarm& alarm : session.health().alarms)
    if (alarm.kind == kind) return true;
  return false;
}

// The recording contains the first frames, each once; between `least` and `most` of them.
void expectFrames(const fs::path& path, std::size_t least, std::size_t most) {
  const Profile profile = openRecording(path);
  ASSERT_GE(profile.numFrames(), least);
  ASSERT_LE(profile.numFrames(), most);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) ASSERT_EQ(numberOf(profile.frame(i)), i);
  EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
}

// Number of file operations in a recording of one second.
std::int64_t operationsOfASecond() {
  const TemporaryFolder folder;
  FaultyVfs vfs;
  ScriptedSession scripted(onFaultyDisk());
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(1.0);
  EXPECT_TRUE(scripted.session->stopRecording().complete);
  return vfs.operations();
}

// R3: the disk fails at the n-th operation and all later ones, for half a second.
TEST(RecorderFaults, aDiskThatFailsAtAnyOperationAndRecoversCostsNothing) {
  const std::int64_t operations = operationsOfASecond();
  ASSERT_GT(operations, 50);
  for (const Fault fault : {Fault::kFull, Fault::kError}) {
    for (std::int64_t n = 1; n < operations; n += 3) {
      SCOPED_TRACE("operation " + std::to_string(n));
      const TemporaryFolder folder;
      FaultyVfs vfs;
      ScriptedSession scripted(onFaultyDisk());
      vfs.failAt(fault, n);
      scripted.session->startRecording(to(folder / "a.palpate"));
      bool alarm = false;
      for (int i = 0; i < 20 && !vfs.struck(); ++i) scripted.run(0.05);
      for (int i = 0; i < 10 && vfs.struck(); ++i) {
        scripted.run(0.05);
        alarm |= hasAlarm(*scripted.session, AlarmKind::kWriteError);
      }
      EXPECT_EQ(alarm, vfs.struck()) << "said within half a second";
      vfs.heal();
      scripted.run(0.5);
      EXPECT_FALSE(hasAlarm(*scripted.session, AlarmKind::kWriteError));
      const RecordingReport report = scripted.session->stopRecording();
      EXPECT_TRUE(report.complete) << report.message;
      ASSERT_EQ(report.paths.size(), 1u);
      expectFrames(report.paths[0], scripted.frames, scripted.frames);
      EXPECT_EQ(openRecording(report.paths[0]).numAngles(), scripted.samples);
      std::size_t told = 0;
      for (const Event& event : readEvents(report.paths[0]).events)
        told += event.kind == "alarm" ? 1 : 0;
      EXPECT_EQ(told, vfs.struck() ? 1u : 0u) << "in the recording, too";
    }
  }
}

TEST(RecorderFaults, aDiskThatStaysFullLeavesTheFileValidAndCaptureGoesOn) {
  const std::int64_t operations = operationsOfASecond();
  for (std::int64_t n = 10; n < operations; n += 12) {
    SCOPED_TRACE("operation " + std::to_string(n));
    const TemporaryFolder folder;
    FaultyVfs vfs;
    ScriptedSession scripted(onFaultyDisk());
    vfs.failAt(Fault::kFull, n);
    scripted.session->startRecording(to(folder / "a.palpate"));
    scripted.run(2.0);
    const auto onDisk = static_cast<std::size_t>(scripted.session->recorderStatus().framesOnDisk);
    const RecordingReport report = scripted.session->stopRecording();
    EXPECT_FALSE(report.complete);
    EXPECT_FALSE(report.message.empty());
    // The session continues: frames arrive, and the next recording is independent of this one.
    scripted.run(0.2);
    EXPECT_TRUE(scripted.session->takeFrame());
    // The data of a commit whose last step failed may nevertheless be in the file.
    if (!report.paths.empty())
      expectFrames(report.paths[0], onDisk, static_cast<std::size_t>(report.frames));
    vfs.heal();
    scripted.session->startRecording(to(folder / "b.palpate"));
    scripted.run(0.5);
    EXPECT_TRUE(scripted.session->stopRecording().complete);
  }
}

// Each frame of the session is in exactly one of the two files, in order.
TEST(RecorderFaults, aRecordingGoesOnInAnotherFolderWithAllThatWaits) {
  const TemporaryFolder folder;
  const fs::path other = folder / "other";
  fs::create_directory(other);
  FaultyVfs vfs;
  ScriptedSession scripted(onFaultyDisk());
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  vfs.failAt(Fault::kFull, vfs.operations() + 1);
  scripted.run(0.5);
  EXPECT_FALSE(scripted.session->recorderStatus().writeError.empty());
  EXPECT_THROW(scripted.session->continueRecordingIn(folder / "none"), FileError);
  vfs.heal();
  scripted.session->continueRecordingIn(other);
  scripted.run(0.5);
  EXPECT_TRUE(scripted.session->recorderStatus().writeError.empty());
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.lost, 0);
  ASSERT_EQ(report.paths.size(), 2u);
  EXPECT_EQ(report.paths[1], other / "a.palpate");
  EXPECT_EQ(report.frames, static_cast<std::int64_t>(scripted.frames));
  EXPECT_NE(report.message.find("a.palpate"), std::string::npos);
  std::size_t next = 0;
  for (const fs::path& path : report.paths) {
    const Profile profile = openRecording(path);
    for (std::size_t i = 0; i < profile.numFrames(); ++i)
      ASSERT_EQ(numberOf(profile.frame(i)), next++) << path;
  }
  EXPECT_EQ(next, scripted.frames);
  EXPECT_EQ(verifyRecording(report.paths[1]).state, VerifyReport::State::kSound);
}

// Another recording of the same name is there: the rest isn't to be taken for its second part.
TEST(RecorderFaults, whatGoesOnInAnotherFolderIsNoPartOfARecordingThatIsThere) {
  const TemporaryFolder folder;
  const fs::path other = folder / "other";
  fs::create_directory(other);
  writeFile(other / "a.palpate", "another one");
  FaultyVfs vfs;
  ScriptedSession scripted(onFaultyDisk());
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  scripted.session->continueRecordingIn(other);
  scripted.run(0.5);
  const RecordingReport report = scripted.session->stopRecording();
  ASSERT_EQ(report.paths.size(), 2u);
  EXPECT_EQ(report.paths[1], other / "a_continued.palpate");
  EXPECT_NE(report.message.find("a.palpate could not be finished in " + folder.path().string()),
            std::string::npos)
      << report.message;
}

// The end by a limit is no reason to lose what waits: it is the same as for one that is stopped.
TEST(RecorderFaults, aRecordingThatEndsByItselfOnAFailingDiskWaitsForAnotherFolder) {
  const TemporaryFolder folder;
  const fs::path other = folder / "other";
  fs::create_directory(other);
  FaultyVfs vfs;
  ScriptedSession scripted(onFaultyDisk());
  RecordingOptions options = to(folder / "a.palpate");
  options.stopAfterFrames = 30;
  options.waitForDisk = true;
  scripted.session->startRecording(options);
  scripted.run(0.3);
  EXPECT_FALSE(scripted.session->recorderStatus().waitsForDisk);
  vfs.failAt(Fault::kFull, vfs.operations() + 1);
  scripted.run(30.0);
  ASSERT_TRUE(scripted.session->recording()) << "half a minute after its end";
  EXPECT_TRUE(scripted.session->recorderStatus().waitsForDisk);
  EXPECT_LT(scripted.session->recorderStatus().framesOnDisk, 30);
  vfs.heal();
  scripted.session->continueRecordingIn(other);
  scripted.run(0.2);
  EXPECT_FALSE(scripted.session->recording());
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.lost, 0);
  EXPECT_EQ(report.frames, 30);
  ASSERT_FALSE(report.paths.empty());
  EXPECT_EQ(report.paths.back(), other / "a.palpate");
  std::size_t next = 0;
  for (const fs::path& path : report.paths) {
    const Profile profile = openRecording(path);
    for (std::size_t i = 0; i < profile.numFrames(); ++i)
      ASSERT_EQ(numberOf(profile.frame(i)), next++) << path;
  }
  EXPECT_EQ(next, 30u);
}

// Also when the very first write fails: nothing is on the disk yet.
TEST(RecorderFaults, oneThatCouldNeverBeBegunWaitsAndIsWrittenWhenTheDiskWorks) {
  const TemporaryFolder folder;
  FaultyVfs vfs;
  ScriptedSession scripted(onFaultyDisk());
  RecordingOptions options = to(folder / "a.palpate");
  options.stopAfterFrames = 30;
  options.waitForDisk = true;
  vfs.failAt(Fault::kFull, 1);
  scripted.session->startRecording(options);
  scripted.run(10.0);
  ASSERT_TRUE(scripted.session->recording());
  vfs.heal();
  scripted.run(0.2);
  EXPECT_FALSE(scripted.session->recording());
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.lost, 0);
  ASSERT_FALSE(report.paths.empty());
  EXPECT_EQ(openRecording(report.paths.back()).numFrames(), 30u);
}

TEST(RecorderFaults, oneThatWaitsIsEndedByAStopAndOneThatDoesntEndsItself) {
  for (const bool waits : {true, false}) {
    const TemporaryFolder folder;
    FaultyVfs vfs;
    ScriptedSession scripted(onFaultyDisk());
    RecordingOptions options = to(folder / "a.palpate");
    options.stopAfterFrames = 30;
    options.waitForDisk = waits;
    scripted.session->startRecording(options);
    scripted.run(0.3);
    vfs.failAt(Fault::kFull, vfs.operations() + 1);
    scripted.run(10.0);
    EXPECT_EQ(scripted.session->recording(), waits);
    const RecordingReport report = scripted.session->stopRecording();
    EXPECT_FALSE(report.complete);
    EXPECT_FALSE(scripted.session->recording());
    vfs.heal();
  }
}

TEST(RecorderFaults, aFolderThatWasMovedAwayIsCalledGone) {
  const TemporaryFolder folder;
  const fs::path here = folder / "here", other = folder / "other";
  fs::create_directory(here);
  fs::create_directory(other);
  CaptureOptions options;
  options.recorder.emergencyFolders = {folder / "none"};
  ScriptedSession scripted(options);
  scripted.session->startRecording(to(here / "a.palpate"));
  scripted.run(0.5);
  fs::rename(here, folder / "there");
  scripted.run(0.5);
  const std::string error = scripted.session->recorderStatus().writeError;
  EXPECT_NE(error.find("is gone: its folder was moved, renamed or deleted"), std::string::npos)
      << error;
  scripted.session->continueRecordingIn(other);
  scripted.run(0.2);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.lost, 0);
  EXPECT_EQ(report.paths, std::vector<fs::path>{other / "a.palpate"})
      << "the other one is where it was moved to";
  EXPECT_EQ(openRecording(other / "a.palpate").numFrames(), scripted.frames) << "all of it";
  EXPECT_GT(openRecording(folder / "there/a.palpate").numFrames(), 0u);
}

TEST(RecorderFaults, whatTheMemoryCanNotHoldIsAnExactGap) {
  const TemporaryFolder folder;
  FaultyVfs vfs;
  ScriptedSession scripted(onFaultyDisk());
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5);
  vfs.failAt(Fault::kFull, vfs.operations() + 1);
  // Large events fill the 64 MB that may wait.
  const std::string longText(200'000, 'x');
  for (int i = 0; i < 400; ++i) {
    scripted.session->mark(longText);
    scripted.run(0.02);
  }
  const RecorderStatus status = scripted.session->recorderStatus();
  EXPECT_GT(status.lost, 0);
  vfs.heal();
  const std::size_t before = scripted.frames;
  scripted.run(0.5);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_FALSE(report.complete);
  const Profile profile = openRecording(folder / "a.palpate");
  std::int64_t lost = 0;
  std::int64_t lostFrames = 0;
  for (const Event& event : readEvents(folder / "a.palpate").events) {
    if (event.kind != "gap") continue;
    const Json json = Json::parse(event.json);
    lost += json.at("lost").asInteger();
    if (json.at("stream").asString() != "tactile") continue;
    lostFrames += json.at("lost").asInteger();
    // Frames arrive every 10 ms: the span covers exactly the lost ones, and none of them is in the
    // recording.
    EXPECT_EQ(event.t1Us - event.tUs, (json.at("lost").asInteger() - 1) * 10'000);
    const std::size_t at = *profile.frameAt(event.tUs);
    EXPECT_EQ(profile.frameTimeUs(at), event.tUs - 10'000);
    EXPECT_EQ(profile.frameTimeUs(at + 1), event.t1Us + 10'000);
  }
  EXPECT_EQ(lost, report.lost);
  EXPECT_GT(lostFrames, 0);
  EXPECT_EQ(static_cast<std::int64_t>(profile.numFrames()) + lostFrames,
            static_cast<std::int64_t>(scripted.frames));
  EXPECT_GT(scripted.frames, before);
}

// R10, on the test's clock: the recorder does not run for this time, at 30 frames/s and 110
// angles/s.
TEST(RecorderFaults, aRecorderThatIsBlockedUpTo30SecondsLosesNothing) {
  for (const double blockedS : {0.1, 1.0, 5.0, 30.0, 60.0}) {
    SCOPED_TRACE(blockedS);
    const TemporaryFolder folder;
    ScriptedSession scripted;
    scripted.session->startRecording(to(folder / "a.palpate"));
    scripted.run(0.2);
    std::size_t frames = scripted.frames;
    std::size_t samples = scripted.samples;
    const std::int64_t endUs =
        scripted.clock.monotonicUs() + static_cast<std::int64_t>(blockedS * 1e6);
    for (std::int64_t i = 1; scripted.clock.monotonicUs() < endUs; ++i) {
      scripted.clock.pass(9'000);
      scripted.device->angles(samples++, scripted.clock.hostUs());
      if (i * 9 / 33 != (i - 1) * 9 / 33) scripted.device->frame(frames++, scripted.clock.hostUs());
    }
    scripted.frames = frames;
    scripted.samples = samples;
    scripted.run(0.2);
    const RecordingReport report = scripted.session->stopRecording();
    EXPECT_TRUE(report.complete) << report.message;
    expectFrames(folder / "a.palpate", scripted.frames, scripted.frames);
    EXPECT_EQ(openRecording(folder / "a.palpate").numAngles(), scripted.samples);
  }
}

// 300 frames/s: 27 s fit into the queue; later frames are lost, counted and reported to the
// microsecond.
TEST(RecorderFaults, blockedTooLongLeavesOneExactGapAndAnAlarm) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.2);
  const std::size_t before = scripted.frames;
  const std::size_t capacity = scripted.session->health().queues.tactile.capacity;
  EXPECT_GE(capacity, 27u * 300u);
  const std::int64_t startUs = scripted.clock.hostUs();
  for (std::size_t i = 1; i <= 30 * 300; ++i) {
    scripted.clock.pass(3'333);
    scripted.device->frame(before + i - 1, scripted.clock.hostUs());
  }
  const std::size_t lost = 30 * 300 - capacity;
  scripted.frames = before + 30 * 300;
  scripted.session->step();
  scripted.run(0.2);
  EXPECT_TRUE(hasAlarm(*scripted.session, AlarmKind::kOverflow));
  EXPECT_EQ(scripted.session->health().queues.tactile.highWater, capacity);
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.lost, static_cast<std::int64_t>(lost));
  EXPECT_FALSE(report.complete);
  const auto events = readEvents(folder / "a.palpate").events;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "gap");
  EXPECT_EQ(events[0].tUs, startUs + 3'333 * static_cast<std::int64_t>(capacity + 1));
  EXPECT_EQ(events[0].t1Us, startUs + 3'333 * 30 * 300);
  EXPECT_EQ(Json::parse(events[0].json).at("lost").asInteger(), static_cast<std::int64_t>(lost));
  const Profile profile = openRecording(folder / "a.palpate");
  EXPECT_EQ(profile.numFrames(), scripted.frames - lost);
}

TEST(RecorderFaults, aGapThatIsStillOpenAtTheStopIsToldToo) {
  const TemporaryFolder folder;
  CaptureOptions options;
  options.recorder.queue.tactileItems = 10;
  ScriptedSession scripted(options);
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.5, false);  // 50 frames, the recorder does not run
  const RecordingReport report = scripted.session->stopRecording();
  EXPECT_EQ(report.lost, 40);
  const auto events = readEvents(folder / "a.palpate").events;
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].tUs, kWallStartUs + 110'000);
  EXPECT_EQ(events[0].t1Us, kWallStartUs + 500'000);
}

// The recorder's own thread is blocked in a write of a real file: the device's thread never waits,
// and an alarm is raised.
TEST(RecorderFaults, aDiskThatBlocksAWriteIsAnAlarmAndCostsNothing) {
  const TemporaryFolder folder;
  FaultyVfs vfs;
  std::mutex mutex;
  std::condition_variable moved;
  bool block = false;
  bool blocked = false;
  vfs.setHook([&] {
    std::unique_lock lock(mutex);
    blocked = block;
    moved.notify_all();
    moved.wait(lock, [&] { return !block; });
  });
  HandClock clock;
  auto owned = std::make_unique<ScriptedDevice>();
  ScriptedDevice& device = *owned;
  CaptureSession session(std::move(owned), onFaultyDisk(), clock);
  session.start();
  session.startRecording(to(folder / "a.palpate"));
  std::size_t frames = 0;
  const auto deliver = [&](std::int64_t periodUs) {
    clock.pass(periodUs);
    device.frame(frames++, clock.hostUs());
  };
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  // Advances the time until the condition holds.
  const auto await = [&](const auto& isSo) {
    while (!isSo() && std::chrono::steady_clock::now() < deadline) {
      clock.pass(1'000);
      std::this_thread::yield();
    }
  };
  for (int i = 0; i < 10; ++i) deliver(33'000);
  await([&] { return session.recorderStatus().framesOnDisk == 10; });
  {
    const std::lock_guard lock(mutex);
    block = true;
  }
  deliver(33'000);
  await([&] {
    const std::lock_guard lock(mutex);
    return blocked;
  });
  for (int i = 0; i < 900; ++i) deliver(33'000);  // 30 s
  EXPECT_GT(session.recorderStatus().blockedS, 29.0);
  EXPECT_TRUE(hasAlarm(session, AlarmKind::kSlowDisk));
  {
    const std::lock_guard lock(mutex);
    block = false;
    moved.notify_all();
  }
  const RecordingReport report = session.stopRecording();
  session.stop();
  EXPECT_TRUE(report.complete) << report.message;
  expectFrames(folder / "a.palpate", frames, frames);
}

// Items that arrived during a slow commit are as old as that commit: they don't wait for another
// interval.
TEST(RecorderFaults, afterASlowCommitTheNextOneFollowsAtOnce) {
  const TemporaryFolder folder;
  ScriptedSession scripted;
  scripted.session->startRecording(to(folder / "a.palpate"));
  scripted.run(0.2);
  for (std::size_t i = 0; i < 10; ++i) {  // 0.1 s in which the recorder does not run
    scripted.clock.pass(10'000);
    scripted.device->frame(scripted.frames++, scripted.clock.hostUs());
  }
  scripted.session->step();
  EXPECT_EQ(scripted.session->recorderStatus().framesOnDisk, 30);
}

// C-A12: a part that can't be opened leaves neither a file nor a name in the list.
TEST(RecorderFaults, aPartThatCanNotBeBegunLeavesNothing) {
  const TemporaryFolder folder;
  FaultyVfs vfs;
  CaptureOptions options = onFaultyDisk();
  options.recorder.queue.eventItems = 4096;
  ScriptedSession scripted(options);
  RecordingOptions recording = to(folder / "a.palpate");
  recording.splitS = 20.0;
  scripted.session->startRecording(recording);
  scripted.run(0.5);
  // Large events fill the 64 MB that may wait, and one is lost.
  const std::string longText(200'000, 'x');
  const auto fill = [&](int events) {
    for (int i = 0; i < events; ++i) scripted.session->mark(longText);
  };
  vfs.failAt(Fault::kFull, vfs.operations() + 1);
  for (int i = 0; i < 400; ++i) {
    fill(1);
    scripted.run(0.02);
  }
  ASSERT_GT(scripted.session->recorderStatus().lost, 0);
  vfs.heal();
  scripted.run(0.15, true);
  // In one round there is room, so that the gap must be written; then there is none; then a new
  // part is due.
  vfs.failAt(Fault::kFull, vfs.operations() + 1);
  fill(400);
  scripted.session->step();
  for (int i = 0; i < 20; ++i) {
    fill(400);
    scripted.clock.pass(1'000'000);
    scripted.device->frame(scripted.frames++, scripted.clock.hostUs());
    scripted.session->step();
  }
  vfs.heal();
  scripted.run(0.5);
  const RecordingReport report = scripted.session->stopRecording();
  for (const fs::path& path : report.paths)
    EXPECT_GT(openRecording(path).numFrames(), 0u) << path.filename();
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    files += entry.path().extension() == ".palpate" ? 1 : 0;
  EXPECT_EQ(files, report.paths.size());
}

}  // namespace
}  // namespace palpate::recorder_faults_test
