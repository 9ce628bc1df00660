#include "gui/widgets/message_banner.h"

#include <QCoreApplication>
#include <QLabel>
#include <QVBoxLayout>

#include <gtest/gtest.h>

namespace palpate::gui::message_banner_test {
namespace {

// A low window squeezes other parts, not the lines of a message.
TEST(MessageBanner, AllItsLinesAreSeenInALowWindow) {
  QWidget window;
  auto* banner = new MessageBanner(&window);
  auto* views = new QWidget(&window);
  views->setMinimumHeight(60);
  auto* column = new QVBoxLayout(&window);
  column->addWidget(banner);
  column->addWidget(views, 1);
  window.resize(300, 80);
  window.show();
  banner->showMessage(QString("The recording can't be read here. ").repeated(8));
  for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
  const auto* text = banner->findChild<QLabel*>("bannerText");
  EXPECT_GE(text->height(), text->heightForWidth(text->width()));
  banner->dismiss();
  banner->showMessage("short");
  for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
  EXPECT_LE(text->minimumHeight(), 2 * text->fontMetrics().lineSpacing());
}

}  // namespace
}  // namespace palpate::gui::message_banner_test
