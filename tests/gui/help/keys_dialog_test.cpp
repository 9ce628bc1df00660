#include "gui/help/keys_dialog.h"

#include <QLabel>
#include <QMenu>
#include <algorithm>
#include <set>

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
    if (action->shortcuts().isEmpty() || !action->isVisible()) continue;
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
  EXPECT_EQ(kinds.size(), 3u);
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
  QApplication::setActiveWindow(dialog);
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_FALSE(dialog->isVisible());
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
