// The dock Inspect: the moment and the recording (or the link) in numbers, and which rows are
// plotted.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class InspectPanel;

class InspectFeature : public Feature {
  Q_OBJECT
 public:
  InspectFeature(WindowState& windowState, QWidget* window);

  InspectPanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;

 private:
  void makeActions();
  void takeSource();
  void showLinkFacts();
  void showForces();
  void showPlotted();

  QList<QAction*> plots_;        // a matrix: the first nine, then the whole hand
  std::vector<bool> liveTicks_;  // of the rows of what is connected; none: it was not looked at yet
  InspectPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
