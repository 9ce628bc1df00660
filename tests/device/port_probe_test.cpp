#include "palpate/device/port_probe.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "device/fake_sdh_hand.h"
#include "device/fake_tactile_answers.h"
#include "device/pty_server.h"
#include "device/scripted_channel.h"
#include "testing/time_limit.h"

namespace palpate::port_probe_test {
namespace {

using testing::Bytes;
using testing::bytesOf;
using testing::FakeSdhHand;
using testing::FakeTactileAnswers;
using testing::ManualClock;
using testing::PtyPair;
using testing::PtyServer;
using testing::ScriptedChannel;

class PortProbeTest : public ::testing::Test {
 protected:
  ManualClock clock;
  Bytes sent;
  ScriptedChannel::Answer answer;
  std::function<void(ScriptedChannel&)> before;  // puts bytes on the line before the probe

  PortProbe probe() {
    PortProbeOptions options;
    options.open = [&](const std::string&) {
      auto line = std::make_unique<ScriptedChannel>(
          clock, [this](const Bytes& request, ScriptedChannel& channel) {
            sent.insert(sent.end(), request.begin(), request.end());
            if (answer) answer(request, channel);
          });
      if (before) before(*line);
      return line;
    };
    return probePort("some port", options, clock);
  }
  double seconds() const { return static_cast<double>(clock.nowUs) * 1e-6; }
};

// C-A2: a probe runs on a thread of its own while a hand may be moving.
TEST_F(PortProbeTest, WhatIsThrownIsAnAnswerToo) {
  answer = [](const Bytes&, ScriptedChannel&) { throw std::runtime_error("a bug in the driver"); };
  PortProbe found;
  ASSERT_NO_THROW(found = probe());
  EXPECT_EQ(found.port, "some port");
  EXPECT_NE(found.message.find("a bug in the driver"), std::string::npos) << found.message;
}

TEST_F(PortProbeTest, RecognisesAMotionControllerAndSendsItNoTactileByte) {
  FakeSdhHand hand;
  answer = [&](const Bytes& request, ScriptedChannel& line) {
    const Bytes reply = hand.receive(request);
    if (!reply.empty()) line.arrive(reply, 3000);
  };
  const PortProbe found = probe();
  EXPECT_EQ(found.answer, PortAnswer::kMotion);
  EXPECT_EQ(found.answerName(), "motion");
  EXPECT_EQ(found.firmware, "0.0.3.3");
  EXPECT_EQ(found.serial, "48");
  EXPECT_EQ(found.port, "some port");
  EXPECT_NE(found.message.find("motion controller"), std::string::npos);
  for (const std::byte b : sent) EXPECT_LT(std::to_integer<int>(b), 0x80);
  EXPECT_LT(seconds(), testing::timeLimit(0.1));
}

TEST_F(PortProbeTest, EndsACommandThatSomebodyLeftHalfWay) {
  FakeSdhHand hand;
  hand.receive(bytesOf("70 6F"));  // "po": the first line is then "po " + end, which is refused
  answer = [&](const Bytes& request, ScriptedChannel& line) {
    const Bytes reply = hand.receive(request);
    if (!reply.empty()) line.arrive(reply, 3000);
  };
  EXPECT_EQ(probe().answer, PortAnswer::kMotion);
}

TEST_F(PortProbeTest, RecognisesATactileControllerThatIsIdle) {
  FakeTactileAnswers controller;
  answer = [&](const Bytes& request, ScriptedChannel& line) {
    const Bytes reply = controller.receive(request);
    if (!reply.empty()) line.arrive(reply, 3000);
  };
  const PortProbe found = probe();
  EXPECT_EQ(found.answer, PortAnswer::kTactile);
  EXPECT_EQ(found.answerName(), "tactile");
  EXPECT_EQ(found.serial, "1D9B0057");
  EXPECT_EQ(found.firmware, "2.9.0.0");
  EXPECT_LT(seconds(), testing::timeLimit(2.5));
}

TEST_F(PortProbeTest, ATactileStreamLeftRunningIsEndedFirst) {
  FakeTactileAnswers controller;
  controller.streaming = true;
  before = [](ScriptedChannel& line) {
    // the probe begins in the middle of the first frame
    const Bytes frame = FakeTactileAnswers::frame();
    line.arrive(Bytes(frame.begin() + 40, frame.end()), 1000);
    for (int i = 1; i < 5; ++i) line.arrive(frame, i * 31'500);
  };
  answer = [&](const Bytes& request, ScriptedChannel& line) {
    const Bytes reply = controller.receive(request);
    if (!reply.empty()) line.arrive(reply, 3000);
  };
  const PortProbe found = probe();
  EXPECT_EQ(found.serial, "1D9B0057");
  EXPECT_EQ(controller.stops, 1);
  EXPECT_FALSE(controller.streaming);
  EXPECT_LT(seconds(), testing::timeLimit(0.5)) << "frames say at once who it is";
}

TEST_F(PortProbeTest, ATactileControllerThatStartsIsNamed) {
  before = [](ScriptedChannel& line) { line.arrive(bytesOf("1B 5B 35 6E"), 600'000); };
  const PortProbe found = probe();
  EXPECT_EQ(found.answer, PortAnswer::kTactile);
  EXPECT_NE(found.message.find("starting"), std::string::npos);
}

TEST_F(PortProbeTest, AnswersWithoutAConfigurationAreStillATactileControllers) {
  FakeTactileAnswers controller;
  controller.answersQuery = false;
  answer = [&](const Bytes& request, ScriptedChannel& line) {
    const Bytes reply = controller.receive(request);
    if (!reply.empty()) line.arrive(reply, 3000);
  };
  EXPECT_EQ(probe().answer, PortAnswer::kTactile);
}

TEST_F(PortProbeTest, SilenceIsNothingWithinTheLimit) {
  const PortProbe found = probe();
  EXPECT_EQ(found.answer, PortAnswer::kNothing);
  EXPECT_LE(seconds(), testing::timeLimit(2.5));
  // The exact bytes: `ver` twice, then stop and query of the protocol document.
  const Bytes ver = bytesOf("20 0D 0A 76 65 72 0D 0A");
  const Bytes stop = bytesOf("AA AA AA 03 03 00 01 00 00 2F 6A");
  const Bytes query = bytesOf("AA AA AA 01 00 00");
  Bytes expected;
  for (const Bytes& part : {ver, ver, stop, query, query})
    expected.insert(expected.end(), part.begin(), part.end());
  EXPECT_EQ(sent, expected);
}

TEST_F(PortProbeTest, OtherBytesAreSomethingElse) {
  before = [](ScriptedChannel& line) {
    for (int i = 0; i < 3000; ++i) line.arrive(bytesOf("24 47 50 47 47 41 FF 0A"), i * 1000);
  };
  const PortProbe found = probe();
  EXPECT_EQ(found.answer, PortAnswer::kUnknownDevice);
  EXPECT_LE(seconds(), testing::timeLimit(2.6));
}

TEST_F(PortProbeTest, GivesUpWhenTold) {
  PortProbeOptions options;
  options.open = [&](const std::string&) {
    return std::make_unique<ScriptedChannel>(clock, ScriptedChannel::Answer{});
  };
  options.isCancelled = [&] { return clock.nowUs > 200'000; };
  EXPECT_EQ(probePort("x", options, clock).answer, PortAnswer::kNothing);
  EXPECT_LT(seconds(), testing::timeLimit(0.3));
}

TEST(PortProbe, ErrorsAreAnswers) {
  const PtyPair pty;
  const auto held = openChannel(pty.path());
  EXPECT_EQ(probePort(pty.path()).answer, PortAnswer::kBusy);
  EXPECT_EQ(probePort("/dev/ttyNONE3").answer, PortAnswer::kNotFound);
  EXPECT_EQ(probePort("/dev/ttyNONE3").message.find("/dev/ttyNONE3"), std::string::npos);
  EXPECT_EQ(probePort("tcp:nonsense").answer, PortAnswer::kNotFound);
  PortProbeOptions options;
  options.open = [](const std::string& port) -> std::unique_ptr<ByteChannel> {
    throw DeviceError(DeviceFault::kNoPermission, port, "not yours");
  };
  const PortProbe refused = probePort("p", options);
  EXPECT_EQ(refused.answer, PortAnswer::kNoPermission);
  EXPECT_EQ(refused.message, "not yours");
}

TEST(PortProbe, TellsTwoRealLinesApart) {
  FakeSdhHand hand;
  FakeTactileAnswers controller;
  PtyServer motion([&](const Bytes& request) { return hand.receive(request); });
  PtyServer tactile([&](const Bytes& request) { return controller.receive(request); });
  const std::size_t before = testing::openDescriptors();
  EXPECT_EQ(probePort(motion.path()).answer, PortAnswer::kMotion);
  EXPECT_EQ(probePort(tactile.path()).answer, PortAnswer::kTactile);
  EXPECT_EQ(testing::openDescriptors(), before);
}

TEST(PortProbe, SaysWhenPortsAreSwapped) {
  const auto at = [](const std::string& port, PortAnswer answer) {
    PortProbe probe;
    probe.port = port;
    probe.answer = answer;
    return probe;
  };
  const std::string swapped =
      describeSwap(at("A", PortAnswer::kMotion), at("B", PortAnswer::kTactile));
  EXPECT_NE(swapped.find("swapped"), std::string::npos);
  EXPECT_NE(swapped.find("A is the motion controller"), std::string::npos);
  EXPECT_NE(swapped.find("B the tactile"), std::string::npos);
  EXPECT_EQ(describeSwap(at("A", PortAnswer::kTactile), at("B", PortAnswer::kMotion)), "");
  EXPECT_EQ(describeSwap(at("A", PortAnswer::kNothing), at("B", PortAnswer::kNothing)), "");
  EXPECT_NE(describeSwap(at("A", PortAnswer::kMotion), at("B", PortAnswer::kNothing)).find("A was"),
            std::string::npos);
  EXPECT_NE(describeSwap(at("A", PortAnswer::kBusy), at("B", PortAnswer::kTactile)).find("B was"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::port_probe_test
