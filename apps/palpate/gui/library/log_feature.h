// The dock Log: what the window said today. It stays as it is, whatever else is shown.
#pragma once

#include "gui/bench/feature.h"

namespace palpate::gui {

class LogPanel;

class LogFeature : public Feature {
  Q_OBJECT
 public:
  LogFeature(Bench& bench, QWidget* window);

  std::vector<DockOffer> docks() override;

 private:
  LogPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
