#include "palpate/interop/remote_fields.h"

#include "testing/testing.h"

namespace palpate::remote_fields_test {
namespace {

TEST(NoHand, FramesMustBeComing) {
  LinkHealth health;
  EXPECT_EQ(noHand(health)->error, "no_hand");  // no frame yet
  health.frames.ageMs = 999.0;
  EXPECT_FALSE(noHand(health));
  health.frames.ageMs = 2500.0;
  health.device.tactile.message = "unplugged; looking for its return";
  const auto gone = noHand(health);
  ASSERT_TRUE(gone);
  EXPECT_NE(gone->message.find("2.5 s"), std::string::npos);
  EXPECT_NE(gone->message.find("unplugged"), std::string::npos);
}

TEST(NoSpace, OnlyWhereItIsKnown) {
  EXPECT_FALSE(noSpace({}));
  EXPECT_FALSE(noSpace(1U << 30));
  EXPECT_EQ(noSpace(4096)->error, "no_space");
}

TEST(StartVerdict, IsDoneWithTheFirstCommitAndNotBefore) {
  RecorderStatus recorder;
  recorder.state = RecorderStatus::State::kWaiting;
  EXPECT_FALSE(startResult(recorder, true, 0.1));
  recorder.state = RecorderStatus::State::kRecording;
  recorder.frames = 3;
  EXPECT_FALSE(startResult(recorder, true, 0.1));
  recorder.path = "/r/a.palpate";
  recorder.framesOnDisk = 2;
  const auto done = startResult(recorder, true, 0.2);
  ASSERT_TRUE(done);
  EXPECT_TRUE(done->ok());
  EXPECT_EQ(done->fields.at("file").asString(), "/r/a.palpate");
  EXPECT_EQ(done->fields.at("frames_on_disk").asInteger(), 2);
}

TEST(StartVerdict, GivesUpAndSaysWhy) {
  RecorderStatus recorder;
  EXPECT_EQ(startResult(recorder, true, 10.0)->error, "no_frames");
  EXPECT_EQ(startResult(recorder, false, 0.1)->error, "disk");
  recorder.frames = 40;  // frames arrive, but the disk blocks
  EXPECT_FALSE(startResult(recorder, true, 9.9));
  EXPECT_EQ(startResult(recorder, true, 10.0)->error, "disk");
  recorder.writeError = "disk full";
  EXPECT_FALSE(startResult(recorder, true, 1.9));
  const auto full = startResult(recorder, true, 2.0);
  EXPECT_EQ(full->error, "disk");
  EXPECT_EQ(full->message, "disk full");
}

TEST(StopAnswer, CountsWhatIsInTheFile) {
  RecordingReport report;
  EXPECT_EQ(stopAnswer(report).error, "no_frames");
  report.paths = {"/r/a.palpate", "/r/a_002.palpate"};
  report.frames = 10;
  report.lost = 1;
  report.refused = 2;
  report.complete = false;
  report.message = "1 item lost";
  const RemoteAnswer answer = stopAnswer(report);
  EXPECT_TRUE(answer.ok());
  EXPECT_EQ(answer.message, "1 item lost");
  EXPECT_EQ(answer.fields.at("files").at(1).asString(), "/r/a_002.palpate");
  EXPECT_EQ(answer.fields.at("frames").asInteger(), 10);
  EXPECT_EQ(answer.fields.at("recorder_lost").asInteger(), 3);
  EXPECT_FALSE(answer.fields.at("complete").asBool());
  EXPECT_TRUE(answer.fields.at("rate_hz").isNull());  // not known
}

TEST(LinkFacts, AreWhatTheLinkSays) {
  LinkHealth health;
  health.frames.frames = 7;
  health.frames.rateHz = 31.5;
  health.lost = 2;
  health.alarms = {{AlarmKind::kLowDisk, "disk is nearly full"}};
  Json fields = Json::object();
  setLinkFields(fields, health);
  EXPECT_EQ(fields.at("frames_received").asInteger(), 7);
  EXPECT_EQ(fields.at("rate_hz").asDouble(), 31.5);
  EXPECT_TRUE(fields.at("age_ms").isNull());
  EXPECT_EQ(fields.at("lost").asInteger(), 2);
  EXPECT_EQ(fields.at("alarms").at(std::size_t{0}).asString(), "disk is nearly full");
}

}  // namespace
}  // namespace palpate::remote_fields_test
