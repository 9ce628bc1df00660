// Connecting, watching and recording against the emulated hand, on real ptys.
#include "gui/source/live_controller.h"

#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <latch>
#include <memory>

#include <palpate/capture/recording_name.h>
#include <palpate/recording/recording.h>

#include "control/emulated_bench.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::gui::live_controller_test {
namespace {
namespace fs = std::filesystem;
using State = LiveController::State;

class LiveControllerTest : public ::testing::Test {
 protected:
  LiveControllerTest() : live_(testing::dataFolder()) {
    live_.setFolder(folder_.path());
    QObject::connect(&live_,
                     &LiveController::recordingEnded,
                     [this](const RecordingReport& report) { reports_.push_back(report); });
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  static Connection emulated(const QString& scene) {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = scene;
    return connection;
  }
  // A hand that the test can do harm to.
  Connection state() {
    hand_ =
        std::make_unique<EmulatedHand>(testing::handWith("ball"),
                                       EmulatedHandOptions{.dsaPort = (folder_ / "dsa").string(),
                                                           .sdhPort = (folder_ / "sdh").string()});
    Connection connection;
    connection.kind = Connection::Kind::kPorts;
    connection.dsaPort = QString::fromStdString(hand_->dsaPort());
    connection.sdhPort = QString::fromStdString(hand_->sdhPort());
    return connection;
  }
  std::function<RecordingOptions()> recordTo(const std::string& name) {
    return [path = folder_ / name] {
      RecordingOptions options;
      options.path = path;
      return options;
    };
  }
  testing::TemporaryFolder folder_;
  std::unique_ptr<EmulatedHand> hand_;
  LiveController live_;
  std::vector<RecordingReport> reports_;
};

TEST_F(LiveControllerTest, ConnectsToTheEmulatedHandAndEnds) {
  const QSignalSpy sourceOpened(&live_, &LiveController::sourceOpened);
  const QSignalSpy frames(&live_, &LiveController::frameReceived);
  const QSignalSpy results(&live_, &LiveController::resultsReceived);
  const QSignalSpy leaving(&live_, &LiveController::leaving);
  live_.connectTo(emulated("ball"));
  EXPECT_EQ(live_.state(), State::kConnecting);
  ASSERT_TRUE(await([&] { return frames.size() > 5 && results.size() > 5; }));
  EXPECT_EQ(sourceOpened.size(), 1);
  EXPECT_EQ(live_.state(), State::kConnected);
  EXPECT_FALSE(live_.stale());
  ASSERT_TRUE(await([&] { return live_.preflight() && live_.preflight()->ready; }))
      << (live_.preflight() ? live_.preflight()->text : "not checked");
  EXPECT_EQ(live_.health().frames.frames > 0, true);
  live_.end();
  EXPECT_EQ(live_.source(), nullptr);
  EXPECT_EQ(leaving.size(), 1);
  ASSERT_TRUE(await([&] { return live_.state() == State::kNone; }));
}

TEST_F(LiveControllerTest, SaysWhatIsWrongWithAConnection) {
  QSignalSpy failed(&live_, &LiveController::failed);
  live_.connectTo(emulated("no_such_scene"));
  ASSERT_TRUE(await([&] { return !failed.isEmpty(); }));
  EXPECT_TRUE(failed[0][0].toString().contains("no_such_scene"));
  EXPECT_EQ(live_.state(), State::kNone);
  Connection replay;
  replay.kind = Connection::Kind::kReplay;
  replay.recording = QString::fromStdString((folder_ / "missing.dsa").string());
  live_.connectTo(replay);
  ASSERT_TRUE(await([&] { return failed.size() == 2; }));
  EXPECT_TRUE(failed[1][0].toString().contains("missing.dsa"));
}

TEST_F(LiveControllerTest, TheLastOneAskedForIsTheOneConnected) {
  const QSignalSpy sourceOpened(&live_, &LiveController::sourceOpened);
  live_.connectTo(emulated("ball"));
  live_.connectTo(emulated("pen"));
  live_.connectTo(emulated("bottle"));
  ASSERT_TRUE(await([&] { return live_.hasReceivedFrames(); }));
  EXPECT_EQ(sourceOpened.size(), 1);
  EXPECT_EQ(live_.source()->connection.scene, "bottle");
  live_.connectTo(emulated("box"));
  live_.end();
  ASSERT_TRUE(await([&] { return live_.state() == State::kNone; }));
  EXPECT_EQ(live_.source(), nullptr);
}

TEST_F(LiveControllerTest, APortWithoutAHandIsLookedForUntilItComes) {
  Connection nobody;
  nobody.kind = Connection::Kind::kPorts;
  nobody.dsaPort = QString::fromStdString((folder_ / "dsa").string());
  nobody.sdhPort = QString::fromStdString((folder_ / "sdh").string());
  live_.connectTo(nobody);
  ASSERT_TRUE(await([&] { return live_.state() == State::kConnected; }));
  ASSERT_TRUE(await([&] { return live_.preflight().has_value(); }));
  EXPECT_FALSE(live_.preflight()->ready);
  EXPECT_TRUE(live_.stale());
  state();
  ASSERT_TRUE(await([&] { return !live_.stale(); })) << "it has come";
}

TEST_F(LiveControllerTest, RecordsMarksAndFinishes) {
  live_.connectTo(emulated("ball"));
  ASSERT_TRUE(await([&] { return live_.hasReceivedFrames(); }));
  QSignalSpy started(&live_, &LiveController::recordingStarted);
  live_.startRecording(recordTo("run.palpate"));
  EXPECT_TRUE(live_.recording());
  ASSERT_TRUE(await([&] { return live_.health().recorder.framesOnDisk > 10; }));
  EXPECT_EQ(started.size(), 1);
  live_.mark({}, std::nullopt);
  live_.mark("slip", 2);
  const auto frames = live_.health().recorder.frames;
  ASSERT_TRUE(await([&] { return live_.health().recorder.frames > frames; }));
  live_.stopRecording();
  ASSERT_TRUE(await([&] { return reports_.size() == 1; }));
  EXPECT_FALSE(live_.recording());
  EXPECT_TRUE(reports_[0].complete) << reports_[0].message;
  const Profile profile = openRecording(folder_ / "run.palpate");
  EXPECT_EQ(static_cast<std::int64_t>(profile.numFrames()), reports_[0].frames);
  const auto events = readEvents(folder_ / "run.palpate").events;
  EXPECT_TRUE(std::any_of(
      events.begin(), events.end(), [](const auto& event) { return event.kind == "mark"; }));
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const auto& event) {
    return event.kind == "label" && event.text == "slip";
  }));
}

TEST_F(LiveControllerTest, ARecordingThatCannotBeginSaysWhy) {
  live_.connectTo(emulated("empty"));
  ASSERT_TRUE(await([&] { return live_.hasReceivedFrames(); }));
  testing::writeFile(folder_ / "taken.palpate", "somebody's");
  QSignalSpy failed(&live_, &LiveController::recordingFailed);
  live_.startRecording(recordTo("taken.palpate"));
  ASSERT_TRUE(await([&] { return !failed.isEmpty(); }));
  EXPECT_FALSE(live_.recording());
  EXPECT_EQ(testing::readFile(folder_ / "taken.palpate"), "somebody's");
}

TEST_F(LiveControllerTest, ARecordingThatEndsByItselfIsTold) {
  live_.connectTo(emulated("empty"));
  ASSERT_TRUE(await([&] { return live_.hasReceivedFrames(); }));
  live_.startRecording([path = folder_ / "short.palpate"] {
    RecordingOptions options;
    options.path = path;
    options.stopAfterFrames = 5;
    return options;
  });
  ASSERT_TRUE(await([&] { return reports_.size() == 1; }));
  EXPECT_FALSE(live_.recording());
  EXPECT_TRUE(fs::exists(folder_ / "short.palpate"));
}

TEST_F(LiveControllerTest, EndingFinishesTheRecording) {
  live_.connectTo(emulated("empty"));
  ASSERT_TRUE(await([&] { return live_.hasReceivedFrames(); }));
  live_.startRecording(recordTo("run.palpate"));
  ASSERT_TRUE(await([&] { return live_.health().recorder.framesOnDisk > 3; }));
  live_.end();
  ASSERT_TRUE(await([&] { return live_.state() == State::kNone; }));
  ASSERT_EQ(reports_.size(), 1u);
  EXPECT_TRUE(reports_[0].complete);
  EXPECT_EQ(verifyRecording(folder_ / "run.palpate").state, VerifyReport::State::kSound);
}

TEST_F(LiveControllerTest, GoneWithoutAWordItFinishesToo) {
  {
    LiveController other(testing::dataFolder());
    other.connectTo(emulated("empty"));
    ASSERT_TRUE(await([&] { return other.hasReceivedFrames(); }));
    other.startRecording(recordTo("run.palpate"));
    ASSERT_TRUE(await([&] { return other.health().recorder.framesOnDisk > 3; }));
  }
  EXPECT_EQ(verifyRecording(folder_ / "run.palpate").state, VerifyReport::State::kSound);
}

// The folder in which nothing more is written isn't checked meanwhile.
TEST_F(LiveControllerTest, ARecordingThatGoesOnElsewhereIsCheckedThere) {
  live_.setFolder("/proc");
  live_.connectTo(emulated("empty"));
  const auto toldOfProc = [&] {
    return live_.preflight() && live_.preflight()->text.find("/proc ") != std::string::npos;
  };
  ASSERT_TRUE(await(toldOfProc));
  live_.startRecording(recordTo("run.palpate"));
  ASSERT_TRUE(await([&] { return live_.health().recorder.framesOnDisk > 3; }));
  const auto other = folder_ / "other";
  std::filesystem::create_directory(other);
  live_.continueRecordingIn(other);
  EXPECT_TRUE(await([&] { return !toldOfProc(); }));
}

// Window F7.
TEST_F(LiveControllerTest, AFolderThatDoesNotAnswerHoldsUpNoOtherAndNoEnd) {
  const auto end = std::make_shared<std::latch>(1);
  const auto asked = std::make_shared<std::atomic<int>>(0);
  {
    LiveController live(testing::dataFolder());
    live.lookAtFolder = [end, asked](const fs::path& folder) {
      if (folder == "/proc") {
        ++*asked;
        end->wait();
      }
      return folderStateOf(folder);
    };
    live.setFolder("/proc");
    live.connectTo(emulated("empty"));
    ASSERT_TRUE(await([&] { return *asked == 1; }));
    live.setFolder(folder_.path());
    ASSERT_TRUE(await([&] { return live.preflight().has_value(); }));
    live.setFolder("/proc");
    ASSERT_TRUE(await([&] { return *asked == 2; }));
  }
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1))) << "it still hangs";
  end->count_down();
  EXPECT_TRUE(Abandonable::awaitThreads(std::chrono::seconds(20)));
}

TEST_F(LiveControllerTest, SilenceMakesThePictureOldUntilFramesComeAgain) {
  live_.connectTo(state());
  ASSERT_TRUE(await([&] { return !live_.stale(); }));
  hand_->mute(true);
  ASSERT_TRUE(await([&] { return live_.stale(); }));
  EXPECT_GE(live_.silentS(), 0.4);
  hand_->mute(false);
  ASSERT_TRUE(await([&] { return !live_.stale(); }));
}

TEST_F(LiveControllerTest, ARecordingIsReplayedWithItsEvents) {
  live_.connectTo(emulated("empty"));
  ASSERT_TRUE(await([&] { return live_.hasReceivedFrames(); }));
  live_.startRecording(recordTo("run.palpate"));
  ASSERT_TRUE(await([&] { return live_.health().recorder.frames > 20; }));
  live_.stopRecording();
  ASSERT_TRUE(await([&] { return reports_.size() == 1; }));
  Connection replay;
  replay.kind = Connection::Kind::kReplay;
  replay.recording = QString::fromStdString((folder_ / "run.palpate").string());
  live_.connectTo(replay);
  ASSERT_TRUE(await([&] { return live_.source() && live_.hasReceivedFrames(); }));
  EXPECT_EQ(live_.source()->control, nullptr) << "nobody moves a recording";
}

// V9: in the first half second nothing shown was said to be old.
TEST_F(LiveControllerTest, APulledCableIsKnownAtOnceAndSoIsItsReturn) {
  live_.connectTo(state());
  ASSERT_TRUE(await([&] {
    return !live_.stale() && !live_.motionGone() && live_.preflight() && live_.preflight()->ready;
  }));
  double silentS = -1.0;
  QString said;
  QObject::connect(&live_, &LiveController::staleChanged, [&](bool stale) {
    if (stale && silentS < 0.0) silentS = live_.silentS();
  });
  QObject::connect(&live_, &LiveController::refreshed, [&] {
    if (live_.stale() && said.isEmpty())
      said = QString::fromStdString(live_.health().device.tactile.message);
  });
  hand_->unplug();
  ASSERT_TRUE(await([&] { return silentS >= 0.0; }));
  EXPECT_LT(silentS, testing::timeLimit(0.001 * LiveController::kStaleMs))
      << "not only after the usual time";
  EXPECT_NE(said, "") << "why is said in the same moment";
  // The check before a run doesn't wait for its turn: it was made at the last change of a port.
  ASSERT_TRUE(await([&] { return live_.motionGone(); }));
  ASSERT_TRUE(await([&] { return !live_.preflight()->ready; }));
  hand_->replug();
  ASSERT_TRUE(await([&] { return !live_.stale() && !live_.motionGone(); }));
}

}  // namespace
}  // namespace palpate::gui::live_controller_test
