#include "palpate/device/live_hand.h"

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "device/babbling_channel.h"
#include "device/collecting_sink.h"
#include "testing/time_limit.h"

namespace palpate::testing::live_hand_test {
namespace {

using std::chrono::milliseconds;

class LiveHandTest : public ::testing::Test {
 protected:
  BabblerControls controls;
  CollectingSink sink;
  LiveHand hand{options()};

  LiveHandOptions options() {
    LiveHandOptions given;
    given.dsaPort = "babbler";
    given.open = [this](const std::string& port) -> std::unique_ptr<ByteChannel> {
      if (controls.behaviour == Behaviour::kDisconnected)
        throw DeviceError(DeviceFault::kNotFound, port, "no such port");
      return std::make_unique<BabblingChannel>(controls);
    };
    return given;
  }

  DeviceFault faultOf(std::future<CommandAnswer> answer) {
    try {
      answer.get();
    } catch (const DeviceError& error) {
      return error.fault();
    }
    ADD_FAILURE() << "no DeviceError";
    return DeviceFault::kNotFound;
  }
  std::size_t numEvents(const std::string& kind) {
    std::size_t count = 0;
    for (const Event& event : sink.takeEvents())
      if (event.kind == kind) ++count;
    return count;
  }
};

TEST_F(LiveHandTest, DeliversFramesInOrderWithTheirStamps) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(50));
  hand.stop();
  const auto frames = sink.takeFrames();
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].hostUs, frames[i - 1].hostUs);
    EXPECT_GT(*frames[i].deviceUs, *frames[i - 1].deviceUs);
    EXPECT_EQ(frames[i].values.size(), 486u);
  }
  EXPECT_EQ(hand.info().serial, "1D9B0057");
  EXPECT_EQ(hand.info().firmware, "2.9.0.0");
  EXPECT_EQ(hand.hand().layout->numTaxels(), 456u);
  EXPECT_EQ(hand.status().tactile.items, frames.size());
  EXPECT_EQ(hand.status().tactile.lost, 0u);
  EXPECT_EQ(hand.status().tactile.state, PortState::kClosed);
}

TEST_F(LiveHandTest, CanBeStartedAgain) {
  for (int round = 0; round < 3; ++round) {
    const std::size_t before = sink.numFrames();
    hand.start(sink);
    EXPECT_THROW(hand.start(sink), std::logic_error);
    ASSERT_TRUE(sink.awaitFrames(before + 5));
    hand.stop();
    hand.stop();
  }
}

TEST_F(LiveHandTest, ASettingPausesTheStreamAndLeavesAnEvent) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(5));
  hand.submit(SetThreshold{2, 77}).get();
  EXPECT_EQ(controls.threshold2, 77u);
  EXPECT_FALSE(controls.setWhileStreaming);
  EXPECT_EQ(hand.info().matrices[2].thresholdCounts, 77);
  EXPECT_EQ(hand.info().matrices[3].thresholdCounts, 300);
  const std::size_t frames = sink.numFrames();
  ASSERT_TRUE(sink.awaitFrames(frames + 5)) << "the stream goes on";
  hand.stop();
  EXPECT_EQ(numEvents("settings"), 1u);
  EXPECT_EQ(numEvents("gap"), 0u) << "a pause for settings is no gap";
  EXPECT_EQ(numEvents("alarm"), 0u);
  EXPECT_EQ(hand.status().tactile.lost, 0u);
}

TEST_F(LiveHandTest, SettingsInARowAreAllCarriedOut) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(5));
  std::vector<std::future<CommandAnswer>> answers;
  for (int matrix = 0; matrix < 6; ++matrix)
    answers.push_back(hand.submit(SetThreshold{matrix, 60 + matrix}));
  for (auto& answer : answers) EXPECT_NO_THROW(answer.get());
  for (std::size_t m = 0; m < 6; ++m)
    EXPECT_EQ(hand.info().matrices[m].thresholdCounts, 60 + static_cast<int>(m));
}

TEST_F(LiveHandTest, AMaskChangesTheHandItDelivers) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(5));
  Mask half(84, 0);
  std::fill_n(half.begin(), 42, 1);
  hand.submit(SetDynamicMask{0, half}).get();
  EXPECT_EQ(hand.hand().layout->matrix(0).numEnabled(), 42u);
}

TEST_F(LiveHandTest, WrongValuesAreTheCallersFault) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(1));
  EXPECT_THROW(hand.submit(SetThreshold{0, 5000}).get(), std::invalid_argument);
  EXPECT_THROW(hand.submit(SetThreshold{6, 50}).get(), std::invalid_argument);
  EXPECT_THROW(hand.submit(SetThreshold{-1, 50}).get(), std::invalid_argument);
  EXPECT_THROW(hand.submit(SetSensitivity{{}, 1.5}).get(), std::invalid_argument);
  EXPECT_THROW(hand.submit(SetDynamicMask{1, Mask(84, 1)}).get(), std::invalid_argument);
  const std::size_t frames = sink.numFrames();
  EXPECT_TRUE(sink.awaitFrames(frames + 5)) << "the stream goes on";
}

TEST_F(LiveHandTest, CommandsWithoutTheirPortAreRefused) {
  EXPECT_EQ(faultOf(hand.submit(SetThreshold{0, 50})), DeviceFault::kSilent) << "not started";
  hand.start(sink);
  EXPECT_EQ(faultOf(hand.submit(MoveJoints{std::vector<double>(7, 0.0), {}, false})),
            DeviceFault::kUnsupported);
  EXPECT_EQ(faultOf(hand.submit(StopMotion{})), DeviceFault::kUnsupported);
  EXPECT_FALSE(hand.status().motion);
}

TEST_F(LiveHandTest, AHandThatReturnsStreamsAgainWithItsSettings) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(5));
  hand.submit(SetThreshold{2, 60}).get();
  controls.behaviour = Behaviour::kDisconnected;
  ASSERT_TRUE(sink.await([&] { return hand.status().tactile.state == PortState::kLost; },
                         milliseconds(500)));
  EXPECT_FALSE(hand.status().tactile.message.empty());
  EXPECT_EQ(faultOf(hand.submit(SetThreshold{2, 61})), DeviceFault::kSilent);
  const std::size_t frames = sink.numFrames();
  controls.threshold2 = 0;
  controls.behaviour = Behaviour::kHonest;
  ASSERT_TRUE(sink.awaitFrames(frames + 5));
  EXPECT_EQ(controls.threshold2, 60u) << "the new controller had its factory's 150";
  hand.stop();
  EXPECT_EQ(hand.status().tactile.reconnects, 1u);
  EXPECT_EQ(numEvents("gap"), 1u);
  const auto all = sink.takeFrames();
  for (const Event& event : sink.takeEvents())
    if (event.kind == "gap") {
      EXPECT_EQ(event.tUs, all[frames - 1].hostUs);
      EXPECT_EQ(event.t1Us, all[frames].hostUs);
    }
}

// The number may belong to another program's terminal by then: nothing may be written there.
TEST_F(LiveHandTest, APtyNamedByItsNumberIsNotOpenedAgainOnceItIsGone) {
  std::atomic<int> opened = 0;
  LiveHandOptions given = options();
  given.dsaPort = "/dev/pts/4711";
  given.open = [&](const std::string&) -> std::unique_ptr<ByteChannel> {
    ++opened;
    return std::make_unique<BabblingChannel>(controls);
  };
  LiveHand named(given);
  named.start(sink);
  ASSERT_TRUE(sink.awaitFrames(3));
  controls.behaviour = Behaviour::kDisconnected;
  ASSERT_TRUE(sink.await([&] { return named.status().tactile.state == PortState::kLost; }));
  controls.behaviour = Behaviour::kHonest;
  EXPECT_FALSE(sink.await([&] { return opened > 1; }, milliseconds(400)));
  EXPECT_NE(named.status().tactile.message.find("this pseudo-terminal doesn't exist"),
            std::string::npos);
  named.stop();
}

TEST_F(LiveHandTest, AnotherControllerInTheSamePlaceIsNotTakenForTheFirst) {
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(3));
  controls.behaviour = Behaviour::kDisconnected;
  ASSERT_TRUE(sink.await([&] { return hand.status().tactile.state == PortState::kLost; }));
  const std::size_t frames = sink.numFrames();
  controls.serialByte = 0x99;
  controls.behaviour = Behaviour::kHonest;
  ASSERT_TRUE(sink.await([&] {
    return hand.status().tactile.message.find("another tactile controller") != std::string::npos;
  }));
  EXPECT_EQ(sink.numFrames(), frames);
  controls.serialByte = 0x57;
  EXPECT_TRUE(sink.awaitFrames(frames + 3)) << "the first one is back";
}

TEST_F(LiveHandTest, StopsSoonWhateverTheStateOfThePort) {
  for (const Behaviour behaviour : {Behaviour::kHonest,
                                    Behaviour::kSilent,
                                    Behaviour::kBabbling,
                                    Behaviour::kDripping,
                                    Behaviour::kDisconnected}) {
    controls.behaviour = Behaviour::kHonest;
    controls.most = UINT64_MAX;
    hand.start(sink);
    ASSERT_TRUE(sink.awaitFrames(sink.numFrames() + 2));
    controls.behaviour = behaviour;
    const auto from = std::chrono::steady_clock::now();
    hand.stop();
    EXPECT_LT(std::chrono::steady_clock::now() - from, timeLimit(milliseconds(2000)))
        << static_cast<int>(behaviour);
  }
}

TEST_F(LiveHandTest, StopsSoonWhileItLooksForAControllerThatIsSilent) {
  controls.behaviour = Behaviour::kSilent;
  hand.start(sink);
  ASSERT_TRUE(sink.await([&] { return hand.status().tactile.state == PortState::kConnecting; }));
  EXPECT_EQ(faultOf(hand.submit(SetThreshold{0, 50})), DeviceFault::kSilent)
      << "an order doesn't wait for the controller to appear";
  const auto from = std::chrono::steady_clock::now();
  hand.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - from, timeLimit(milliseconds(2000)));
}

TEST(LiveHandOptions, AreChecked) {
  LiveHandOptions options;
  EXPECT_THROW(LiveHand{options}, std::invalid_argument) << "no port";
  options.dsaPort = options.sdhPort = "/dev/ttyUSB0";
  EXPECT_THROW(LiveHand{options}, std::invalid_argument) << "one port for both";
  options.sdhPort = "/dev/ttyUSB1";
  EXPECT_NO_THROW(LiveHand{options});
  options.angleHz = 0.5;
  EXPECT_THROW(LiveHand{options}, std::invalid_argument);
}

}  // namespace
}  // namespace palpate::testing::live_hand_test
