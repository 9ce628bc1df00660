#include "gui/open/thumbnails.h"

#include <QCryptographicHash>
#include <QDir>
#include <QPainter>

#include <palpate/core/error.h>

#include "gui/matrices/matrices_frame_painter.h"

namespace palpate::gui {

QImage thumbnailOf(const OpenedRecordingPtr& recording, qreal pixelRatio) {
  if (recording->profile.numFrames() == 0) return {};
  MatricesPictureOptions options;
  options.size = kThumbnailSize;
  options.theme = Theme::kDark;
  options.colorBar = false;
  options.pixelRatio = pixelRatio;
  options.font.setPixelSize(1);
  QImage picture(kThumbnailSize * pixelRatio, QImage::Format_RGB32);
  picture.setDevicePixelRatio(pixelRatio);
  picture.fill(colorsOf(options.theme).window);
  try {
    const std::size_t frame = recording->isLong() ? recording->profile.numFrames() / 2
                                                  : recording->table.frameOfLargestSum();
    const FramePictures::Paint paint = matricesFramePainter(recording, options);
    QPainter painter(&picture);
    paint(painter, frame);
  } catch (const Error&) {
    return {};
  }
  return picture;
}

QString Thumbnails::fileOf(const QString& path) const {
  const QByteArray key = QCryptographicHash::hash(path.toUtf8(), QCryptographicHash::Sha1).toHex();
  return folder_ + '/' + QString::fromLatin1(key) + ".png";
}

void Thumbnails::keep(const QString& path, const QImage& picture) {
  if (!picture.isNull() && QDir().mkpath(folder_)) picture.save(fileOf(path));
}

QImage Thumbnails::of(const QString& path) const { return QImage(fileOf(path)); }

void Thumbnails::keepOnly(const QStringList& paths) {
  QDir folder(folder_);
  QStringList others = folder.entryList({"*.png"}, QDir::Files);
  for (const QString& path : paths) others.removeAll(QFileInfo(fileOf(path)).fileName());
  for (const QString& other : others) folder.remove(other);
}

}  // namespace palpate::gui
