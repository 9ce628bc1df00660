// Tests the driver of the SDH-2 on a line that loses, changes and delays bytes, and with urgent
// stops.
#include "device/sdh_on_a_wire.h"

namespace palpate::sdh_link_test {
namespace {

using testing::bytesOf;
using testing::errorOf;
using Values = SdhController::Values;
using SdhLinkTest = testing::SdhOnAWire;

const testing::Bytes kStop = bytesOf("20 0D 0A 73 74 6F 70 0D 0A");  // " \r\nstop\r\n"

// --- A line that misbehaves

TEST_F(SdhLinkTest, OneMissingByteAnywhereCostsOneRetryAndNothingElse) {
  controller.open();
  for (int at = 0; at < 34; ++at) {
    hand.dropByteAt = at;
    const std::int64_t before = clock.nowUs;
    const std::uint64_t retries = controller.stats().retries;
    EXPECT_EQ(controller.angles(), hand.pos) << "byte " << at;
    EXPECT_EQ(controller.stats().retries, retries + 1) << "byte " << at;
    EXPECT_LT(clock.nowUs - before, 400'000) << "byte " << at;
    EXPECT_EQ(controller.targets(), hand.values["p"]) << "byte " << at;
    EXPECT_EQ(controller.stats().retries, retries + 1) << "byte " << at;
  }
}

TEST_F(SdhLinkTest, OneWrongBitAnywhereCostsOneRetryAndIsNeverAValue) {
  controller.open();
  for (int at = 0; at < 34; ++at) {
    hand.flipByteAt = at;
    EXPECT_EQ(controller.angles(), hand.pos) << "byte " << at;
  }
  EXPECT_EQ(controller.stats().retries, 34u);
  // with a wrong header it is not taken for a record
  EXPECT_GE(controller.stats().badChecksums, 31u);
}

TEST_F(SdhLinkTest, SkipsNoiseDebugLinesAndStaleAnswers) {
  controller.open();
  hand.garbage = "\x01\x02\xff\xfe";
  EXPECT_EQ(controller.angles(), hand.pos);
  hand.debugLines = 3;
  EXPECT_EQ(controller.temperatures().size(), 9u);
  hand.debugLines = 2;
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(controller.stats().debugLines, 5u);
  hand.lateAnswer = "M=9.99\r\n";
  EXPECT_DOUBLE_EQ(controller.pendingDuration(), 3.25);
  EXPECT_EQ(controller.stats().strayReplies, 1u);
  EXPECT_EQ(controller.stats().retries, 0u);
}

TEST_F(SdhLinkTest, AnAnswerOfAnotherNameIsNotTaken) {
  controller.open();
  hand.wrongNames = 1;
  EXPECT_DOUBLE_EQ(controller.pendingDuration(), 3.25);
  EXPECT_EQ(controller.stats().retries, 1u);
}

TEST_F(SdhLinkTest, ImpossibleValuesAreDroppedAndCounted) {
  controller.open();
  hand.nanAnswers = 1;
  EXPECT_EQ(controller.angles(), hand.pos);
  hand.wildAnswers = 2;
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(controller.stats().suspect, 3u);
  hand.nanAnswers = 3;
  EXPECT_EQ(errorOf([&] { controller.angles(); }).fault(), DeviceFault::kProtocol);
  EXPECT_EQ(controller.angles(), hand.pos);
}

TEST_F(SdhLinkTest, ErrorCodesSayWhatTheyMeanAndWhatToDo) {
  controller.open();
  hand.errorCode = 28;
  const DeviceError disabled = errorOf([&] { controller.move(); });
  EXPECT_EQ(disabled.fault(), DeviceFault::kRefused);
  EXPECT_NE(std::string(disabled.what()).find("axis disabled"), std::string::npos);
  EXPECT_NE(std::string(disabled.what()).find("power on again"), std::string::npos);
  EXPECT_EQ(hand.moves, 0);
  hand.errorCode = 29;  // error code in a record
  const DeviceError hot = errorOf([&] { controller.setPower(true); });
  EXPECT_NE(std::string(hot.what()).find("over-temperature"), std::string::npos);
  EXPECT_EQ(hand.values["power"], Values(7, 0.0));
  EXPECT_EQ(controller.stats().retries, 0u);
}

TEST_F(SdhLinkTest, AsksAgainWhatTheHandMisheard) {
  controller.open();
  for (const int code : {33, 13, 10, 14}) {
    hand.errorCode = code;
    EXPECT_EQ(controller.angles(), hand.pos) << code;
  }
  EXPECT_EQ(controller.stats().retries, 4u);
}

TEST_F(SdhLinkTest, ASilentHandIsGivenUpInBoundedTimeAndFoundAgain) {
  controller.open();
  hand.dead = true;
  const std::int64_t before = clock.nowUs;
  EXPECT_EQ(errorOf([&] { controller.angles(); }).fault(), DeviceFault::kSilent);
  EXPECT_LT(clock.nowUs - before, 4'000'000);
  hand.dead = false;
  EXPECT_EQ(controller.angles(), hand.pos);
}

TEST_F(SdhLinkTest, AnAnswerThatComesTooLateIsNotTakenForTheNextOne) {
  controller.open();
  answerAfterUs = 1'030'000;  // after the timeout, within the drain
  EXPECT_EQ(errorOf([&] { controller.angles(); }).fault(), DeviceFault::kSilent);
  answerAfterUs = 60'000;
  hand.pos = Values(7, 12.0);  // the late answer contains the old values
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(controller.targets(), hand.values["p"]);
}

TEST_F(SdhLinkTest, ABabblingLineIsGivenUpInBoundedTimeAndMemory) {
  controller.open();
  line.babble = true;
  const std::int64_t before = clock.nowUs;
  EXPECT_THROW(controller.angles(), DeviceError);
  EXPECT_LT(clock.nowUs - before, 6'000'000);
  line.babble = false;
  EXPECT_EQ(controller.angles(), hand.pos);
}

TEST_F(SdhLinkTest, ALineThatTricklesIsGivenUpInBoundedTime) {
  controller.open();
  hand.dead = true;
  for (int second = 0; second < 30; ++second) line.arrive(bytesOf("41"), second * 1'000'000);
  const std::int64_t before = clock.nowUs;
  EXPECT_THROW(controller.angles(), DeviceError);
  EXPECT_LT(clock.nowUs - before, 5'000'000);
  EXPECT_THROW(controller.open(), DeviceError);
  EXPECT_LT(clock.nowUs - before, 10'000'000);
}

TEST_F(SdhLinkTest, APulledPlugIsSaidAtOnce) {
  controller.open();
  line.pullThePlug();
  EXPECT_EQ(errorOf([&] { controller.angles(); }).fault(), DeviceFault::kDisconnected);
  EXPECT_EQ(errorOf([&] { controller.move(); }).fault(), DeviceFault::kDisconnected);
  EXPECT_EQ(errorOf([&] { controller.stop(); }).fault(), DeviceFault::kDisconnected);
}

// --- Motion and stop

// The answer to a motion request must not confirm a stop sent after it: the hand would begin to
// move nevertheless.
TEST_F(SdhLinkTest, AStopIsNotTakenForDoneByTheAnswerToWhatWasAskedBefore) {
  controller.open();
  line.arrive(bytesOf("4D 3D 34 2E 35 31 0D 0A"), 500);  // "M=4.51"
  const std::int64_t before = clock.nowUs;
  controller.stop();
  EXPECT_GE(clock.nowUs - before, answerAfterUs) << "STOP comes then";
  EXPECT_EQ(hand.stops, 1);
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(controller.stats().retries, 0u);
}

TEST_F(SdhLinkTest, ALostAnswerToMoveDoesNotStartTheMotionTwice) {
  controller.open();
  hand.silentAnswers = 1;
  EXPECT_DOUBLE_EQ(controller.move(), 3.25);
  EXPECT_EQ(hand.moves, 1);
}

TEST_F(SdhLinkTest, ALostMoveIsSentAgain) {
  controller.open();
  hand.errorCode = 13;  // the hand misunderstood the command
  EXPECT_DOUBLE_EQ(controller.move(), 4.51);
  EXPECT_EQ(hand.moves, 1);
}

TEST_F(SdhLinkTest, StopIsTheFirstThingOnTheWire) {
  controller.open();
  line.requests.clear();
  controller.stop();
  ASSERT_FALSE(line.requests.empty());
  EXPECT_EQ(line.requests[0], kStop);
  EXPECT_EQ(hand.stops, 1);
}

TEST_F(SdhLinkTest, StopIsSentAgainUntilItIsConfirmed) {
  controller.open();
  hand.silentAnswers = 2;
  controller.stop();
  EXPECT_EQ(hand.stops, 3);
  hand.dead = true;
  const std::int64_t before = clock.nowUs;
  EXPECT_EQ(errorOf([&] { controller.stop(); }).fault(), DeviceFault::kSilent);
  EXPECT_LT(clock.nowUs - before, 1'500'000);
}

// A line that echoes, or says something else, is no hand that has stopped: it must answer what is
// known of it.
TEST_F(SdhLinkTest, AnEchoDoesNotConfirmAStop) {
  controller.open();
  hand.dead = true;
  for (int i = 0; i < 5; ++i) line.arrive(kStop, i * 200'000);
  EXPECT_EQ(errorOf([&] { controller.stop(); }).fault(), DeviceFault::kSilent);
}

// The stops are lost, the hand moves on, and another line came meanwhile.
TEST_F(SdhLinkTest, AxesThatStillMoveAreNotTakenForStopped) {
  controller.open();
  hand.pollsPerMotion = 1000;
  controller.move();
  hand.lostStops = 3;
  line.arrive(bytesOf("4D 3D 34 2E 35 31 0D 0A"), 500);
  const DeviceError error = errorOf([&] { controller.stop(); });
  EXPECT_EQ(error.fault(), DeviceFault::kSilent);
  EXPECT_NE(std::string(error.what()).find("the axes still move"), std::string::npos);
}

// GraspControl asks again every 250 ms: the confirmation must not be ended by the next stop.
TEST_F(SdhLinkTest, AStopIsConfirmedByTheStatesAlsoWhileAnotherStopWaits) {
  controller.open();
  hand.lostStops = 3;
  line.arrive(bytesOf("4D 3D 34 2E 35 31 0D 0A"), 500);
  urgent = true;
  EXPECT_NO_THROW(controller.stop());
}

// The channel delivers another answer, while the stop got lost on its way to the hand.
TEST_F(SdhLinkTest, AStopThatGotLostDoesNotPassForTakenByAnotherLine) {
  controller.open();
  hand.dead = true;
  line.requests.clear();
  // "M=4.51", the answer to the request before
  line.arrive(bytesOf("4D 3D 34 2E 35 31 0D 0A"), 500);
  EXPECT_EQ(errorOf([&] { controller.stop(); }).fault(), DeviceFault::kSilent);
  ASSERT_GE(line.requests.size(), 2u);
  EXPECT_EQ(line.requests[0], kStop);
  EXPECT_TRUE(std::equal(kStop.rbegin(), kStop.rend(), line.requests[1].rbegin())) << "sent again";
  hand.dead = false;
  line.requests.clear();
  controller.stop();
  EXPECT_EQ(line.requests.size(), 1u) << "the answer that names it is enough at once";
}

TEST_F(SdhLinkTest, StopEndsARecordThatTheHandGotInPart) {
  controller.open();
  hand.receive(bytesOf("85 1F 07 00 00"));
  controller.stop();
  EXPECT_EQ(hand.stops, 1);
  EXPECT_EQ(hand.values["p"], (Values{0, -10, 20, -30, 40, -50, 60}));
}

TEST_F(SdhLinkTest, AnUrgentStopIsOnTheWireWithin20MsWhateverTheHandDoes) {
  controller.open();
  hand.dead = true;
  for (const std::int64_t afterUs : {2'000, 0, 15'000, 700'000, 1'040'000, 1'080'000, 2'500'000}) {
    const std::int64_t calledUs = clock.nowUs;
    line.onRead = [&] { urgent = clock.nowUs - calledUs >= afterUs; };
    urgent = afterUs == 0;
    line.requests.clear();
    EXPECT_THROW(controller.angles(), SdhInterrupted) << afterUs;
    EXPECT_LE(clock.nowUs - calledUs, std::max<std::int64_t>(afterUs, 0) + 20'000) << afterUs;
    ASSERT_FALSE(line.requests.empty());
    EXPECT_EQ(line.requests.back(), kStop);
  }
  line.onRead = {};
  urgent = false;
  hand.dead = false;
  EXPECT_EQ(controller.angles(), hand.pos);
}

TEST_F(SdhLinkTest, NoMotionStartsWhileAStopIsUrgent) {
  controller.open();
  urgent = true;
  EXPECT_THROW(controller.move(), SdhInterrupted);
  EXPECT_THROW(controller.setTargets(Values(7, 0.0)), SdhInterrupted);
  EXPECT_EQ(hand.moves, 0);
  controller.stop();
  urgent = false;
  EXPECT_DOUBLE_EQ(controller.move(), 4.51);
}

}  // namespace
}  // namespace palpate::sdh_link_test
