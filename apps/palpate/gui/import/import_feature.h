// The feature that imports tables of other programs: its dialog, and the worker that writes the
// recording.
#pragma once

#include <QAction>

#include "gui/import/import_request.h"
#include "gui/source/background_job.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class OpeningStrip;

class ImportFeature : public Feature {
  Q_OBJECT
 public:
  ImportFeature(WindowState& windowState, QWidget* window);

  std::vector<BannerSpec> strips() override;
  // Starts an import in the worker.
  void importNow(const ImportRequest& request);
  bool busy() const { return job_.busy(); }

 private:
  void askAndImport();

  QAction* import_;
  OpeningStrip* strip_;
  BackgroundJob job_;
};

}  // namespace palpate::gui
