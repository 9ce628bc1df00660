// The hand in space, beside the heat maps: what it shows of the moment, how it looks, one selection
// and one range of colours with them.
#pragma once

#include <functional>

#include "gui/bench/feature.h"
#include "gui/space/hand_look.h"
#include "gui/space/space_actions.h"

namespace palpate::gui {

class HandPanel;
class MatricesPanel;

class SpaceFeature : public Feature {
  Q_OBJECT
 public:
  // `matrices`: beside it, one of both is always seen.
  SpaceFeature(Bench& bench, QWidget* window, MatricesPanel& matrices);

  HandPanel& panel() noexcept { return *panel_; }
  std::vector<CentreOffer> centre() override;
  std::vector<ExportedView> views() override;
  void start() override;
  void remember() override;

 private:
  void connectMoment();
  void connectLook();
  void connectCamera();
  void takeSource();
  void showMoment();
  void changeLook(const std::function<void(HandLook&)>& change);
  void showLook();
  void showViews(bool matrices, bool hand);

  SpaceActions actions_;
  MatricesPanel& matrices_;
  HandPanel* panel_;
};

}  // namespace palpate::gui
