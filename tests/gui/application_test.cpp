// The QApplication of gui_main.cpp is the program's own.
#include "gui/application.h"

#include <QIcon>
#include <QImage>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

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

// C-A2: a hand may be moving, and its stop must be heard.
TEST(Application, WhatIsThrownAtAnEventEndsNothing) {
  class Thrower : public QObject {
    bool event(QEvent*) override { throw std::runtime_error("a bug in the window"); }
  } thrower;
  QCoreApplication::postEvent(&thrower, new QEvent(QEvent::User));
  EXPECT_NO_THROW(QCoreApplication::processEvents());
  EXPECT_FALSE(QCoreApplication::sendEvent(&thrower, std::make_unique<QEvent>(QEvent::User).get()));
}

}  // namespace
}  // namespace palpate::gui::application_test
