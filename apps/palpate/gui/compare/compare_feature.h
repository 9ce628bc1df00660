// The feature that compares two open recordings. A is the recording that is shown and played.
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

  // Checked while two recordings are compared.
  QAction* action_;
  ComparePanel* panel_;
};

}  // namespace palpate::gui
