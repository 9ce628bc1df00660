// The QApplication of gui_main.cpp is the program's own.
#include "gui/desktop/application.h"

#include <QIcon>
#include <QImage>
#include <memory>
#include <stdexcept>

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "gui/library/log_panel.h"
#include "gui/testing/thrown_at_events.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::application_test {
namespace {

TEST(Application, HasAnIconInEverySizeThatDesktopsAskFor) {
  const QIcon icon = QApplication::windowIcon();
  for (int size : {16, 24, 32, 48, 64, 128, 256}) {
    const QSize wanted(size, size);
    EXPECT_TRUE(icon.availableSizes().contains(wanted)) << size;
    const QImage image = icon.pixmap(wanted, 1.0).toImage();
    ASSERT_EQ(image.size(), wanted);
    // A square with round corners, in its middle a taxel that feels most.
    EXPECT_LT(image.pixelColor(0, 0).alpha(), 128) << size;
    EXPECT_GT(image.pixelColor(size / 2, size * 9 / 16).lightness(), 150) << size;
  }
}

TEST(Application, IsCalledAsItsDesktopEntry) {
  EXPECT_EQ(QApplication::desktopFileName(), "palpate");
}

// In one process with other tests, some of which may have failed so before.
struct CountedFromZero {
  CountedFromZero() { forgetFailuresAtEvents(); }
  ~CountedFromZero() {
    QCoreApplication::processEvents();
    forgetFailuresAtEvents();
  }
};

class Thrower : public QObject {
 public:
  void throwNow() {
    QCoreApplication::postEvent(this, new QEvent(QEvent::User));
    QCoreApplication::processEvents();
  }

 private:
  bool event(QEvent*) override { throw std::runtime_error("a bug in the window"); }
};

// C-A2: a hand may be moving, and its stop must be heard.
TEST(Application, WhatIsThrownAtAnEventEndsNothing) {
  const CountedFromZero counted;
  Thrower thrower;
  EXPECT_NO_THROW(thrower.throwNow());
  EXPECT_FALSE(QCoreApplication::sendEvent(&thrower, std::make_unique<QEvent>(QEvent::User).get()));
  EXPECT_EQ(failuresAtEvents(), 2u);
}

TEST(Application, ATestInWhichAnEventThrowsFails) {
  const CountedFromZero counted;
  static const ::testing::TestInfo* info = ::testing::UnitTest::GetInstance()->current_test_info();
  static testing::ThrownAtEvents listener;
  listener.OnTestStart(*info);
  listener.OnTestEnd(*info);  // nothing was thrown
  Thrower().throwNow();
  EXPECT_NONFATAL_FAILURE(listener.OnTestEnd(*info), "threw at 1 events");
}

class FailingWindow : public WindowTest {};

// A timer that throws each time must not fill the log.
TEST_F(FailingWindow, SaysOnceWhatWasThrown) {
  const CountedFromZero counted;
  auto* application = qobject_cast<GuardedApplication*>(QCoreApplication::instance());
  ASSERT_NE(application, nullptr);
  QSignalSpy failed(application, &GuardedApplication::failed);
  const int lines = window().state().log.rowCount();
  Thrower thrower;
  for (int i = 0; i < 3; ++i) thrower.throwNow();
  QCoreApplication::processEvents();
  EXPECT_EQ(failuresAtEvents(), 3u);
  EXPECT_EQ(failed.count(), 1);
  EXPECT_TRUE(bannerText().contains("a bug in the window")) << bannerText().toStdString();
  ASSERT_EQ(window().state().log.rowCount(), lines + 1);
  EXPECT_TRUE(window().state().log.line(lines).text.contains("a bug in the window"));
}

}  // namespace
}  // namespace palpate::gui::application_test
