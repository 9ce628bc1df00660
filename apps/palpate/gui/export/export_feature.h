// The feature that exports pictures, tables and movies of the views that the other features offer.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>

#include "gui/export/export_controller.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that export or copy views.
struct ExportActions {
  explicit ExportActions(ActionRegistry& book);

  QAction* exportPicture = nullptr;
  QAction* exportAgain = nullptr;
  QAction* copyPicture = nullptr;
  QAction* copyTable = nullptr;
};

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
