// Which taxels the connected hand scans, from those that are chosen.
#pragma once

#include <QObject>
#include <future>
#include <vector>

#include <palpate/control/tactile_masks.h>
#include <palpate/device/device.h>

#include "gui/matrices/matrices_actions.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class ScanChoice : public QObject {
  Q_OBJECT
 public:
  // Both must outlive it.
  ScanChoice(WindowState& windowState, const MatricesActions& actions);

 private:
  void scan(MaskChoice choice);
  void takeAnswers();

  WindowState& windowState_;
  std::vector<std::shared_future<CommandAnswer>> answers_;  // that the hand hasn't given yet
};

}  // namespace palpate::gui
