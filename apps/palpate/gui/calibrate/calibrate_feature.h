// The dock Calibrate: what it is given of the recording that is looked at, what it keeps with it
// and applies to the hand.
#pragma once

#include <QPointer>
#include <memory>
#include <optional>
#include <string>

#include "gui/calibrate/applied_calibration.h"
#include "gui/calibrate/pressures.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class CalibratePanel;

class CalibrateFeature : public Feature {
  Q_OBJECT
 public:
  CalibrateFeature(WindowState& windowState, QWidget* window);

  CalibratePanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;
  void settle() override;

 private:
  void connectPages();
  void connectNoise();
  void takeSource();
  void takeKept();
  void apply(const QString& path);
  void filterGhosts(bool on);
  void zoomTo(double fromS, double toS);

  CalibratePanel* panel_;
  Dock* dock_;
  std::unique_ptr<Pressures> pressures_;
  struct Filters {
    Recipe recipe;
    bool on = false;
  };
  std::optional<Filters> filtersBefore_;  // high sensitivity began
};

}  // namespace palpate::gui
