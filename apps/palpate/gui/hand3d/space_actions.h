// What the hand in space does, as actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct SpaceActions {
  explicit SpaceActions(ActionRegistry& book);

  // checked: the heat maps are seen; one of both always is
  QAction* matricesShown = nullptr;
  QAction* handShown = nullptr;
  QAction* nextTaxelShape = nullptr;
  QAction* nextSphere = nullptr;
  QAction* sphereOfCentroids = nullptr;
  QAction* normals = nullptr;
  QAction* contacts = nullptr;
  QAction* wire = nullptr;
  QAction* axes = nullptr;
  QAction* slipArrows = nullptr;
  QAction* fitHand = nullptr;
  QAction* resetHand = nullptr;
  QAction* nearer = nullptr;
  QAction* further = nullptr;
  // left, right, up, down
  QList<QAction*> orbits;
  // the same
  QList<QAction*> pans;
  // the whole hand, then one matrix alone
  QList<QAction*> onlys;
};

}  // namespace palpate::gui
