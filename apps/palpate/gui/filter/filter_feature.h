// The dock Filter: the chain that what is shown is seen through.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class FilterPanel;

class FilterFeature : public Feature {
  Q_OBJECT
 public:
  FilterFeature(WindowState& windowState, QWidget* window);

  FilterPanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;
  void settle() override { state().activeFilters.wait(); }

 private:
  void takeSource();

  QAction* action_;  // checked: filtered is what is shown
  FilterPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
