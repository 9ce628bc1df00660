// Enables and disables the actions of the window: every action has a condition, and refresh()
// evaluates all conditions when the displayed source changes.
#pragma once

#include <QAction>
#include <QList>
#include <functional>
#include <utility>
#include <vector>

namespace palpate::gui {

class ActionEnabler {
 public:
  // The actions must outlive this object.
  void add(const QList<QAction*>& actions, std::function<bool()> condition) {
    all_.emplace_back(actions, std::move(condition));
  }
  void clear() { all_.clear(); }
  void refresh() const {
    for (const auto& [actions, condition] : all_) {
      const bool possible = condition();
      for (QAction* action : actions) action->setEnabled(possible);
    }
  }

 private:
  std::vector<std::pair<QList<QAction*>, std::function<bool()>>> all_;
};

}  // namespace palpate::gui
