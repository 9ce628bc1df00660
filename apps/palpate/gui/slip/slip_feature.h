// The dock Slip: whose slip it shows, what of it stands below the timeline and on the hand in
// space.
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

  QAction* reference_;  // slip is measured from the frame that is shown
  SlipPanel* panel_;
  Dock* dock_;
  const void* liveOf_ = nullptr;  // the source whose hand the panel has
};

}  // namespace palpate::gui
