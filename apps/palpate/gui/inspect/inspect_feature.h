// The feature of the dock Inspect: shows the current frame and the recording (or the connection) in
// numbers, and which rows are plotted.
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
  void showStale();
  void showForces();
  void showPlotted();

  // Actions that plot a matrix, for the first nine; then the whole hand.
  QList<QAction*> plots_;
  // Which rows of the live source are plotted; empty: it wasn't shown yet.
  std::vector<bool> liveTicks_;
  InspectPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
