// The feature with the menu Help: the list of keys and the About dialog.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class HelpFeature : public Feature {
  Q_OBJECT
 public:
  HelpFeature(WindowState& windowState, QWidget* window);
};

}  // namespace palpate::gui
