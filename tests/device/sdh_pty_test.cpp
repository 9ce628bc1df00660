// End-to-end tests of the SDH-2's driver: a real connection (pty or TCP), a fake hand on its own
// thread that was written from the protocol document, and real time.
#include <atomic>
#include <optional>
#include <thread>

#include "palpate/device/byte_channel.h"
#include "palpate/device/sdh_controller.h"

#include "device/fake_sdh_hand.h"
#include "device/pty_server.h"
#include "testing/punctuality.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::sdh_pty_test {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;
using testing::Bytes;
using testing::FakeSdhHand;
using testing::PtyServer;
using testing::Punctuality;
using Values = SdhController::Values;

class SdhPtyTest : public ::testing::Test {
 protected:
  FakeSdhHand hand;
  std::atomic<bool> urgent = false;
  PtyServer server{[this](const Bytes& request) { return hand.receive(request); }};
  std::unique_ptr<ByteChannel> channel = openChannel(server.path());
  SdhController controller{*channel, systemClock(), {.urgent = [this] { return urgent.load(); }}};

  void stopInTheMiddle(Punctuality& stops);
  // A copy of the fake hand between two answers.
  FakeSdhHand seen() {
    std::optional<FakeSdhHand> copy;
    server.between([&] { copy.emplace(hand); });
    return *copy;
  }
  static double msSince(SteadyClock::time_point start) {
    return std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
  }
};

TEST_F(SdhPtyTest, OpensReadsMovesAndStops) {
  EXPECT_EQ(controller.open().serial, "48");
  EXPECT_EQ(controller.angles(), seen().pos);
  EXPECT_EQ(controller.temperatures().size(), 9u);
  const Values goal{10, -20, -30, -40, 5, 60, 7.5};
  controller.setPower(true);
  controller.setVelocities(Values(7, 50.0));
  controller.setTargets(goal);
  EXPECT_DOUBLE_EQ(controller.move(), 4.51);
  int polls = 0;
  while (controller.states() != std::vector<int>(7, 0)) ASSERT_LT(++polls, 10);
  EXPECT_EQ(controller.angles(), goal);
  controller.stop();
  EXPECT_EQ(controller.stats().retries, 0u);
  EXPECT_EQ(seen().stops, 1);
}

TEST_F(SdhPtyTest, EveryByteIsAccountedFor) {
  controller.open();
  for (int i = 0; i < 50; ++i) controller.angles();
  EXPECT_EQ(controller.stats().bytesWritten, seen().bytesSeen);
  EXPECT_EQ(controller.stats().skippedBytes, 0u);
}

TEST_F(SdhPtyTest, AMissingByteIsGotOverInUnderASecond) {
  controller.open();
  for (const int at : {0, 1, 3, 20, 33}) {
    server.between([&] { hand.dropByteAt = at; });
    const auto start = SteadyClock::now();
    EXPECT_EQ(controller.angles(), seen().pos) << "byte " << at;
    EXPECT_LT(msSince(start), testing::timeLimit(900.0)) << "byte " << at;
  }
  EXPECT_EQ(controller.stats().retries, 5u);
}

// Measures the time from pressing Stop, in the middle of an unanswered exchange, to `stop` at the
// hand.
void SdhPtyTest::stopInTheMiddle(Punctuality& stops) {
  const FakeSdhHand before = seen();
  std::thread operatorThread([&] {
    const auto start = SteadyClock::now();
    for (bool inExchange = false; !inExchange && msSince(start) < 5000.0;)
      server.between([&] { inExchange = hand.log.size() > before.log.size(); });
    const auto pressed = SteadyClock::now();
    const std::int64_t pressedUs = systemClock().monotonicUs();
    urgent = true;
    channel->interrupt();
    int arrived = before.stops;
    while (arrived == before.stops && msSince(pressed) < 2000.0)
      server.between([&] { arrived = hand.stops; });
    stops.took(pressedUs, systemClock().monotonicUs());
  });
  EXPECT_THROW(controller.angles(), SdhInterrupted);
  operatorThread.join();
  urgent = false;
}

TEST_F(SdhPtyTest, AStopFromAnotherThreadIsOnTheWireWithin20Ms) {
  controller.open();
  server.between([&] { hand.silentAnswers = 1'000'000; });
  Punctuality stops("stop_in_an_exchange");
  for (int i = 0; i < 20; ++i) stopInTheMiddle(stops);
  stops.judge();
}

TEST_F(SdhPtyTest, UnpluggingIsNoticedWithin500Ms) {
  controller.open();
  server.between([&] { hand.dead = true; });
  std::thread other([&] { server.unplug(); });
  const auto start = SteadyClock::now();
  try {
    controller.angles();
    ADD_FAILURE() << "answered";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kDisconnected) << error.what();
  }
  EXPECT_LT(msSince(start), testing::timeLimit(500.0));
  other.join();
}

}  // namespace
}  // namespace palpate::sdh_pty_test
