#include "palpate/core/interruption.h"

#include <csignal>
#include <future>

#include <gtest/gtest.h>
#include <poll.h>

namespace palpate::interruption_test {
namespace {

class InterruptionTest : public ::testing::TestWithParam<int> {};

TEST_P(InterruptionTest, ASignalIsToldOnceAndEndsNothing) {
  Interruption interruption;
  EXPECT_FALSE(interruption.waitForSignal(0));
  std::raise(GetParam());
  EXPECT_TRUE(interruption.waitForSignal(0));
  EXPECT_FALSE(interruption.waitForSignal(0));
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptionTest, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(Interruption, TheDescriptorCanBeReadWhenOneCame) {
  Interruption interruption;
  pollfd waits{interruption.descriptor(), POLLIN, 0};
  EXPECT_EQ(poll(&waits, 1, 0), 0);
  std::raise(SIGTERM);
  EXPECT_EQ(poll(&waits, 1, 0), 1);
}

TEST(Interruption, WaitingEndsWithTheSignal) {
  Interruption interruption;
  constexpr int kWithinMs = 60'000;
  auto waits =
      std::async(std::launch::async, [&] { return interruption.waitForSignal(kWithinMs); });
  std::raise(SIGTERM);
  EXPECT_TRUE(waits.get());
}

TEST(Interruption, WhatWasIgnoredBeforeStaysSoAndTheRestIsAsBefore) {
  std::signal(SIGHUP, SIG_IGN);
  {
    Interruption interruption;
    std::raise(SIGHUP);
    EXPECT_FALSE(interruption.waitForSignal(0)) << "nohup";
  }
  EXPECT_EQ(std::signal(SIGHUP, SIG_DFL), SIG_IGN);
  EXPECT_EQ(std::signal(SIGTERM, SIG_DFL), SIG_DFL);
}

}  // namespace
}  // namespace palpate::interruption_test
