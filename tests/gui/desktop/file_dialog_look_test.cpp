#include "gui/desktop/file_dialog_look.h"

#include <QFileDialog>
#include <QHeaderView>
#include <QImage>
#include <QTest>
#include <QToolButton>
#include <QTreeView>

#include "testing/testing.h"

namespace palpate::gui::file_dialog_look_test {
namespace {

bool isGrey(const QIcon& icon) {
  const QImage image = icon.pixmap(32).toImage();
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const QColor color = image.pixelColor(x, y);
      if (color.alpha() > 0 && color.saturation() > 8) return false;
    }
  return !image.isNull();
}

TEST(FileDialogLook, ItsIconsHaveNoColoursAndItsColumnsAreWhole) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "2026-11-26_foam_ball_left_001.palpate", "x");
  const FileDialogLook look(nullptr);
  QFileDialog dialog(nullptr, "Open", QString::fromStdString(folder.path().string()));
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  dialog.setViewMode(QFileDialog::Detail);
  dialog.show();
  for (const auto* button : dialog.findChildren<QToolButton*>())
    EXPECT_TRUE(isGrey(button->icon())) << button->objectName().toStdString();
  EXPECT_TRUE(isGrey(dialog.iconProvider()->icon(QFileIconProvider::Folder)));
  EXPECT_TRUE(isGrey(dialog.iconProvider()->icon(QFileInfo(folder.path().c_str()))));
  auto* list = dialog.findChild<QTreeView*>("treeView");
  ASSERT_NE(list, nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->model()->rowCount(list->rootIndex()) == 1; }));
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return list->header()->length() <= list->viewport()->width(); }));
  const QModelIndex row = list->model()->index(0, 0, list->rootIndex());
  for (int column = 0; column < list->model()->columnCount(); ++column) {
    if (list->isColumnHidden(column)) continue;
    const QString text = row.siblingAtColumn(column).data().toString();
    EXPECT_LT(list->fontMetrics().horizontalAdvance(text), list->header()->sectionSize(column))
        << text.toStdString();
  }
}

}  // namespace
}  // namespace palpate::gui::file_dialog_look_test
