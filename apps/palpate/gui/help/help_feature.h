// The list of keys, and what Palpate is.
#pragma once

#include "gui/bench/feature.h"

namespace palpate::gui {

class HelpFeature : public Feature {
  Q_OBJECT
 public:
  HelpFeature(Bench& bench, QWidget* window);
};

}  // namespace palpate::gui
