// The feature of the heat maps in the centre of the window: shows the current frame, the selected
// taxels, and which taxels the hand scans.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/matrices/matrices_painter.h"
#include "gui/matrices/scan_choice.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions of the heat maps, including those that choose which taxels the hand scans.
struct MatricesActions {
  explicit MatricesActions(ActionRegistry& book);

  QAction* interpolated = nullptr;
  QAction* values = nullptr;
  // Set the mask of scanned taxels from the selected taxels.
  QAction* scanOnly = nullptr;
  QAction* scanOnlyInTheirMatrices = nullptr;
  QAction* scanWithout = nullptr;
  QAction* scanAlso = nullptr;
  QAction* scanAll = nullptr;
  QAction* chooseNone = nullptr;
  QActionGroup* maps = nullptr;
  QActionGroup* ranges = nullptr;
};

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
