// The dock Log: what the window said today. It stays as it is, whatever else is shown.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class LogPanel;

class LogFeature : public Feature {
  Q_OBJECT
 public:
  LogFeature(WindowState& windowState, QWidget* window);

  std::vector<DockSpec> docks() override;

 private:
  LogPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
