// Tests of RemoteRecorder over a real socket on an emulated hand: acknowledged requests must have
// been executed.
#include "palpate/interop/remote_recorder.h"

#include <atomic>
#include <future>
#include <mutex>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/live_hand.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/interop/remote_client.h"
#include "palpate/interop/remote_server.h"
#include "palpate/recording/recording.h"

#include "emulator/numbered_hand.h"
#include "interop/raw_client.h"
#include "testing/testing.h"

namespace palpate::remote_recorder_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;
using namespace std::chrono_literals;

class RemoteRecorderTest : public ::testing::Test {
 protected:
  RemoteRecorderTest() {
    EmulatedHandOptions options;
    options.rate = EmulationRate::kFixed;
    options.hz = 100.0;
    hand_ = std::make_unique<EmulatedHand>(std::make_unique<NumberedHand>(), options);
    LiveHandOptions ports;
    ports.dsaPort = hand_->dsaPort();
    session_ = std::make_unique<CaptureSession>(std::make_unique<LiveHand>(std::move(ports)));
    fs::create_directory(recordings());
  }

  void begin(StartLimits limits = {}) {
    RemoteRecorderOptions options;
    options.folder = recordings();
    options.nameTemplate = "take_{run}";
    options.limits = limits;
    options.recording.preTriggerS = 0.0;
    options.onFinished = [this](const RecordingReport& report) {
      const std::lock_guard lock(mutex_);
      finished_.push_back(report);
    };
    recorder_ = std::make_unique<RemoteRecorder>(*session_, std::move(options));
    server_ = std::make_unique<RemoteServer>(folder_ / "s", *recorder_);
    client_ = std::make_unique<RemoteClient>(folder_ / "s");
  }
  void beginWithFrames() {
    session_->start();
    begin();
    ASSERT_TRUE(soon([&] { return session_->health().frames.ageMs.has_value(); }));
  }
  Json ask(const std::string& request) { return Json::parse(client_->ask(request, 20'000ms)); }
  std::string error(const std::string& request) { return ask(request).at("error").asString(); }
  fs::path recordings() const { return folder_ / "recordings"; }

  const TemporaryFolder folder_;
  std::unique_ptr<EmulatedHand> hand_;
  std::unique_ptr<CaptureSession> session_;
  std::mutex mutex_;
  std::vector<RecordingReport> finished_;
  std::unique_ptr<RemoteRecorder> recorder_;
  std::unique_ptr<RemoteServer> server_;
  std::unique_ptr<RemoteClient> client_;
};

TEST_F(RemoteRecorderTest, ARunFromStartToStop) {
  beginWithFrames();
  EXPECT_EQ(ask("status").at("state").asString(), "idle");
  ask("set object foam ball");
  const Json started = ask("start run 7");
  ASSERT_TRUE(started.at("ok").asBool()) << started.text();
  const fs::path path = recordings() / "run 7.palpate";
  EXPECT_EQ(started.at("file").asString(), path.string());
  // Frames reported as on disk can be read at once by another program.
  EXPECT_GE(openRecording(path).numFrames(),
            static_cast<std::size_t>(started.at("frames_on_disk").asInteger()));
  EXPECT_GE(started.at("frames_on_disk").asInteger(), 1);

  const Json label = ask("label contact");
  ASSERT_TRUE(label.at("ok").asBool()) << label.text();
  ASSERT_TRUE(ask("mark").at("ok").asBool());
  ASSERT_TRUE(soon([&] { return session_->recorderStatus().frames > 30; }));
  const Json status = ask("status");
  EXPECT_EQ(status.at("state").asString(), "recording");
  EXPECT_EQ(status.at("file").asString(), path.string());
  EXPECT_GT(status.at("frames").asInteger(), 30);
  EXPECT_GT(status.at("rate_hz").asDouble(), 0.0);
  EXPECT_EQ(error("start again"), "already_recording");

  const Json stopped = ask("stop");
  ASSERT_TRUE(stopped.at("ok").asBool()) << stopped.text();
  EXPECT_TRUE(stopped.at("complete").asBool());
  const Profile profile = openRecording(path);
  EXPECT_EQ(stopped.at("frames").asInteger(), static_cast<std::int64_t>(profile.numFrames()));
  EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  EXPECT_EQ(readRecordingMeta(path)["object"], "foam ball");
  std::vector<std::string> labels;
  for (const Event& event : readEvents(path).events)
    if (event.kind == "label" || event.kind == "mark") {
      labels.push_back(event.kind + " " + event.text);
      if (event.kind == "label") {
        EXPECT_EQ(event.tUs / 1000, label.at("time_ms").asInteger());
      }
    }
  EXPECT_EQ(labels, (std::vector<std::string>{"label contact", "mark "}));
  EXPECT_EQ(error("stop"), "not_recording");
  EXPECT_EQ(error("label late"), "not_recording");
  EXPECT_EQ(error("mark"), "not_recording");
  EXPECT_EQ(ask("status").at("state").asString(), "idle");
}

TEST_F(RemoteRecorderTest, NamesCountUpAndNeverReplace) {
  beginWithFrames();
  for (const char* expected : {"take_001.palpate", "take_002.palpate"}) {
    EXPECT_EQ(ask("status").at("next_file").asString(), expected);
    EXPECT_EQ(fs::path(ask("start").at("file").asString()).filename(), expected);
    ASSERT_TRUE(ask("stop").at("ok").asBool());
  }
  EXPECT_EQ(error("start take_001"), "file_exists");
  fs::create_symlink(folder_ / "elsewhere", recordings() / "link.palpate");
  EXPECT_EQ(error("start link"), "file_exists");  // a link that leads out of the folder, to nothing
  EXPECT_EQ(ask("file shake_{run}").at("next_file").asString(), "shake_001.palpate");
  EXPECT_EQ(ask("file").at("template").asString(), "shake_{run}");
  EXPECT_EQ(error("file ../x"), "file_name");
  EXPECT_EQ(error("start ../x"), "file_name");
  EXPECT_EQ(error("start /tmp/x"), "file_name");
  ASSERT_TRUE(ask("start").at("ok").asBool());
  ASSERT_TRUE(ask("stop").at("ok").asBool());
  EXPECT_TRUE(fs::exists(recordings() / "shake_001.palpate"));
  EXPECT_FALSE(fs::exists(folder_ / "x.palpate"));
  EXPECT_FALSE(fs::exists(folder_ / "elsewhere"));
  const std::lock_guard lock(mutex_);
  EXPECT_EQ(finished_.size(), 3u);
}

TEST_F(RemoteRecorderTest, WithoutAHandNothingIsAcknowledged) {
  hand_->mute(true);
  session_->start();
  begin();
  EXPECT_EQ(error("start a"), "no_hand");
  EXPECT_FALSE(session_->recording());
  EXPECT_TRUE(fs::is_empty(recordings()));
}

TEST_F(RemoteRecorderTest, AStartWithoutAFrameIsGivenUp) {
  session_->start();
  begin({.noHandS = 1e9, .firstFrameS = 0.2});
  ASSERT_TRUE(soon([&] { return session_->health().frames.ageMs.has_value(); }));
  hand_->mute(true);
  ASSERT_TRUE(soon([&] { return *session_->health().frames.ageMs > 300.0; }));
  EXPECT_EQ(error("start a"), "no_frames");
  EXPECT_FALSE(session_->recording());
  EXPECT_TRUE(fs::is_empty(recordings()));
}

TEST_F(RemoteRecorderTest, AStopEndsAStartThatWaits) {
  session_->start();
  begin({.noHandS = 1e9, .firstFrameS = 1e6});
  ASSERT_TRUE(soon([&] { return session_->health().frames.ageMs.has_value(); }));
  hand_->mute(true);
  ASSERT_TRUE(soon([&] { return *session_->health().frames.ageMs > 300.0; }));
  RawClient starter(folder_ / "s");
  starter.send("start a\n");
  ASSERT_TRUE(soon([&] { return ask("status").at("state").asString() == "starting"; }));
  EXPECT_EQ(error("start b"), "busy");
  EXPECT_EQ(error("label early"), "not_recording");
  EXPECT_EQ(error("stop"), "no_frames");  // there is no file
  EXPECT_EQ(Json::parse(starter.line().value()).at("error").asString(), "stopped");
  EXPECT_TRUE(fs::is_empty(recordings()));
}

TEST_F(RemoteRecorderTest, TheFolderMayGo) {
  beginWithFrames();
  fs::remove(recordings());
  EXPECT_EQ(error("start a"), "folder");
  EXPECT_TRUE(ask("status").at("next_file").isNull());
}

// One client hangs, one dies during its start, one sends noise: the recording has every frame.
TEST_F(RemoteRecorderTest, WhatClientsDoCostsNoFrame) {
  beginWithFrames();
  {
    RawClient starter(folder_ / "s");
    starter.send("start a\n");
    starter.close();  // does not wait for the answer
  }
  ASSERT_TRUE(soon([&] { return ask("status").at("state").asString() == "recording"; }));
  std::vector<std::unique_ptr<RawClient>> hanging;
  for (int i = 0; i < 8; ++i) {
    hanging.push_back(std::make_unique<RawClient>(folder_ / "s"));
    hanging.back()->send("status\nstatus\nsta");
  }
  const std::string flood(60'000, 'x');
  const auto frames = session_->recorderStatus().frames;
  ASSERT_TRUE(soon([&] {
    hanging.front()->send(flood);
    return session_->recorderStatus().frames > frames + 100;
  }));
  const Json stopped = ask("stop");
  EXPECT_TRUE(stopped.at("complete").asBool());
  EXPECT_EQ(stopped.at("recorder_lost").asInteger(), 0);
  const Profile profile = openRecording(recordings() / "a.palpate");
  std::optional<std::uint64_t> last;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const auto number = NumberedHand::numberOf(profile.frame(i).values);
    ASSERT_TRUE(number);
    ASSERT_EQ(*number, last.value_or(*number - 1) + 1) << "frame " << i;
    last = number;
  }
}

TEST_F(RemoteRecorderTest, WhenItEndsTheRecordingIsFinished) {
  beginWithFrames();
  ASSERT_TRUE(ask("start a").at("ok").asBool());
  server_.reset();
  recorder_.reset();
  EXPECT_FALSE(session_->recording());
  ASSERT_EQ(finished_.size(), 1u);
  EXPECT_TRUE(finished_.front().complete);
  EXPECT_EQ(verifyRecording(recordings() / "a.palpate").state, VerifyReport::State::kSound);
}

// C-A2: the callback may fail: recordings are made and finished nevertheless.
TEST_F(RemoteRecorderTest, LivesThroughWhatIsThrownOnItsThread) {
  session_->start();
  RemoteRecorderOptions options;
  options.folder = recordings();
  options.recording.preTriggerS = 0.0;
  options.onFinished = [](const RecordingReport&) { throw std::runtime_error("no ink"); };
  recorder_ = std::make_unique<RemoteRecorder>(*session_, std::move(options));
  server_ = std::make_unique<RemoteServer>(folder_ / "s", *recorder_);
  client_ = std::make_unique<RemoteClient>(folder_ / "s");
  ASSERT_TRUE(soon([&] { return session_->health().frames.ageMs.has_value(); }));
  for (const char* name : {"a", "b"}) {
    ASSERT_TRUE(ask(std::string("start ") + name).at("ok").asBool());
    ask("stop");  // may answer "failed: no ink"
    EXPECT_EQ(ask("status").at("state").asString(), "idle");
    EXPECT_EQ(verifyRecording(recordings() / (std::string(name) + ".palpate")).state,
              VerifyReport::State::kSound);
  }
}

TEST_F(RemoteRecorderTest, ARecordingThatEndedByItselfIsToldByTheNextStop) {
  session_->start();
  RemoteRecorderOptions options;
  options.folder = recordings();
  options.recording.preTriggerS = 0.0;
  options.recording.stopAfterFrames = 20;
  recorder_ = std::make_unique<RemoteRecorder>(*session_, std::move(options));
  server_ = std::make_unique<RemoteServer>(folder_ / "s", *recorder_);
  client_ = std::make_unique<RemoteClient>(folder_ / "s");
  ASSERT_TRUE(soon([&] { return session_->health().frames.ageMs.has_value(); }));
  ASSERT_TRUE(ask("start a").at("ok").asBool());
  ASSERT_TRUE(soon([&] { return ask("status").at("state").asString() == "idle"; }));
  EXPECT_EQ(error("label late"), "not_recording");
  EXPECT_EQ(ask("stop").at("frames").asInteger(), 20);
  EXPECT_EQ(error("stop"), "not_recording");
}

TEST_F(RemoteRecorderTest, AnAnswerIsGivenOnceAlsoWhereItsReceiverThrows) {
  beginWithFrames();
  std::atomic<int> started = 0, stopped = 0;
  const auto carryOut = [&](RemoteRequest::Verb verb, RemoteTarget::Done done) {
    RemoteRequest request;
    request.verb = verb;
    recorder_->carryOut(request, std::move(done));
  };
  carryOut(RemoteRequest::Verb::kStop, [&](const RemoteAnswer&) {
    ++stopped;
    throw std::runtime_error("nobody listens any more");
  });
  carryOut(RemoteRequest::Verb::kStart, [&](const RemoteAnswer&) {
    ++started;
    throw std::runtime_error("nobody listens any more");
  });
  ASSERT_TRUE(soon([&] { return started > 0; }));
  std::promise<RemoteAnswer> last;
  carryOut(RemoteRequest::Verb::kStop, [&](RemoteAnswer answer) { last.set_value(answer); });
  EXPECT_TRUE(last.get_future().get().ok());
  EXPECT_EQ(stopped, 1);
  EXPECT_EQ(started, 1);
}

TEST_F(RemoteRecorderTest, RefusesOptionsThatMakeNoSense) {
  RemoteRecorderOptions options;
  options.folder = recordings() / "no";
  EXPECT_THROW(RemoteRecorder(*session_, options), FileError);
  options.folder = recordings();
  options.nameTemplate = "../{run}";
  EXPECT_THROW(RemoteRecorder(*session_, options), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::remote_recorder_test
