// The feature with the dock Log, which lists today's messages of the window. The dock does not
// depend on the shown source.
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
