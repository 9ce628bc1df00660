// F2 of the attack: files that are deleted, renamed or replaced while they are recorded. Each frame
// of the session is in the files that the report names, which are whole; what others put in their
// place stays.
#include <csignal>
#include <functional>
#include <map>

#include <sys/resource.h>

#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"

#include "capture/scripted_device.h"
#include "recording/faulty_vfs.h"
#include "testing/testing.h"

namespace palpate::recorder_gone_files_test {
namespace {
using namespace testing;
namespace fs = std::filesystem;

// A session whose recordings go into folder/here, in an emergency into folder/emergency.
struct GoneSession {
  TemporaryFolder folder;
  fs::path here = folder / "here";
  fs::path emergency = folder / "emergency";
  fs::path path = here / "a.palpate";
  std::map<fs::path, std::uint64_t> room;  // free bytes, of some folders
  std::map<fs::path, int> asks;            // how often it was asked for that
  std::string vfs;
  std::vector<std::string> told;  // alarms
  ScriptedSession scripted;

  explicit GoneSession(std::string files = {}) : vfs(std::move(files)), scripted(options()) {
    fs::create_directory(here);
    fs::create_directory(emergency);
  }
  CaptureOptions options() {
    CaptureOptions options;
    options.recorder.emergencyFolders = {emergency};
    options.recorder.freeBytes = [this](const fs::path& asked) {
      ++asks[asked];
      const auto found = room.find(asked);
      return found == room.end() ? std::uint64_t{1} << 40 : found->second;
    };
    options.recorder.vfs = vfs;
    options.recorder.notice = [this](const Event& event) {
      if (event.kind == "alarm") told.push_back(event.text);
    };
    return options;
  }
  void start(const std::function<void(RecordingOptions&)>& change = {}) {
    RecordingOptions options;
    options.path = path;
    if (change) change(options);
    scripted.session->startRecording(std::move(options));
  }
  RecordingReport stop() { return scripted.session->stopRecording(); }

  // What the report says is true, and nothing of the session is missing in its files.
  void expectAllIn(const RecordingReport& report, const std::vector<fs::path>& paths) const {
    EXPECT_EQ(report.paths, paths);
    EXPECT_EQ(report.lost, 0);
    EXPECT_FALSE(report.complete);
    EXPECT_NE(report.message.find("is gone"), std::string::npos) << report.message;
    EXPECT_EQ(report.frames, static_cast<std::int64_t>(scripted.frames));
    std::size_t next = 0;
    std::size_t angles = 0;
    for (const fs::path& file : report.paths) {
      ASSERT_TRUE(fs::exists(file)) << file;
      EXPECT_EQ(verifyRecording(file).state, VerifyReport::State::kSound) << file;
      const Profile profile = openRecording(file);
      for (std::size_t i = 0; i < profile.numFrames(); ++i)
        ASSERT_EQ(numberOf(profile.frame(i)), next++) << file;
      angles += profile.numAngles();
    }
    EXPECT_EQ(next, scripted.frames);
    EXPECT_EQ(angles, scripted.samples);
    ASSERT_FALSE(told.empty());
    std::size_t namesTold = 0;
    for (const std::string& text : told)
      for (const fs::path& file : paths)
        namesTold += text.find("is in " + file.string()) != std::string::npos ? 1 : 0;
    EXPECT_EQ(namesTold, 1u) << told.back();
  }
  // Only these names are there.
  static void expectNames(const fs::path& folder, std::vector<std::string> names) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder))
      found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    std::sort(names.begin(), names.end());
    EXPECT_EQ(found, names);
  }
};

bool alarms(const GoneSession& session) {
  for (const Alarm& alarm : session.scripted.session->health().alarms)
    if (alarm.kind == AlarmKind::kWriteError) return true;
  return false;
}

// Times before and after [s]: in the first commit, in the middle, just before the end.
constexpr std::array<std::pair<double, double>, 4> kMoments{
    {{0.02, 0.5}, {0.5, 0.5}, {0.5, 0.02}, {0.5, 0.0}}};

TEST(RecorderGoneFiles, oneThatIsDeletedIsThereAgainWithEverything) {
  for (const auto& [before, after] : kMoments) {
    SCOPED_TRACE(std::to_string(before) + " " + std::to_string(after));
    GoneSession session;
    session.start();
    session.scripted.run(before);
    ASSERT_TRUE(fs::remove(session.path));
    session.scripted.run(after);
    if (after > 0.1) {
      EXPECT_TRUE(alarms(session));
      EXPECT_TRUE(session.scripted.session->recorderStatus().writeError.empty());
      EXPECT_FALSE(session.scripted.session->recorderStatus().relocation.empty());
    }
    session.expectAllIn(session.stop(), {session.path});
    EXPECT_FALSE(alarms(session)) << "ends with the recording";
    std::size_t said = 0;
    for (const Event& event : readEvents(session.path).events)
      said += event.kind == "alarm" ? 1 : 0;
    EXPECT_EQ(said, 1u) << "in the recording, too";
    GoneSession::expectNames(session.here, {"a.palpate"});
  }
}

TEST(RecorderGoneFiles, oneThatIsDeletedWithItsJournalAndItsLockIsTheSame) {
  GoneSession session;
  session.start();
  session.scripted.run(0.5);
  fs::remove(session.path);
  fs::remove(session.here / "a.palpate-journal");
  fs::remove(session.here / "a.palpate.lock");
  session.scripted.run(0.5);
  session.expectAllIn(session.stop(), {session.path});
  GoneSession::expectNames(session.here, {"a.palpate"});
}

// What has been renamed stays as it was then.
TEST(RecorderGoneFiles, oneThatIsRenamedGoesOnUnderItsNameAndTheOtherCanBeRecovered) {
  for (const auto& [before, after] : kMoments) {
    SCOPED_TRACE(std::to_string(before) + " " + std::to_string(after));
    GoneSession session;
    session.start();
    session.scripted.run(before);
    const auto onDisk =
        static_cast<std::size_t>(session.scripted.session->recorderStatus().framesOnDisk);
    const fs::path mine = session.here / "mine.palpate";
    fs::rename(session.path, mine);
    session.scripted.run(after);
    session.expectAllIn(session.stop(), {session.path});
    GoneSession::expectNames(session.here, {"a.palpate", "mine.palpate"});
    const PalpateRecovery recovered = recoverPalpateProfile(mine);
    EXPECT_TRUE(recovered.unfinished);
    EXPECT_TRUE(recovered.whole());
    EXPECT_EQ(recovered.frames, onDisk);
  }
}

TEST(RecorderGoneFiles, whatIsPutInItsPlaceStaysAsItIs) {
  for (const auto& [before, after] : kMoments) {
    SCOPED_TRACE(std::to_string(before) + " " + std::to_string(after));
    GoneSession session;
    session.start();
    session.scripted.run(before);
    writeFile(session.here / "other", "somebody's");
    writeFile(session.here / "a_continued.palpate", "somebody's, too");
    fs::rename(session.here / "other", session.path);
    session.scripted.run(after);
    const fs::path kept = session.here / "a_continued2.palpate";
    session.expectAllIn(session.stop(), {kept});
    EXPECT_EQ(readFile(session.path), "somebody's");
    GoneSession::expectNames(session.here,
                             {"a.palpate", "a_continued.palpate", "a_continued2.palpate"});
  }
}

TEST(RecorderGoneFiles, aForeignJournalAndLinkInItsPlaceStay) {
  GoneSession session;
  session.start();
  session.scripted.run(0.5);
  fs::remove(session.path);
  fs::remove(session.here / "a.palpate-journal");
  fs::create_symlink(session.folder / "nowhere", session.path);
  writeFile(session.here / "a.palpate-journal", "somebody's");
  session.scripted.run(0.5);
  session.expectAllIn(session.stop(), {session.here / "a_continued.palpate"});
  EXPECT_FALSE(fs::exists(session.folder / "nowhere"));
  EXPECT_EQ(readFile(session.here / "a.palpate-journal"), "somebody's");
  GoneSession::expectNames(session.here, {"a.palpate", "a.palpate-journal", "a_continued.palpate"});
}

TEST(RecorderGoneFiles, withItsFolderItGoesOnInTheEmergencyFolder) {
  for (const bool isMoved : {true, false}) {
    for (const auto& [before, after] : kMoments) {
      SCOPED_TRACE(std::to_string(isMoved) + " " + std::to_string(before) + " " +
                   std::to_string(after));
      GoneSession session;
      session.start();
      session.scripted.run(before);
      const fs::path there = session.folder / "there";
      if (isMoved)
        fs::rename(session.here, there);
      else
        fs::remove_all(session.here);
      session.scripted.run(after);
      const auto status = session.scripted.session->recorderStatus();
      session.expectAllIn(session.stop(), {session.emergency / "a.palpate"});
      if (after > 0.1) {
        EXPECT_EQ(status.path, session.emergency / "a.palpate");
      }
      GoneSession::expectNames(session.emergency, {"a.palpate"});
      EXPECT_FALSE(fs::exists(session.here));
    }
  }
}

TEST(RecorderGoneFiles, aFolderThatGoesBeforeTheFirstFrameIsTheSame) {
  GoneSession session;
  session.start();
  fs::remove(session.here);
  session.scripted.run(0.5);
  session.scripted.session->recorderStatus();
  const RecordingReport report = session.stop();
  EXPECT_EQ(report.paths, std::vector{session.emergency / "a.palpate"});
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(openRecording(session.emergency / "a.palpate").numFrames(), session.scripted.frames);
}

// It waits in memory as on a full disk, and nothing is lost while somebody has the file.
TEST(RecorderGoneFiles, whereNothingTakesItItWaitsAndAnotherFolderGetsItWhole) {
  GoneSession session;
  const fs::path other = session.folder / "other";
  fs::create_directory(other);
  fs::remove(session.emergency);
  session.start();
  session.scripted.run(0.5);
  fs::remove_all(session.here);
  session.scripted.run(2.5);
  EXPECT_NE(session.scripted.session->recorderStatus().writeError.find("its folder was moved"),
            std::string::npos);
  EXPECT_TRUE(alarms(session));
  session.scripted.session->continueRecordingIn(other);
  session.scripted.run(0.5);
  EXPECT_TRUE(session.scripted.session->recorderStatus().writeError.empty());
  const RecordingReport report = session.stop();
  session.expectAllIn(report, {other / "a.palpate"});
}

TEST(RecorderGoneFiles, whereNothingEverTakesItNoNameIsTold) {
  GoneSession session;
  fs::remove(session.emergency);
  session.start();
  session.scripted.run(0.5);
  fs::remove_all(session.here);
  session.scripted.run(0.5);
  const RecordingReport report = session.stop();
  EXPECT_TRUE(report.paths.empty());
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(report.frames, 0) << "they exist nowhere";
  EXPECT_EQ(report.lost, static_cast<std::int64_t>(session.scripted.frames));
  EXPECT_EQ(report.bytes, 0);
  EXPECT_NE(report.message.find("could not be kept"), std::string::npos) << report.message;
}

TEST(RecorderGoneFiles, aLaterPartThatGoesIsKeptAndTheNextOnesFollow) {
  for (const bool isReplaced : {false, true}) {
    SCOPED_TRACE(isReplaced);
    GoneSession session;
    session.start([](RecordingOptions& options) { options.splitS = 1.0; });
    session.scripted.run(1.5);
    const fs::path second = session.here / "a_002.palpate";
    ASSERT_TRUE(fs::remove(second));
    if (isReplaced) writeFile(second, "somebody's");
    session.scripted.run(1.0);
    const RecordingReport report = session.stop();
    session.expectAllIn(report,
                        {session.path,
                         isReplaced ? session.here / "a_002_continued.palpate" : second,
                         session.here / "a_003.palpate"});
    if (isReplaced) {
      EXPECT_EQ(readFile(second), "somebody's");
    }
  }
}

TEST(RecorderGoneFiles, partsGoOnInTheEmergencyFolder) {
  GoneSession session;
  session.start([](RecordingOptions& options) { options.splitS = 1.0; });
  session.scripted.run(1.5);
  fs::rename(session.here, session.folder / "there");
  session.scripted.run(1.0);
  const RecordingReport report = session.stop();
  EXPECT_EQ(
      report.paths,
      (std::vector{session.emergency / "a_002.palpate", session.emergency / "a_003.palpate"}));
  EXPECT_FALSE(report.complete);
  EXPECT_NE(report.message.find("a.palpate was moved, deleted or replaced"), std::string::npos)
      << report.message;
  std::size_t frames = openRecording(session.folder / "there/a.palpate").numFrames();
  for (const fs::path& path : report.paths) frames += openRecording(path).numFrames();
  EXPECT_EQ(frames, session.scripted.frames);
}

TEST(RecorderGoneFiles, aFinishedPartThatGoesIsNotTold) {
  GoneSession session;
  session.start([](RecordingOptions& options) { options.splitS = 1.0; });
  session.scripted.run(1.5);
  fs::rename(session.path, session.here / "mine.palpate");
  session.scripted.run(0.2);
  const RecordingReport report = session.stop();
  EXPECT_EQ(report.paths, std::vector{session.here / "a_002.palpate"});
  EXPECT_FALSE(report.complete);
  EXPECT_NE(report.message.find("a.palpate was moved, deleted or replaced"), std::string::npos)
      << report.message;
}

TEST(RecorderGoneFiles, theMcapFileBesideItIsMissedAndTheRecordingGoesOn) {
  for (const double after : {2.0, 0.0}) {
    SCOPED_TRACE(after);
    GoneSession session;
    session.start([](RecordingOptions& options) { options.mcap.emplace(); });
    session.scripted.run(0.5);
    const fs::path mcap = session.here / "a.mcap";
    // Its thread makes it.
    while (!fs::exists(mcap)) std::this_thread::yield();
    fs::rename(mcap, session.here / "mine.mcap");
    session.scripted.run(after);
    const RecordingReport report = session.stop();
    EXPECT_TRUE(report.complete) << report.message;
    EXPECT_NE(report.mcapFailure.find("a.mcap: is gone"), std::string::npos) << report.mcapFailure;
    EXPECT_TRUE(report.mcapPaths.empty());
    EXPECT_EQ(openRecording(session.path).numFrames(), session.scripted.frames);
  }
}

TEST(RecorderGoneFiles, whatGoesTwiceIsThereAgainTwice) {
  for (const double after : {2.0, 0.0}) {
    SCOPED_TRACE(after);
    GoneSession session;
    session.start();
    session.scripted.run(0.5);
    ASSERT_TRUE(fs::remove(session.path));
    session.scripted.run(0.3);
    ASSERT_TRUE(fs::remove(session.path));
    session.scripted.run(after);
    const RecordingReport report = session.stop();
    EXPECT_EQ(report.paths, std::vector{session.path});
    EXPECT_EQ(report.lost, 0);
    EXPECT_EQ(openRecording(session.path).numFrames(), session.scripted.frames);
    EXPECT_EQ(verifyRecording(session.path).state, VerifyReport::State::kSound);
  }
}

// A program that moves each new file away doesn't make it copy all of it time and again.
TEST(RecorderGoneFiles, oneThatGoesTimeAndAgainRestsBetweenItsCopiesAndLeavesItsFolder) {
  GoneSession session;
  session.start();
  for (int i = 0; i < 150; ++i) {
    session.scripted.run(0.2);
    if (fs::exists(session.path))
      fs::rename(session.path, session.here / ("moved" + std::to_string(i)));
  }
  const RecordingReport report = session.stop();
  const auto copies =
      std::count_if(session.told.begin(), session.told.end(), [](const std::string& text) {
        return text.find("all that was recorded is in") != std::string::npos;
      });
  EXPECT_EQ(copies, 4) << "three into its own folder, after 0, 1 and 3 s, one to the other";
  EXPECT_EQ(report.paths, std::vector{session.emergency / "a.palpate"});
  EXPECT_EQ(report.lost, 0);
  EXPECT_EQ(openRecording(session.emergency / "a.palpate").numFrames(), session.scripted.frames);
}

TEST(RecorderGoneFiles, aCopyThatFailsIsMadeAgainAfterGrowingRestsAndOnceAtTheEnd) {
  GoneSession session;
  session.room[session.emergency] = 1'000'000;
  session.start();
  session.scripted.run(0.5);
  fs::remove_all(session.here);
  session.scripted.run(30.0);
  // After 0, 1, 3, 7 and 15 s.
  EXPECT_EQ(session.asks[session.emergency], 5);
  EXPECT_NE(session.scripted.session->recorderStatus().writeError.find("is gone"),
            std::string::npos);
  const RecordingReport report = session.stop();
  EXPECT_EQ(session.asks[session.emergency], 6);
  EXPECT_EQ(report.frames, 0);
  GoneSession::expectNames(session.emergency, {});
}

// As on a disk that gets full meanwhile.
TEST(RecorderGoneFiles, aCopyThatFailsHalfWayLeavesNothingAndIsMadeAgain) {
  GoneSession session;
  session.start();
  session.scripted.run(3.0);
  const std::uintmax_t size = fs::file_size(session.path);
  fs::remove_all(session.here);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit limit{size / 2, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  session.scripted.run(0.5);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_FALSE(session.scripted.session->recorderStatus().writeError.empty());
  GoneSession::expectNames(session.emergency, {});
  session.scripted.run(2.0);
  session.expectAllIn(session.stop(), {session.emergency / "a.palpate"});
  GoneSession::expectNames(session.emergency, {"a.palpate"});
}

// Only the recorder still has it: it isn't given up for a folder that can't take all of it.
TEST(RecorderGoneFiles, oneThatIsGoneStaysWhereTheChosenFolderHasNoRoomForAllOfIt) {
  GoneSession session;
  const fs::path other = session.folder / "other";
  fs::create_directory(other);
  fs::remove(session.emergency);
  session.start();
  session.scripted.run(0.5);
  fs::remove_all(session.here);
  session.scripted.run(0.5);
  session.room[other] = 1'000'000;
  session.scripted.session->continueRecordingIn(other);
  session.scripted.run(0.5);
  EXPECT_NE(session.scripted.session->recorderStatus().writeError.find(
                other.string() + ": no room there for the whole recording"),
            std::string::npos)
      << session.scripted.session->recorderStatus().writeError;
  GoneSession::expectNames(other, {});
  session.scripted.run(0.5);
  session.room.clear();
  session.scripted.session->continueRecordingIn(other);
  session.scripted.run(0.5);
  session.expectAllIn(session.stop(), {other / "a.palpate"});
}

// The part before the open one can't be finished, and then both are gone.
class TwoPartsGone {
 public:
  // `k`: which operation after the last moment before the split fails.
  explicit TwoPartsGone(std::int64_t k) : session(FaultyVfs::name()) {
    session.start([](RecordingOptions& options) { options.splitS = 1.0; });
    session.scripted.run(1.0);
    vfs.failAt(FaultyVfs::Fault::kErrorOnce, vfs.operations() + k);
    session.scripted.run(0.06);
    vfs.heal();
  }
  FaultyVfs vfs;
  GoneSession session;
};

TEST(RecorderGoneFiles, aPartThatWasNotFinishedGoesAlongWithTheOpenOne) {
  int both = 0;
  for (std::int64_t k = 1; k < 40; ++k) {
    SCOPED_TRACE(k);
    TwoPartsGone of(k);
    GoneSession& session = of.session;
    const fs::path other = session.folder / "other";
    fs::create_directory(other);
    fs::remove(session.emergency);
    fs::rename(session.here, session.folder / "there");
    session.scripted.run(0.02);
    session.room[other] = 1'000'000;
    session.scripted.session->continueRecordingIn(other);
    session.scripted.run(0.1);
    GoneSession::expectNames(other, {});
    session.room.clear();
    session.scripted.session->continueRecordingIn(other);
    session.scripted.run(0.3);
    const RecordingReport report = session.stop();
    EXPECT_EQ(report.lost, 0);
    std::size_t next = 0;
    if (report.paths.size() == 1)
      next = openRecording(session.folder / "there/a.palpate").numFrames();
    else
      ++both;
    for (const fs::path& file : report.paths) {
      EXPECT_EQ(file.parent_path(), other);
      const Profile profile = openRecording(file);
      for (std::size_t i = 0; i < profile.numFrames(); ++i)
        ASSERT_EQ(numberOf(profile.frame(i)), next++) << file;
    }
    EXPECT_EQ(next, session.scripted.frames);
  }
  EXPECT_GT(both, 3);
}

TEST(RecorderGoneFiles, aPartThatIsGoneIsNotToldUnderTheNameThatAnotherFileHasNow) {
  for (std::int64_t k = 1; k < 40; ++k) {
    SCOPED_TRACE(k);
    TwoPartsGone of(k);
    GoneSession& session = of.session;
    session.room = {{session.here, 0}, {session.emergency, 0}};
    for (const char* name : {"a.palpate", "a_002.palpate"}) {
      writeFile(session.here / "other", "somebody's");
      fs::rename(session.here / "other", session.here / name);
    }
    session.scripted.run(0.3);
    const RecordingReport report = session.stop();
    EXPECT_TRUE(report.paths.empty());
    EXPECT_FALSE(report.complete);
    for (const char* name : {"a.palpate", "a_002.palpate"})
      EXPECT_EQ(readFile(session.here / name), "somebody's");
  }
}

// cp other.palpate a.palpate: what was in it is lost, and nothing else.
TEST(RecorderGoneFiles, oneThatIsOverwrittenInPlaceGoesOnInANewPart) {
  const TemporaryFolder elsewhere;
  PalpateWriter other(elsewhere / "other.palpate", sdh2().layout);
  other.addFrame(numberedFrame(0, kWallStartUs));
  other.commit();
  for (const std::string& content :
       {std::string(), std::string(50'000, 'x'), readFile(elsewhere / "other.palpate")}) {
    for (const double after : {0.5, 0.0}) {
      SCOPED_TRACE(std::to_string(content.size()) + " " + std::to_string(after));
      GoneSession session;
      session.start();
      session.scripted.run(0.5);
      const auto onDisk =
          static_cast<std::size_t>(session.scripted.session->recorderStatus().framesOnDisk);
      writeFile(session.path, content);
      session.scripted.run(after);
      const RecordingReport report = session.stop();
      EXPECT_TRUE(readFile(session.path) == content) << "nothing was written into it";
      EXPECT_EQ(report.paths, std::vector{session.here / "a_002.palpate"});
      EXPECT_FALSE(report.complete);
      EXPECT_EQ(report.lost, static_cast<std::int64_t>(onDisk));
      EXPECT_NE(report.message.find("continues in " + (session.here / "a_002.palpate").string()),
                std::string::npos)
          << "the reason is told at the end, too: " << report.message;
      EXPECT_EQ(report.frames, static_cast<std::int64_t>(session.scripted.frames - onDisk));
      const Profile profile = openRecording(session.here / "a_002.palpate");
      ASSERT_EQ(profile.numFrames(), session.scripted.frames - onDisk);
      for (std::size_t i = 0; i < profile.numFrames(); ++i)
        ASSERT_EQ(numberOf(profile.frame(i)), onDisk + i);
      ASSERT_FALSE(session.told.empty());
      EXPECT_NE(session.told.front().find(std::to_string(onDisk) +
                                          " frames that were in it are lost, and it continues in " +
                                          (session.here / "a_002.palpate").string()),
                std::string::npos)
          << session.told.front();
      if (after == 0.0) continue;  // no event of that moment can be in the file any more
      std::size_t gaps = 0;
      for (const Event& event : readEvents(session.here / "a_002.palpate").events)
        gaps += event.kind == "gap" ? 1 : 0;
      EXPECT_EQ(gaps, 1u);
    }
  }
}

TEST(RecorderGoneFiles, theMcapFileBesideOneThatIsDeletedGoesOn) {
  GoneSession session;
  session.start([](RecordingOptions& options) { options.mcap.emplace(); });
  session.scripted.run(0.5);
  ASSERT_TRUE(fs::remove(session.path));
  session.scripted.run(0.5);
  const RecordingReport report = session.stop();
  session.expectAllIn(report, {session.path});
  EXPECT_EQ(report.mcapFailure, "");
  EXPECT_EQ(report.mcapPaths, std::vector<fs::path>{session.here / "a.mcap"});
  EXPECT_EQ(openRecording(session.here / "a.mcap").numFrames(), session.scripted.frames);
}

}  // namespace
}  // namespace palpate::recorder_gone_files_test
