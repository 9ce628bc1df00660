// The feature of the hand in 3-D, beside the heat maps: shows the current frame, and shares
// selection and colour range with the heat maps.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <functional>

#include "gui/hand3d/hand_look.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions of the hand in 3-D.
struct Hand3dActions {
  explicit Hand3dActions(ActionRegistry& book);

  // Checked: the view is visible; one of the two always is.
  QAction* matricesShown = nullptr;
  QAction* handShown = nullptr;
  QActionGroup* taxelShapes = nullptr;
  QActionGroup* spheres = nullptr;
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

class HandPanel;
class MatricesPanel;

class Hand3dFeature : public Feature {
  Q_OBJECT
 public:
  // `matrices`: the heat maps beside it; one of the two views is always visible.
  Hand3dFeature(WindowState& windowState, QWidget* window, MatricesPanel& matrices);

  HandPanel& panel() noexcept { return *panel_; }
  std::vector<CentralViewSpec> centre() override;
  std::vector<ExportedView> views() override;
  void start() override;
  void remember() override;

 private:
  void connectMoment();
  void connectLook();
  void connectCamera();
  void takeSource();
  void showMoment();
  void changeLook(const std::function<void(HandLook&)>& change);
  void showLook();
  void showViews(bool matrices, bool hand);

  Hand3dActions actions_;
  MatricesPanel& matrices_;
  HandPanel* panel_;
};

}  // namespace palpate::gui
