// The feature that plays the shown recording: the bar below the views, speeds and keys.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that play a recording.
struct PlaybackActions {
  explicit PlaybackActions(ActionRegistry& book);

  QAction* play = nullptr;
  QAction* stepBack = nullptr;
  QAction* stepForward = nullptr;
  QAction* tenBack = nullptr;
  QAction* tenForward = nullptr;
  QAction* toStart = nullptr;
  QAction* toEnd = nullptr;
  QAction* goToFrame = nullptr;
  QAction* faster = nullptr;
  QAction* slower = nullptr;
  QAction* loop = nullptr;
  QAction* skipGaps = nullptr;
  QActionGroup* speeds = nullptr;
};

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
