// The actions of the window: features make theirs here, with keys, and menus, toolbar and the list
// of keys (F1) are made from all of them.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QKeySequence>
#include <QList>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gui/appearance/icons.h"
#include "gui/appearance/theme.h"

namespace palpate::gui {

class ActionRegistry {
 public:
  static constexpr int kMatricesWithKeys = 9;  // the first ones have keys of their own

  // The actions belong to the window and work wherever the keyboard is in it.
  explicit ActionRegistry(QWidget* window) : window_(window) {}

  // `id`: how others name it; `section`: of the list of keys. Throws std::logic_error for an id
  // that is there already.
  QAction* make(const QString& id,
                const char* section,
                const QString& text,
                const QList<QKeySequence>& keys = {},
                bool checkable = false);
  // The next one of several that are alike.
  QAction* add(const QString& list,
               const char* section,
               const QString& text,
               const QList<QKeySequence>& keys = {},
               bool checkable = false);
  // Choices, one at a time; data() is the index. They have no keys.
  QActionGroup* choices(const QString& id, const QStringList& names);
  // In the colours of the theme, from the next setTheme() on.
  void setIcon(QAction* action, IconShape shape) { icons_.emplace_back(action, shape); }
  void setTheme(Theme theme);

  // Throw std::out_of_range for an id that nobody has made.
  QAction* at(const QString& id) const;
  const QList<QAction*>& all(const QString& list) const;
  QActionGroup* group(const QString& id) const;
  // Of make(), in the order in which they were made.
  const QList<QAction*>& all() const noexcept { return made_; }

 private:
  QAction* made(const char* section,
                const QString& text,
                const QList<QKeySequence>& keys,
                bool checkable);

  QWidget* window_;
  std::map<QString, QAction*> actions_;
  QList<QAction*> made_;
  std::map<QString, QList<QAction*>> lists_;
  std::map<QString, QActionGroup*> groups_;
  std::vector<std::pair<QAction*, IconShape>> icons_;
};

// A key of an action: "Ctrl+O".
inline QKeySequence key(const char* text) { return QKeySequence(QString(text)); }
// The choice of a group that stands where `now` is among `all`.
template <class Choices, class Choice>
void checkChoice(const QActionGroup* group, const Choices& all, Choice now) {
  qsizetype index = 0;
  for (const auto& each : all) {
    if (each == now && index < group->actions().size())
      group->actions().at(index)->setChecked(true);
    ++index;
  }
}

// Of the action record: whether it would stop a recording.
inline constexpr const char* kRecordingProperty = "recording";

// The section of the list of keys that an action belongs to ("File", ..); empty: not listed.
QString sectionOf(const QAction& action);
void setSection(QAction& action, const QString& section);
// Actions that are alike, listed by one line for all of them.
struct ActionKind {
  QString keys;  // "Ctrl+arrows"
  QString what;
};
void setKind(const QList<QAction*>& actions, const QString& keys, const QString& what);
std::optional<ActionKind> kindOf(const QAction& action);
// It has a key and no line in a menu.
void hideInMenus(QAction& action);
bool isHiddenInMenus(const QAction& action);
// Its text without mnemonic and dots.
QString plainText(const QAction& action);

}  // namespace palpate::gui
