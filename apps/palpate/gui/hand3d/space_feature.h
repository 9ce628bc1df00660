// The feature of the hand in space, beside the heat maps: shows the current frame, and shares
// selection and colour range with the heat maps.
#pragma once

#include <functional>

#include "gui/hand3d/hand_look.h"
#include "gui/hand3d/space_actions.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class HandPanel;
class MatricesPanel;

class SpaceFeature : public Feature {
  Q_OBJECT
 public:
  // `matrices`: the heat maps beside it; one of the two views is always visible.
  SpaceFeature(WindowState& windowState, QWidget* window, MatricesPanel& matrices);

  HandPanel& panel() noexcept { return *panel_; }
  std::vector<CentralViewSpec> centre() override;
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
