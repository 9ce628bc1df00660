// Sets which taxels the connected hand scans, according to the selected taxels.
#pragma once

#include <QObject>
#include <future>
#include <vector>

#include <palpate/control/tactile_masks.h>
#include <palpate/device/device.h>

#include "gui/window_state/window_state.h"

namespace palpate::gui {

struct MatricesActions;

class ScanChoice : public QObject {
  Q_OBJECT
 public:
  // Both must outlive this object.
  ScanChoice(WindowState& windowState, const MatricesActions& actions);

 private:
  void scan(MaskChoice choice);
  void takeAnswers();

  WindowState& windowState_;
  // Answers that the hand hasn't given yet.
  std::vector<std::shared_future<CommandAnswer>> answers_;
};

}  // namespace palpate::gui
