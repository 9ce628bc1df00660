// docs/manual/keys.md is the list that F1 shows, and docs/manual/docks.md knows every dock.
#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <set>

#include "gui/help/keys_dialog.h"
#include "gui/testing/window_fixture.h"
#include "testing/testing.h"

namespace palpate::gui::manual_keys_test {
namespace {

class ManualKeysTest : public WindowTest {
 protected:
  ManualKeysTest() { open({"good.dsa"}); }
  static std::string page(const char* name) {
    return testing::readFile(testing::dataFolder().parent_path() / "docs/manual" / name);
  }
};

// The dialogue's labels in order: a heading, or a key and what it does. As rows of the page.
std::vector<std::string> rowsOf(const KeysDialog& dialogue) {
  std::vector<std::string> rows;
  QString key;
  for (const QLabel* label : dialogue.findChildren<QLabel*>()) {
    const QString role = label->property("role").toString();
    if (role == "heading") continue;
    if (role == "muted")
      rows.push_back(("| " + key.replace('|', "\\|") + " | " + label->text() + " |").toStdString());
    else
      key = label->text();
  }
  return rows;
}

TEST_F(ManualKeysTest, ThePageOfKeysIsTheListOfF1) {
  const KeysDialog dialogue(window().actions(), nullptr);
  const std::string text = page("keys.md");
  std::set<std::string> told;
  for (const std::string& row : rowsOf(dialogue)) {
    EXPECT_NE(text.find(row + "\n"), std::string::npos) << "docs/manual/keys.md lacks: " << row;
    told.insert(row);
  }
  EXPECT_GT(told.size(), 80u);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("| ") && !line.starts_with("| key")) {
      EXPECT_TRUE(told.contains(line))
          << "docs/manual/keys.md tells of what F1 doesn't show: " << line;
    }
}

TEST_F(ManualKeysTest, KeysCanBeLearnt) {
  const std::vector<KeyEntry> keys = keysOf(window().actions());
  // One more than 90 for the baseline, which is taken again and again while both hands are busy.
  EXPECT_LE(keys.size(), 91u);
  EXPECT_GT(keys.size(), 60u);
  // A path that is typed without a field changes nothing that is shown: what its letters do is ask,
  // go to an event, and hold or mark the live picture.
  for (const KeyEntry& entry : keys)
    if (entry.keys.size() == 1 && entry.keys[0].isLetter()) {
      EXPECT_TRUE(QString("NPQ").contains(entry.keys)) << entry.keys.toStdString();
    }
}

TEST_F(ManualKeysTest, EveryDockIsDescribedWithItsKey) {
  const std::string text = page("docks.md");
  for (const QString& name : window().docks().names()) {
    EXPECT_NE(text.find("\n## " + name.toStdString() + "\n"), std::string::npos)
        << "docs/manual/docks.md has no section " << name.toStdString();
    const auto* dock = window().findChild<QDockWidget*>(name);
    ASSERT_NE(dock, nullptr) << name.toStdString();
    const std::string key = dock->toggleViewAction()->shortcut().toString().toStdString();
    const std::string row = "](#" + name.toLower().toStdString() + ") | " + key + " |";
    EXPECT_NE(text.find(row), std::string::npos) << "docs/manual/docks.md: no row " << row;
  }
}

}  // namespace
}  // namespace palpate::gui::manual_keys_test
