// Saves the displayed recording, or its selected part, as a new file, in the background.
#pragma once

#include <QObject>
#include <cstddef>
#include <filesystem>
#include <optional>

#include <palpate/batch/export_extras.h>
#include <palpate/recording/recording.h>

#include "gui/source/background_job.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class OfferStrip;
class OpeningStrip;

// The filter of a file dialogue: each format that a recording can be saved in, Palpate's first.
QString recordingFormatFilter();

class CropJob : public QObject {
  Q_OBJECT
 public:
  // The window state must outlive this object. `crop` and `saveAs` start the job.
  CropJob(WindowState& windowState, QAction& crop, QAction& saveAs, QWidget* window);

  // Asks where to save the selected part of the displayed recording, and saves it.
  void cropSelection();
  // Asks where and in which format to save the whole of the displayed recording with its labels,
  // notes and grasps as they are now, and saves it.
  void saveAs();
  // Shows the progress above the centre of the window.
  OpeningStrip& strip() noexcept { return *strip_; }
  // Says that the displayed recording stays open, and offers to open the saved one.
  OfferStrip& offer() noexcept { return *offer_; }
  bool busy() const noexcept { return job_.busy(); }

  // What is saved beside `profile`, which is the recording of `source` or a part of it: what was
  // said of the recording (the settings at its start only with the whole), and for formats of other
  // programs where it comes from; for those the recording's file is read again, once per `source`.
  // Throws as exportExtras().
  static SaveExtras extrasOf(const ExportSource& source,
                             const Profile& profile,
                             const std::filesystem::path& out,
                             bool isPart);

 signals:
  void written(const QString& path);

 private:
  struct Frames {
    std::size_t first = 0, last = 0;  // both are saved
  };
  // No frames: the whole recording.
  void start(const QString& path, const std::optional<Frames>& part);

  WindowState& windowState_;
  OpeningStrip* strip_;
  OfferStrip* offer_;
  BackgroundJob job_;
};

}  // namespace palpate::gui
