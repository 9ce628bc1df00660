// Saves the selected part of a recording as a new recording, in the background.
#pragma once

#include <QObject>
#include <cstddef>

#include "gui/source/background_job.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class OpeningStrip;

class CropJob : public QObject {
  Q_OBJECT
 public:
  // The window state must outlive this object. `crop` starts the job.
  CropJob(WindowState& windowState, QAction& crop, QWidget* window);

  // Asks where to save the selected part of the displayed recording, and saves it.
  void cropSelection();
  // Shows the progress above the centre of the window.
  OpeningStrip& strip() noexcept { return *strip_; }
  bool busy() const noexcept { return job_.busy(); }

 signals:
  void written(const QString& path);

 private:
  void start(const QString& path, std::size_t first, std::size_t last);

  WindowState& windowState_;
  OpeningStrip* strip_;
  BackgroundJob job_;
};

}  // namespace palpate::gui
