// The feature with the dock Hand; it also reports which matrices of the connected hand cannot
// detect the limit of its grasps.
#pragma once

#include "gui/hand/hand_actions.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

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
