#include "gui/appearance/text_size.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QMenuBar>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <initializer_list>

#include <gtest/gtest.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/theme.h"
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

// Qt passes no font on to children under a style sheet of the application.
TEST(TextSizeTest, ReachesChildrenUnderTheStyleSheetOfTheTheme) {
  applyTheme(*qApp, Theme::kLight);
  const double before = QApplication::font().pointSizeF();
  QWidget window;
  auto* column = new QVBoxLayout(&window);
  auto* button = new QPushButton("press", &window);
  auto* bold = new QPushButton("danger", &window);
  bold->setProperty("danger", true);
  auto* field = new QSpinBox(&window);
  auto* list = new QComboBox(&window);
  list->addItem("choice");
  auto* heading = new QLabel("heading", &window);
  heading->setProperty("role", "heading");
  auto* caption = sectionHeading("caption", &window);
  auto* menus = new QMenuBar(&window);
  menus->addMenu("File");
  const double captionPt = caption->font().pointSizeF();
  for (QWidget* each :
       std::initializer_list<QWidget*>{menus, button, bold, field, list, heading, caption})
    column->addWidget(each);
  window.show();
  QCoreApplication::processEvents();
  const QSize small = button->sizeHint();
  for (const int pt : {18, 7, 16}) {
    applyTextPt(pt);
    QCoreApplication::processEvents();
    for (QWidget* each : std::initializer_list<QWidget*>{menus, button, bold, field, list, heading})
      EXPECT_NEAR(QFontInfo(each->font()).pointSizeF(), pt, 0.5)
          << each->metaObject()->className() << " at " << pt << " pt";
    EXPECT_NEAR(caption->font().pointSizeF(), captionPt * pt / before, 0.5) << pt;
    EXPECT_TRUE(bold->font().bold());
  }
  EXPECT_GT(button->sizeHint().height(), small.height());
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    applyTheme(*qApp, theme);
    QCoreApplication::processEvents();
    for (QWidget* each : std::initializer_list<QWidget*>{menus, button, bold, field, list, heading})
      EXPECT_NEAR(QFontInfo(each->font()).pointSizeF(), 16, 0.5)
          << each->metaObject()->className() << " in the theme";
    EXPECT_NEAR(caption->font().pointSizeF(), captionPt * 16 / before, 0.5);
    EXPECT_TRUE(bold->font().bold());
  }
  applyTextPt(0);
  QCoreApplication::processEvents();
  EXPECT_EQ(button->sizeHint(), small);
}

// The entry of a box that is chosen, and the others of its list.
TEST(Theme, EachEntryOfABoxCanBeRead) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    applyTheme(*qApp, theme);
    QComboBox box;
    box.addItems({"first entry", "second entry"});
    box.setCurrentIndex(1);
    box.show();
    box.showPopup();
    QCoreApplication::processEvents();
    QAbstractItemView& list = *box.view();
    const QImage image = list.viewport()->grab().toImage();
    for (int row = 0; row < box.count(); ++row) {
      const QRect room = list.visualRect(box.model()->index(row, 0)).adjusted(3, 3, -3, -3);
      int darkest = 255, lightest = 0;
      for (int y = room.top(); y <= room.bottom(); ++y)
        for (int x = room.left(); x <= room.right(); ++x) {
          const int lightness = image.pixelColor(x, y).lightness();
          darkest = std::min(darkest, lightness);
          lightest = std::max(lightest, lightness);
        }
      EXPECT_GT(lightest - darkest, 100) << "entry " << row;
    }
    box.hidePopup();
  }
  applyTheme(*qApp, Theme::kDark);
}

}  // namespace
}  // namespace palpate::gui::text_size_test
