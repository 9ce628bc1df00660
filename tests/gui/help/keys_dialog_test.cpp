#include "gui/help/keys_dialog.h"

#include <QLabel>
#include <QMenu>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>
#include <set>

#include "gui/appearance/text_size.h"
#include "gui/testing/make_active.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::keys_dialog_test {
namespace {

class KeysDialogTest : public WindowTest {
 protected:
  KeysDialogTest() { open({"good.dsa"}); }
};

TEST_F(KeysDialogTest, ListsEveryKeyOfEveryAction) {
  const auto entries = keysOf(window().actions());
  int withKeys = 0;
  std::set<QString> kinds;
  for (const QAction* action : window().actions()) {
    if (action->shortcuts().isEmpty()) continue;
    if (const auto kind = kindOf(*action)) {
      const auto line = std::count_if(entries.begin(), entries.end(), [&](const KeyEntry& each) {
        return each.what == kind->what && each.keys == kind->keys;
      });
      EXPECT_EQ(line, 1) << action->text().toStdString();
      kinds.insert(kind->what);
      continue;
    }
    ++withKeys;
    const auto entry = std::find_if(entries.begin(), entries.end(), [&](const KeyEntry& each) {
      return each.what == plainText(*action);
    });
    ASSERT_NE(entry, entries.end()) << action->text().toStdString();
    for (const QKeySequence& key : action->shortcuts())
      EXPECT_TRUE(entry->keys.split(" or ").contains(key.toString(QKeySequence::NativeText)))
          << action->text().toStdString();
  }
  EXPECT_EQ(entries.size(), static_cast<std::size_t>(withKeys) + kinds.size());
  EXPECT_EQ(kinds.size(), 1u);
  EXPECT_GT(withKeys, 35);
}

TEST_F(KeysDialogTest, FollowsAChangedKey) {
  actions().at("play")->setShortcut(QKeySequence("P"));
  const auto entries = keysOf(window().actions());
  EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [](const KeyEntry& entry) {
    return entry.what == "Play or pause" && entry.keys == "P";
  }));
}

TEST_F(KeysDialogTest, ShowsTheListAndTheMouse) {
  press(Qt::Key_F1);
  auto* dialog = window().findChild<KeysDialog*>();
  ASSERT_NE(dialog, nullptr);
  QStringList texts;
  for (const QLabel* label : dialog->findChildren<QLabel*>()) texts.append(label->text());
  for (const KeyEntry& entry : keysOf(window().actions())) {
    EXPECT_TRUE(texts.contains(entry.keys)) << entry.keys.toStdString();
    EXPECT_TRUE(texts.contains(entry.what)) << entry.what.toStdString();
  }
  EXPECT_TRUE(texts.contains("Wheel"));
  makeActive(*dialog);
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_FALSE(dialog->isVisible());
}

// Only upwards and downwards, also on a small screen and with large text.
TEST_F(KeysDialogTest, IsNotScrolledSideways) {
  for (const int pt : {0, 12, 15, kMaxInterfaceTextPt})
    for (const QSize size : {QSize(1024, 768), QSize(1280, 800), QSize(1366, 768)}) {
      applyTextPt(pt);
      window().resize(size);
      QCoreApplication::processEvents();
      KeysDialog dialog(window().actions(), &window());
      dialog.show();
      for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
      EXPECT_LE(dialog.width(), size.width());
      EXPECT_EQ(dialog.findChild<QScrollArea*>()->horizontalScrollBar()->maximum(), 0)
          << pt << " pt at " << size.width();
    }
  applyTextPt(0);
}

TEST_F(KeysDialogTest, EveryMenuEntryIsAnActionOfTheWindow) {
  // What stands in a menu with a key works wherever the keyboard is in the window.
  for (const QMenu* menu : window().findChildren<QMenu*>())
    for (QAction* action : menu->actions())
      if (!action->shortcuts().isEmpty()) {
        EXPECT_TRUE(window().actions().contains(action)) << action->text().toStdString();
      }
}

}  // namespace
}  // namespace palpate::gui::keys_dialog_test
