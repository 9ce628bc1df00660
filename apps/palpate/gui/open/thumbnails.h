// Small pictures of the recordings that were opened last, for the start page: the heat maps of the
// frame with the largest sum, of a long recording of its middle. They are kept as files in a folder
// of the cache; what can't be written or read there is not shown.
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

// Size on a screen with one device pixel per pixel [px].
inline constexpr QSize kThumbnailSize{48, 56};

// Null when the recording has no frame, or the frame can't be read.
QImage thumbnailOf(const OpenedRecordingPtr& recording, qreal pixelRatio);

class Thumbnails {
 public:
  explicit Thumbnails(const QString& folder) : folder_(folder) {}
  // `path`: of the recording.
  void keep(const QString& path, const QImage& picture);
  QImage of(const QString& path) const;  // null: there is none
  // Removes the pictures of all other recordings.
  void keepOnly(const QStringList& paths);

 private:
  QString fileOf(const QString& path) const;

  QString folder_;
};

}  // namespace palpate::gui
