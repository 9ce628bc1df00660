// The feature with the dock Hand; it also reports which matrices of the connected hand cannot
// detect the limit of its grasps.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that move the connected hand; they do the same as the buttons of the dock Hand.
struct HandActions {
  explicit HandActions(ActionRegistry& book);

  QAction* graspHand = nullptr;
  QAction* reactiveGrasp = nullptr;
  QAction* slipAwareGrasp = nullptr;
  QAction* openHand = nullptr;
  QAction* relaxHand = nullptr;
  // Esc does the same, whichever window has the keyboard focus.
  QAction* stopHand = nullptr;
  // Enabled while a protection has ended that nobody has acknowledged.
  QAction* acknowledgeHand = nullptr;
};

class HandDock;

class HandFeature : public Feature {
  Q_OBJECT
 public:
  HandFeature(WindowState& windowState, QWidget* window);
  ~HandFeature() override;

  HandDock& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;

 private:
  HandActions actions_;
  HandDock* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
