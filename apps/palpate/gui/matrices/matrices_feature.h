// The feature of the heat maps in the centre of the window: shows the current frame, the selected
// taxels, and which taxels the hand scans.
#pragma once

#include "gui/matrices/matrices_actions.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/matrices/scan_choice.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class MatricesPanel;

class MatricesFeature : public Feature {
  Q_OBJECT
 public:
  MatricesFeature(WindowState& windowState, QWidget* window);

  MatricesPanel& panel() noexcept { return *panel_; }
  std::vector<CentralViewSpec> centre() override;
  std::vector<ExportedView> views() override;

 private:
  void connectLook();
  void connectChosen();
  void takeSource();

  MatricesActions actions_;
  MatricesPanel* panel_;
  ScanChoice scan_;
};

// Title, caption and look for a picture of the displayed frame.
MatricesPictureOptions pictureOptions(const WindowState& windowState, const MatricesPanel& panel);

}  // namespace palpate::gui
