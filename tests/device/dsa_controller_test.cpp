#include "palpate/device/dsa_controller.h"

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "device/dsa_fake.h"

namespace palpate::testing::dsa_controller_test {
namespace {

class DsaControllerTest : public ::testing::Test {
 protected:
  ManualClock clock;
  FakeDsa hand{clock};
  ScriptedChannel line{
      clock, [this](const Bytes& request, ScriptedChannel& channel) { hand(request, channel); }};
  std::vector<Bytes> frames;
  DsaController controller{line,
                           [this](std::span<const std::byte> payload) {
                             frames.emplace_back(payload.begin(), payload.end());
                           },
                           clock};

  DeviceFault faultOf(const std::function<void()>& work) {
    try {
      work();
    } catch (const DeviceError& error) {
      message = error.what();
      return error.fault();
    }
    ADD_FAILURE() << "no DeviceError";
    return DeviceFault::kNotFound;
  }
  std::string message;
};

TEST_F(DsaControllerTest, OpensAndLearnsTheSensor) {
  const DsaControllerInfo& facts = controller.open();
  EXPECT_EQ(facts.serial, 0x1D9B0057u);
  EXPECT_EQ(facts.firmwareText(), "2.9.0.0");
  EXPECT_EQ(facts.generatedBy, 105);
  EXPECT_EQ(facts.layout(), *sdh2().layout);
  EXPECT_EQ(facts.matrices[3].thresholdCounts, 300);
  EXPECT_EQ(facts.matrices[0].fullScale, 4095.0);
  EXPECT_EQ(facts.matrices[0].centreMm[0], -50.0);
  EXPECT_EQ(facts.matrices[0].centreMm[1], -32.0);
  EXPECT_TRUE(facts.masksKnown);
  // The first bytes sent are the stop of the protocol document.
  EXPECT_EQ(line.requests.front(), bytesOf("AA AA AA 03 03 00 01 00 00 2F 6A"));
  // A hand that was reconnected must stream within a second, so opening takes less than half of it
  // here.
  EXPECT_LT(clock.nowUs, 450'000);
}

TEST_F(DsaControllerTest, AStreamLeftOverByAnotherProgramIsStoppedFirst) {
  for (int i = 0; i < 20; ++i) hand.sendFrame(line, i * 3000);
  line.arrive(bytesOf("00 AA AA AA 00 D1 03 12 12"), 61'000);  // a frame interrupted by the stop
  controller.open();
  EXPECT_EQ(frames.size(), 20u);
  controller.startStream();
  EXPECT_TRUE(hand.streaming);
}

TEST_F(DsaControllerTest, WaitsForAControllerThatBoots) {
  hand.deafUntilUs = 8'000'000;
  for (int i = 0; i < 3; ++i) line.arrive(bytesOf("1B 5B 35 6E"), 7'000'000 + i * 270'000);
  controller.open();
  EXPECT_GT(clock.nowUs, 8'000'000);
  EXPECT_LT(clock.nowUs, 9'500'000);
}

TEST_F(DsaControllerTest, SilenceEndsWithinTheLimitAndSaysWhatToDo) {
  hand.deafUntilUs = INT64_MAX;
  EXPECT_EQ(faultOf([&] { controller.open(); }), DeviceFault::kSilent);
  EXPECT_NE(message.find("check cable and power"), std::string::npos) << message;
  EXPECT_LT(clock.nowUs, 16'500'000);
}

// C-A14: a late acknowledgement of the same command is not the answer to this request.
TEST_F(DsaControllerTest, AStaleAnswerIsNotTakenForTheOneAskedFor) {
  controller.open();
  line.arrive(wirePacket(0x13, bytesOf("18 00")), 1000);  // an error: "index out of bounds"
  line.arrive(wirePacket(0x13, bytesOf("18 00")), 200'000);
  controller.poll(std::chrono::milliseconds(10));  // one answer is already read ..
  clock.nowUs += 300'000;                          // .. another one waits in the channel
  EXPECT_NO_THROW(controller.setThreshold(2, 77));
  EXPECT_EQ(hand.thresholds[2], 77u);
  EXPECT_EQ(controller.stats().strayAnswers, 2u);
}

TEST_F(DsaControllerTest, SaysWhenThePortsAreSwapped) {
  ScriptedChannel motion(clock, [](const Bytes& request, ScriptedChannel& channel) {
    if (std::search(request.begin(),
                    request.end(),
                    std::begin("ver"),
                    std::begin("ver") + 3,
                    [](std::byte a, char b) { return std::to_integer<char>(a) == b; }) !=
        request.end())
      channel.arrive(bytesOf("56 45 52 3D 30 2E 30 2E 33 2E 33 0D 0A"), 2000);  // VER=0.0.3.3
  });
  DsaController wrong(
      motion, [](std::span<const std::byte>) {}, clock);
  EXPECT_EQ(faultOf([&] { wrong.open(); }), DeviceFault::kWrongDevice);
  EXPECT_NE(message.find("swapped"), std::string::npos) << message;
  EXPECT_LT(clock.nowUs, 3'000'000);
}

TEST_F(DsaControllerTest, AnswersArriveWhileFramesStream) {
  controller.open();
  controller.startStream();
  hand.streamFor(1'000'000, line);
  controller.setThreshold(2, 77);  // pauses, sets, continues
  EXPECT_EQ(hand.thresholds[2], 77u);
  EXPECT_FALSE(hand.setWhileStreaming);
  EXPECT_TRUE(hand.streaming);
  EXPECT_EQ(controller.info().matrices[2].thresholdCounts, 77);
  EXPECT_GE(frames.size(), 30u) << "frames under way are not lost";
}

TEST_F(DsaControllerTest, SeveralSettingsTakeOnePause) {
  controller.open();
  controller.startStream();
  const int stops = hand.stops;
  controller.whilePaused([&] {
    for (std::size_t m = 0; m < 6; ++m) {
      controller.setThreshold(m, 100);
      controller.setSensitivity(m, 1.0);
    }
  });
  EXPECT_EQ(hand.stops, stops + 1);
  EXPECT_EQ(hand.sensitivities, std::vector<float>(6, 1.0F));
  controller.resetSensitivity(4);
  EXPECT_EQ(hand.sensitivities[4], 0.5F);
}

TEST_F(DsaControllerTest, PersistentSettingsAreNotWaitedFor) {
  controller.open();
  const std::int64_t before = clock.nowUs;
  controller.setThreshold(1, 200, true);
  controller.setSensitivity(1, 0.25, true);
  EXPECT_LT(clock.nowUs - before, 100'000);
  EXPECT_EQ(controller.info().matrices[1].thresholdCounts, 200);
  EXPECT_EQ(controller.info().matrices[1].sensitivity, 0.25);
}

TEST_F(DsaControllerTest, NothingIsSentForAWrongValue) {
  controller.open();
  const std::size_t sent = line.written.size();
  EXPECT_THROW(controller.setSensitivity(0, 1.01), std::invalid_argument);
  EXPECT_THROW(controller.setSensitivity(0, NAN), std::invalid_argument);
  EXPECT_THROW(controller.setThreshold(0, 4096), std::invalid_argument);
  EXPECT_THROW(controller.setThreshold(0, -1), std::invalid_argument);
  EXPECT_THROW(controller.setThreshold(6, 10), std::invalid_argument);
  EXPECT_THROW(controller.setDynamicMask(1, Mask(84, 1)), std::invalid_argument);
  EXPECT_EQ(line.written.size(), sent);
}

TEST_F(DsaControllerTest, MasksAreSetAndReadBack) {
  controller.open();
  // The chequer pattern of the protocol document, matrix 0.
  Mask chequer(84);
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x)
      chequer[static_cast<std::size_t>(y * 6 + x)] = (x + y) % 2 == 1 ? 1 : 0;
  controller.setDynamicMask(0, chequer);
  EXPECT_EQ(hand.dynamicMasks[0], bytesOf("6A A5 56 6A A5 56 6A A5 56 6A 05"));
  EXPECT_EQ(controller.info().matrices[0].layout.dynamicMask, chequer);
}

// The layout of a recording must not depend on one damaged answer while connecting.
TEST_F(DsaControllerTest, AMaskWhoseAnswerIsLostIsAskedForAgain) {
  hand.swallowMasks = 2;
  const DsaControllerInfo& facts = controller.open();
  EXPECT_TRUE(facts.masksKnown);
  EXPECT_EQ(facts.layout(), *sdh2().layout);
}

TEST_F(DsaControllerTest, OlderFirmwareWithoutMasksOrThresholds) {
  hand.firmware = 218;
  hand.knowsMasks = false;
  const DsaControllerInfo& facts = controller.open();
  EXPECT_EQ(facts.firmwareText(), "218");
  EXPECT_FALSE(facts.masksKnown);
  EXPECT_EQ(facts.layout().numTaxels(), 486u);
  EXPECT_FALSE(facts.matrices[0].thresholdCounts);
  EXPECT_EQ(faultOf([&] { controller.setThreshold(0, 10); }), DeviceFault::kUnsupported);
  EXPECT_EQ(faultOf([&] { controller.setDynamicMask(0, Mask(84, 1)); }), DeviceFault::kUnsupported);
  EXPECT_EQ(faultOf([&] { controller.pullFrame(); }), DeviceFault::kUnsupported);
}

TEST_F(DsaControllerTest, PullModeTakesOneFrameAtATime) {
  controller.open();
  for (int i = 0; i < 3; ++i) controller.pullFrame();
  EXPECT_EQ(frames.size(), 3u);
  EXPECT_FALSE(hand.streaming);
}

TEST_F(DsaControllerTest, ALostAnswerIsAskedForAgain) {
  controller.open();
  hand.swallow = 1;
  controller.setThreshold(5, 123);
  EXPECT_EQ(controller.info().matrices[5].thresholdCounts, 123);
  EXPECT_EQ(controller.stats().retries, 1u);
  hand.swallow = 1000;
  const std::int64_t before = clock.nowUs;
  EXPECT_EQ(faultOf([&] { controller.setThreshold(5, 1); }), DeviceFault::kSilent);
  EXPECT_LT(clock.nowUs - before, 4'000'000);
}

TEST_F(DsaControllerTest, AnErrorCodeIsNamed) {
  controller.open();
  EXPECT_EQ(faultOf([&] { controller.descriptor(true, 1); }), DeviceFault::kRefused);
  EXPECT_NE(message.find("unknown command"), std::string::npos) << message;
}

TEST_F(DsaControllerTest, AnUnpluggedPortIsNoTimeout) {
  controller.open();
  line.pullThePlug();
  EXPECT_EQ(faultOf([&] { controller.poll(std::chrono::milliseconds(1)); }),
            DeviceFault::kDisconnected);
}

TEST_F(DsaControllerTest, BabbleInsteadOfAControllerEndsInTime) {
  std::mt19937 random(9);
  std::int64_t until = 60'000'000;
  for (std::int64_t at = 0; at < until; at += 20'000) {
    Bytes noise(200);
    for (std::byte& b : noise) b = static_cast<std::byte>(random() & 0xFFu);
    line.arrive(noise, at);
  }
  hand.deafUntilUs = INT64_MAX;
  EXPECT_EQ(faultOf([&] { controller.open(); }), DeviceFault::kSilent);
  EXPECT_LT(clock.nowUs, 17'000'000);
}

}  // namespace
}  // namespace palpate::testing::dsa_controller_test
