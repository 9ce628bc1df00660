// What the window is connected to: the dialogue, the menu of the button Connect, showing live,
// holding the picture.
#pragma once

#include "gui/connect/connect_actions.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class ConnectFeature : public Feature {
  Q_OBJECT
 public:
  ConnectFeature(WindowState& windowState, QWidget* window);

 private:
  void addQuestions();
  void connectActions();
  void fillMenu();
  std::filesystem::path scenesFolder() const;

  ConnectActions actions_;
};

// An emulated hand before a ball; `acts`: it grasps by itself.
Connection emulatedBallConnection(bool runsScript);

}  // namespace palpate::gui
