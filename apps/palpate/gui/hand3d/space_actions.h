// The actions of the hand in space.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {

struct SpaceActions {
  explicit SpaceActions(ActionRegistry& book);

  // Checked: the view is visible; one of the two always is.
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
  // Left, right, up, down.
  QList<QAction*> orbits;
  // Left, right, up, down.
  QList<QAction*> pans;
  // The whole hand, then each matrix alone.
  QList<QAction*> onlys;
};

}  // namespace palpate::gui
