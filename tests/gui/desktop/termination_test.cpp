#include "gui/desktop/termination.h"

#include <QSignalSpy>
#include <QTest>

#include "testing/testing.h"

namespace palpate::gui::termination_test {
namespace {

TEST(Termination, ASignalIsHeardInsteadOfEndingTheProgram) {
  struct sigaction before {};
  ::sigaction(SIGTERM, nullptr, &before);
  {
    Termination termination;
    QSignalSpy asked(&termination, &Termination::asked);
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
      ::raise(number);
      ASSERT_TRUE(QTest::qWaitFor([&] { return !asked.isEmpty(); }, 20'000)) << number;
      asked.clear();
    }
  }
  struct sigaction after {};
  ::sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(after.sa_handler, before.sa_handler) << "as it was before";
}

TEST(Termination, WhatWasIgnoredStaysIgnored) {
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  struct sigaction before {};
  ::sigaction(SIGHUP, &ignore, &before);
  {
    Termination termination;
    const QSignalSpy asked(&termination, &Termination::asked);
    ::raise(SIGHUP);
    QTest::qWait(20);
    EXPECT_TRUE(asked.isEmpty());
  }
  ::sigaction(SIGHUP, &before, nullptr);
}

}  // namespace
}  // namespace palpate::gui::termination_test
