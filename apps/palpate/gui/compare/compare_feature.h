// Two recordings instead of one. A is the recording that is looked at and played.
#pragma once

#include "gui/bench/feature.h"

namespace palpate::gui {

class ComparePanel;

class CompareFeature : public Feature {
  Q_OBJECT
 public:
  CompareFeature(Bench& bench, QWidget* window);

  ComparePanel& panel() noexcept { return *panel_; }
  std::vector<CentreOffer> centre() override;
  std::vector<ExportedView> views() override;
  void start() override;

 private:
  void connectPanel();
  void connectBench();
  void show(bool on);
  void seek(double seconds);

  QAction* action_;  // checked: two recordings are compared
  ComparePanel* panel_;
};

}  // namespace palpate::gui
