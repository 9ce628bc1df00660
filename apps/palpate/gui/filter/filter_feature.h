// The feature with the dock Filter: edits the chain of filters that the shown source passes
// through, and switches it on and off.
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

  // Checked while the filtered values are shown.
  QAction* action_;
  FilterPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
