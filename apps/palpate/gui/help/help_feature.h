// The list of keys, and what Palpate is.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class HelpFeature : public Feature {
  Q_OBJECT
 public:
  HelpFeature(WindowState& windowState, QWidget* window);
};

}  // namespace palpate::gui
