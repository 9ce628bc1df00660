#include "gui/window_state/action_registry.h"

#include <stdexcept>

namespace palpate::gui {
namespace {

constexpr const char* kSectionProperty = "section";
constexpr const char* kKindProperty = "kind";
constexpr const char* kNoMenuProperty = "noMenu";
constexpr const char* kKindKeysProperty = "kindKeys";
constexpr const char* kWhyGreyedProperty = "whyGreyed";

template <class Value>
const Value& known(const std::map<QString, Value>& all, const QString& id) {
  const auto at = all.find(id);
  if (at == all.end()) throw std::out_of_range("ActionRegistry: no '" + id.toStdString() + "'");
  return at->second;
}

}  // namespace

QString sectionOf(const QAction& action) { return action.property(kSectionProperty).toString(); }

void setSection(QAction& action, const QString& section) {
  action.setProperty(kSectionProperty, section);
}

void setKind(const QList<QAction*>& actions, const QString& keys, const QString& what) {
  for (QAction* action : actions) {
    action->setProperty(kKindProperty, what);
    action->setProperty(kKindKeysProperty, keys);
  }
}

std::optional<ActionKind> kindOf(const QAction& action) {
  const QString what = action.property(kKindProperty).toString();
  if (what.isEmpty()) return std::nullopt;
  return ActionKind{action.property(kKindKeysProperty).toString(), what};
}

void hideInMenus(QAction& action) { action.setProperty(kNoMenuProperty, true); }

bool isHiddenInMenus(const QAction& action) { return action.property(kNoMenuProperty).toBool(); }

void setWhyGreyed(QAction& action, const QString& why) {
  action.setProperty(kWhyGreyedProperty, why);
}

QString whyGreyed(const QAction& action) { return action.property(kWhyGreyedProperty).toString(); }

QString plainText(const QAction& action) {
  QString text = action.text();
  text.remove('&');
  text.remove("…");
  return text;
}

QAction* ActionRegistry::made(const char* section,
                              const QString& text,
                              const QList<QKeySequence>& keys,
                              bool checkable) {
  auto* action = new QAction(text, window_);
  action->setShortcuts(keys);
  action->setCheckable(checkable);
  setSection(*action, section);
  if (!keys.isEmpty())
    action->setToolTip(plainText(*action) + " (" + keys.first().toString(QKeySequence::NativeText) +
                       ")");
  window_->addAction(action);
  return action;
}

QAction* ActionRegistry::make(const QString& id,
                              const char* section,
                              const QString& text,
                              const QList<QKeySequence>& keys,
                              bool checkable) {
  if (actions_.contains(id))
    throw std::logic_error("ActionRegistry: two actions are called '" + id.toStdString() + "'");
  made_.append(made(section, text, keys, checkable));
  return actions_[id] = made_.last();
}

QAction* ActionRegistry::add(const QString& list,
                             const char* section,
                             const QString& text,
                             const QList<QKeySequence>& keys,
                             bool checkable) {
  lists_[list].append(made(section, text, keys, checkable));
  return lists_[list].last();
}

QActionGroup* ActionRegistry::choices(const QString& id, const QStringList& names) {
  auto* group = new QActionGroup(window_);
  for (const QString& name : names) {
    auto* action = new QAction(name, group);
    action->setCheckable(true);
    action->setData(group->actions().size() - 1);
  }
  return groups_[id] = group;
}

QAction* ActionRegistry::at(const QString& id) const { return known(actions_, id); }

const QList<QAction*>& ActionRegistry::all(const QString& list) const {
  return known(lists_, list);
}

QActionGroup* ActionRegistry::group(const QString& id) const { return known(groups_, id); }

}  // namespace palpate::gui
