// The feature that plays the shown recording: the bar below the views, speeds and keys.
#pragma once

#include "gui/playback/playback_actions.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class PlaybackBar;

class PlaybackFeature : public Feature {
  Q_OBJECT
 public:
  PlaybackFeature(WindowState& windowState, QWidget* window);

  std::vector<CentralViewSpec> centre() override;
  void start() override;
  void remember() override;

 private:
  void connectActions();
  void showState();

  PlaybackActions actions_;
  PlaybackBar* bar_;
  // Whether the user switched the loop on; the loop of the demo is not stored.
  bool userLoops_ = false;
};

}  // namespace palpate::gui
