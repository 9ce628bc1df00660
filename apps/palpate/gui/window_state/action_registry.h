// Holds the actions of the window: the features make their actions here, with keys; the menus, the
// toolbar and the list of keys (F1) are built from all of them.
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
  // So many matrices have actions of their own; further ones have none.
  static constexpr int kListedMatrices = 9;

  // The actions belong to the window; their keys work wherever in the window the keyboard focus is.
  explicit ActionRegistry(QWidget* window) : window_(window) {}

  // `id`: name by which other code finds the action; `section`: its section in the list of keys.
  // Throws std::logic_error for an id that exists already.
  QAction* make(const QString& id,
                const char* section,
                const QString& text,
                const QList<QKeySequence>& keys = {},
                bool checkable = false);
  // Makes one more action of a group of similar actions; `list` names the group.
  QAction* add(const QString& list,
               const char* section,
               const QString& text,
               const QList<QKeySequence>& keys = {},
               bool checkable = false);
  // A group of actions of which one is checked at a time; data() of an action is its index. They
  // have no keys.
  QActionGroup* choices(const QString& id, const QStringList& names);

  // All three throw std::out_of_range for an id that doesn't exist.
  QAction* at(const QString& id) const;
  const QList<QAction*>& all(const QString& list) const;
  QActionGroup* group(const QString& id) const;
  // The actions of make(), in the order in which they were made.
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
};

// The key sequence of an action, for example "Ctrl+O".
inline QKeySequence key(const char* text) { return QKeySequence(QString(text)); }
// Checks the action of `group` whose index is that of `now` in `all`.
template <class Choices, class Choice>
void checkChoice(const QActionGroup* group, const Choices& all, Choice now) {
  qsizetype index = 0;
  for (const auto& each : all) {
    if (each == now && index < group->actions().size())
      group->actions().at(index)->setChecked(true);
    ++index;
  }
}

// Property of the action "record": true while the action would stop a recording.
inline constexpr const char* kRecordingProperty = "recording";
// Property of the action "record": whether its text names what the plan says.
inline constexpr const char* kPlannedProperty = "planned";

// The section of the list of keys to which an action belongs ("File", ..); empty: the action isn't
// listed.
QString sectionOf(const QAction& action);
void setSection(QAction& action, const QString& section);
// Similar actions that share one line in the list of keys.
struct ActionKind {
  QString keys;  // "Ctrl+arrows"
  QString what;
};
void setKind(const QList<QAction*>& actions, const QString& keys, const QString& what);
std::optional<ActionKind> kindOf(const QAction& action);
// Keeps the action out of the menus; its key still works.
void hideInMenus(QAction& action);
bool isHiddenInMenus(const QAction& action);
// Why the action is greyed, in one line; empty: it is enabled, or no reason is known.
void setWhyGreyed(QAction& action, const QString& why);
QString whyGreyed(const QAction& action);
// The text of the action without mnemonic and dots.
QString plainText(const QAction& action);

}  // namespace palpate::gui
