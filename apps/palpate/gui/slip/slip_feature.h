// The feature with the dock Slip: gives it its source, and shows its results in the timeline and on
// the hand in 3-D.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class SlipPanel;

class SlipFeature : public Feature {
  Q_OBJECT
 public:
  SlipFeature(WindowState& windowState, QWidget* window);

  SlipPanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;
  void settle() override;

 private:
  void connectBench();
  void takeSource();
  void takeLook();
  void showLive(const LiveResults& results);
  void showArrows();
  void setUpStage();

  // Makes the shown frame the reference of slip.
  QAction* reference_;
  SlipPanel* panel_;
  Dock* dock_;
  // The live source whose hand the panel shows.
  const void* liveOf_ = nullptr;
};

}  // namespace palpate::gui
