// Cuts the selected part of a recording into a new one, beside the window.
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
  // The bench must outlive it. `crop` asks for it.
  CropJob(WindowState& windowState, QAction& crop, QWidget* window);

  // Of the recording that is looked at: asks where to.
  void cropSelection();
  // A line over the centre while it is at work.
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
