// Enables and disables the actions of the window: every action has a condition, and refresh()
// evaluates all conditions when the displayed source changes.
#pragma once

#include <QAction>
#include <QList>
#include <QString>
#include <functional>
#include <utility>
#include <vector>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

class ActionEnabler {
 public:
  // The actions must outlive this object. `whyNot` says what is missing while the condition is
  // false, in one line (whyGreyed()).
  void add(const QList<QAction*>& actions,
           std::function<bool()> condition,
           const QString& whyNot = {}) {
    all_.push_back({actions, std::move(condition), whyNot});
  }
  // Shows actions only while the condition is true; hidden ones are disabled.
  void show(const QList<QAction*>& actions, std::function<bool()> condition) {
    shown_.push_back({actions, std::move(condition), {}});
  }
  void clear() {
    all_.clear();
    shown_.clear();
  }
  void refresh() const {
    for (const Conditional& each : all_) {
      const bool possible = each.condition();
      for (QAction* action : each.actions) {
        action->setEnabled(possible);
        if (!each.whyNot.isEmpty()) setWhyGreyed(*action, possible ? QString() : each.whyNot);
      }
    }
    for (const Conditional& each : shown_) {
      const bool shown = each.condition();
      for (QAction* action : each.actions) action->setVisible(shown);
    }
  }

 private:
  struct Conditional {
    QList<QAction*> actions;
    std::function<bool()> condition;
    QString whyNot;
  };
  std::vector<Conditional> all_;
  std::vector<Conditional> shown_;
};

}  // namespace palpate::gui
