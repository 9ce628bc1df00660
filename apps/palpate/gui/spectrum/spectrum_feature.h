// The feature with the dock Spectrum: shows the spectrogram of the chosen taxels of the shown
// recording, with the visible time span of the timeline.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class SpectrumPanel;

class SpectrumFeature : public Feature {
  Q_OBJECT
 public:
  SpectrumFeature(WindowState& windowState, QWidget* window);

  SpectrumPanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;
  void settle() override;

 private:
  void connectChart();
  void takeSource();
  void takeTaxels();
  void takeSight();
  void takeLook();

  SpectrumPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
