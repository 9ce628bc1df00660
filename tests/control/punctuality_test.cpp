// Tests of Punctuality, which decides whether a stop was late or the machine was suspended.
#include "testing/punctuality.h"

#include <csignal>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/time.h"

namespace palpate::punctuality_test {
namespace {
using namespace testing;

TEST(LateWakeUps, CountAsFarAsTheyLieInTheStretch) {
  LateWakeUps late;
  late.note(10'000, 40'000, 0);
  late.note(60'000, 70'000, 0);
  EXPECT_EQ(late.standstillUs(0, 100'000), 40'000);
  EXPECT_EQ(late.standstillUs(20'000, 65'000), 25'000);
  EXPECT_EQ(late.standstillUs(40'000, 60'000), 0);
}

TEST(LateWakeUps, WhatTheProcessItselfComputedIsNoStandstill) {
  LateWakeUps late;
  late.note(10'000, 40'000, 28'000);  // of a thread of ours that kept the processor
  EXPECT_EQ(late.standstillUs(0, 100'000), 2'000);
  late.note(50'000, 60'000, 18'000);  // two of them
  EXPECT_EQ(late.standstillUs(50'000, 60'000), 0);
}

TEST(LateWakeUps, OfTwoCoresAtOnceCountOnce) {
  LateWakeUps late;
  late.note(30'000, 60'000, 0);
  late.note(10'000, 40'000, 0);
  late.note(35'000, 38'000, 0);
  EXPECT_EQ(late.standstillUs(0, 100'000), 50'000);
  EXPECT_EQ(late.standstillUs(35'000, 50'000), 15'000);
}

TEST(LateWakeUps, AnIdleMachineIsNotExact) {
  LateWakeUps late;
  for (int i = 0; i < 1000; ++i) late.note(i * 1000, i * 1000 + 300, 0);
  EXPECT_EQ(late.standstillUs(0, 1'000'000), 0);
}

TEST(Punctual, OneLateAnswerOfAFewIsAFault) {
  const PunctualityLimits limits;
  EXPECT_EQ(punctualityOf({{3000, 0}, {20'000, 0}}, limits).faults, "");
  const auto report = punctualityOf({{3000, 0}, {20'001, 0}, {4000, 0}}, limits);
  EXPECT_EQ(report.late, 1u);
  EXPECT_EQ(report.faults, "1 of 3 were late while the machine ran, 0 may be");
  EXPECT_NE(punctualityOf({}, limits).faults, "");
}

TEST(Punctual, OfAThousandFiveMayBeLateAndNoneTooLate) {
  std::vector<TimedAnswer> answers(1000, TimedAnswer{3000, 0});
  for (std::size_t i = 0; i < 5; ++i) answers[i * 100].tookUs = 30'000;
  EXPECT_EQ(punctualityOf(answers, {}).faults, "");
  answers[77].tookUs = 30'000;
  EXPECT_NE(punctualityOf(answers, {}).faults, "");
  answers[77].tookUs = 3000;
  answers[100].tookUs = 100'001;
  EXPECT_EQ(punctualityOf(answers, {}).faults, "1 took longer than any may, while the machine ran");
}

TEST(Punctual, IsExcusedByAStandstillAsLongAsItIsLate) {
  const auto late = punctualityOf({{50'000, 29'000}}, {});
  EXPECT_EQ(late.lateUnexcused, 1u);
  const auto excused = punctualityOf({{50'000, 30'000}}, {});
  EXPECT_EQ(excused.faults, "");
  EXPECT_EQ(excused.late, 1u) << "counted all the same";
  EXPECT_EQ(excused.lateUnexcused, 0u);
  EXPECT_EQ(excused.worstMs, 50.0) << "and published";
}

TEST(Punctual, FiguresAreThoseOfAllAnswers) {
  std::vector<TimedAnswer> answers;
  for (std::int64_t ms = 1; ms <= 100; ++ms) answers.push_back({ms * 100, 0});
  const auto report = punctualityOf(answers, {});
  EXPECT_EQ(report.answers, 100u);
  EXPECT_EQ(report.medianMs, 5.0);
  EXPECT_EQ(report.p99Ms, 9.9);
  EXPECT_EQ(report.worstMs, 10.0);
}

// The whole process is suspended, as on a machine that stops running.
TEST(Heartbeat, NoticesThatTheProcessWasStopped) {
  constexpr std::int64_t kStoppedUs = 80'000;
  Heartbeat heartbeat;
  const std::int64_t beginUs = systemClock().monotonicUs();
  const pid_t self = getpid();
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    kill(self, SIGSTOP);
    const timespec pause{0, kStoppedUs * 1000};
    nanosleep(&pause, nullptr);
    kill(self, SIGCONT);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  EXPECT_GE(heartbeat.standstillUs(beginUs, systemClock().monotonicUs()), kStoppedUs * 9 / 10);
}

// As in the slow suite.
struct JudgedTime {
  JudgedTime() { ::setenv("PALPATE_JUDGE_TIME", "1", 1); }
  ~JudgedTime() { ::unsetenv("PALPATE_JUDGE_TIME"); }
};

TEST(Punctuality, ALateAnswerFailsTheTestItStandsIn) {
  const JudgedTime judged;
  Punctuality answers("stop");
  const std::int64_t nowUs = systemClock().monotonicUs();
  answers.took(nowUs - 500'000, nowUs);  // the machine ran: this test had just begun
  EXPECT_NONFATAL_FAILURE(answers.judge(), "late while the machine ran");
}

TEST(Punctuality, WhatCouldNotBeMeasuredNeedsAnExcuse) {
  const JudgedTime judged;
  Punctuality answers("stop");
  const std::int64_t nowUs = systemClock().monotonicUs();
  EXPECT_NONFATAL_FAILURE(answers.lost(nowUs, nowUs, 50'000, "refused"), "refused, while");
  EXPECT_NONFATAL_FAILURE(answers.judge(), "nothing was measured");
}

}  // namespace
}  // namespace palpate::punctuality_test
