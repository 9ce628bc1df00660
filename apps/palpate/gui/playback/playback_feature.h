// Plays the recording that is looked at: the bar below the views, speeds, keys.
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
  bool userLoops_ = false;  // as chosen by hand: the demo's loop is not remembered
};

}  // namespace palpate::gui
