#include "gui/appearance/text_size.h"

#include <QApplication>
#include <QLabel>

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::text_size_test {
namespace {

TEST(TextSizeTest, NonsenseReadsAsTheDesktopsSize) {
  const testing::TemporaryFolder folder;
  QSettings settings(QString::fromStdString((folder / "a.ini").string()), QSettings::IniFormat);
  EXPECT_EQ(loadTextPt(settings), 0);
  saveTextPt(13, settings);
  EXPECT_EQ(loadTextPt(settings), 13);
  for (const char* nonsense : {"6", "400", "large", "-1"}) {
    settings.setValue("view/text_pt", nonsense);
    EXPECT_EQ(loadTextPt(settings), 0) << nonsense;
  }
}

TEST(TextSizeTest, ReachesAllWidgetsInProportionAndComesBack) {
  QLabel plain("a"), large("b");
  QFont twice = large.font();
  const double before = QFontInfo(QApplication::font()).pointSizeF();
  twice.setPointSizeF(2.0 * before);
  large.setFont(twice);
  plain.show();
  large.show();
  applyTextPt(16);
  QCoreApplication::processEvents();
  EXPECT_NEAR(plain.font().pointSizeF(), 16.0, 0.01);
  EXPECT_NEAR(large.font().pointSizeF(), 32.0, 0.3);
  EXPECT_NEAR(QLabel().font().pointSizeF(), 16.0, 0.01);
  applyTextPt(0);
  QCoreApplication::processEvents();
  EXPECT_NEAR(plain.font().pointSizeF(), before, 0.01);
  EXPECT_NEAR(large.font().pointSizeF(), 2.0 * before, 0.3);
}

}  // namespace
}  // namespace palpate::gui::text_size_test
