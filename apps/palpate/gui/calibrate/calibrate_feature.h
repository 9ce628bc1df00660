// The feature with the dock Calibrate: gives its pages the recording that is shown, keeps their
// results as events of the recording, and applies calibrations and noise floors to the hand.
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
  void connectLive();
  void keepTare();
  void takeSource();
  void takeKept();
  void apply(const QString& path);
  void filterGhosts(bool on);
  void zoomTo(double fromS, double toS);

  CalibratePanel* panel_;
  Dock* dock_;
  // Its dock was closed since the steps were found.
  bool stepsHidden_ = false;
  CalibrationCache* calibrations_;
  std::unique_ptr<Pressures> pressures_;
};

}  // namespace palpate::gui
