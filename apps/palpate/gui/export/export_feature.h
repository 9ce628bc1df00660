// The feature that exports pictures, tables and movies of the views that the other features offer.
#pragma once

#include "gui/export/export_actions.h"
#include "gui/export/export_controller.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class OpeningStrip;

class ExportFeature : public Feature {
  Q_OBJECT
 public:
  ExportFeature(WindowState& windowState, QWidget* window);

  ExportController& exportController() noexcept { return exportController_; }
  std::vector<BannerSpec> strips() override;

 private:
  ExportActions actions_;
  ExportController exportController_;
  OpeningStrip* strip_;
};

}  // namespace palpate::gui
