// Two recordings instead of one. A is the recording that is looked at and played.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class ComparePanel;

class CompareFeature : public Feature {
  Q_OBJECT
 public:
  CompareFeature(WindowState& windowState, QWidget* window);

  ComparePanel& panel() noexcept { return *panel_; }
  std::vector<CentralViewSpec> centre() override;
  std::vector<ExportedView> views() override;
  void start() override;

 private:
  void connectPanel();
  void connectBench();
  void show(bool on);
  void seek(double seconds);

  QAction* action_;  // checked: two recordings are compared
  ComparePanel* panel_;
};

}  // namespace palpate::gui
