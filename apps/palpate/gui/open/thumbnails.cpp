#include "gui/open/thumbnails.h"

#include <QCryptographicHash>
#include <QDir>
#include <QPainter>
#include <algorithm>

#include <palpate/core/error.h>

#include "gui/matrices/matrices_frame_painter.h"

namespace palpate::gui {

QImage thumbnailOf(const OpenedRecordingPtr& recording, qreal pixelRatio) {
  if (recording->profile.numFrames() == 0) return {};
  // Painted large, of which the matrices alone are shown.
  constexpr double kPaintedPx = 400.0;
  constexpr double kAroundPx = 3.0;
  const HandDescription& hand = recording->profile.hand();
  MatricesPictureOptions options;
  options.size = {kPaintedPx, kPaintedPx};
  options.theme = Theme::kDark;
  options.colorBar = false;
  options.font.setPixelSize(1);
  const MatricesGeometry geometry(QRectF(QPointF(), options.size), hand, options);
  QRectF matrices;
  for (std::size_t m = 0; m < geometry.numMatrices(); ++m) matrices |= geometry.matrixRect(m);
  QImage picture(kThumbnailSize * pixelRatio, QImage::Format_RGB32);
  picture.setDevicePixelRatio(pixelRatio);
  picture.fill(colorsOf(options.theme).window);
  const QRectF room =
      QRectF(QPointF(), kThumbnailSize).adjusted(kAroundPx, kAroundPx, -kAroundPx, -kAroundPx);
  const double scale = std::min(room.width() / matrices.width(), room.height() / matrices.height());
  try {
    const FramePictures::Paint paint = matricesFramePainter(recording, options);
    QPainter painter(&picture);
    painter.translate(room.center());
    painter.scale(scale, scale);
    painter.translate(-matrices.center());
    paint(painter,
          recording->isLong() ? recording->profile.numFrames() / 2
                              : recording->table.frameOfLargestSum());
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
