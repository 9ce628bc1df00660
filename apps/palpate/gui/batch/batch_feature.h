// The feature that makes files of many recordings: its dialog, and the batch that runs in the
// background, also while the dialog is closed.
#pragma once

#include <QAction>

#include "gui/batch/batch_controller.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class BatchDialog;
class OpeningStrip;

class BatchFeature : public Feature {
  Q_OBJECT
 public:
  BatchFeature(WindowState& windowState, QWidget* window);
  ~BatchFeature() override;

  std::vector<BannerSpec> strips() override;
  // Ends a running batch; what is finished stays.
  void remember() override;
  BatchController& controller() noexcept { return controller_; }
  // Null before the dialog was asked for the first time.
  BatchDialog* dialog() noexcept { return dialog_; }

 private:
  void showDialog();
  void begin();
  void report();

  QAction* batch_;
  OpeningStrip* strip_;
  BatchDialog* dialog_ = nullptr;
  BatchController controller_;
};

}  // namespace palpate::gui
