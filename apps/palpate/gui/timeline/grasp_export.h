// Saves each grasp of the displayed recording as a recording of its own, in the background.
#pragma once

#include <QObject>

#include "gui/source/background_job.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class OpeningStrip;

class GraspExport : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  GraspExport(WindowState& windowState, QWidget* window, QObject* parent);

  OpeningStrip& strip() noexcept { return *strip_; }
  bool busy() const noexcept { return job_.busy(); }

 signals:
  void written(const QStringList& paths);

 private:
  void exportEach();

  WindowState& windowState_;
  OpeningStrip* strip_;
  BackgroundJob job_;
};

}  // namespace palpate::gui
