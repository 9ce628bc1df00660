// The dock Hand, and which matrices of the connected hand can't feel the limit of its grasps.
#pragma once

#include "gui/bench/feature.h"
#include "gui/hand/hand_actions.h"

namespace palpate::gui {

class HandDock;

class HandFeature : public Feature {
  Q_OBJECT
 public:
  HandFeature(Bench& bench, QWidget* window);
  ~HandFeature() override;

  HandDock& panel() noexcept { return *panel_; }
  std::vector<DockOffer> docks() override;

 private:
  HandActions actions_;
  HandDock* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
