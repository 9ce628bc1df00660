#include "gui/recognise/object_photo.h"

#include <QDir>
#include <QImageReader>
#include <utility>

namespace palpate::gui {
namespace {

constexpr int kLargestSide = 1200;  // [px]
const QStringList kEndings = {"*.jpg", "*.jpeg", "*.png", "*.JPG", "*.JPEG", "*.PNG"};

QString objectPhotoPlain(QString name) { return name.replace('_', ' ').trimmed().toLower(); }

// Null when there is none.
QImage imageOf(const std::filesystem::path& path) {
  if (path.empty()) return {};
  QImageReader reader(QString::fromStdString(path.string()));
  reader.setAutoTransform(true);
  const QSize size = reader.size();
  if (size.width() > kLargestSide || size.height() > kLargestSide)
    reader.setScaledSize(size.scaled(kLargestSide, kLargestSide, Qt::KeepAspectRatio));
  return reader.read();
}

}  // namespace

std::filesystem::path photoOf(const QString& name,
                              const std::vector<std::filesystem::path>& folders) {
  const auto pathOf = [](const QFileInfo& info) {
    return std::filesystem::path(info.absoluteFilePath().toStdString());
  };
  for (const auto& folder : folders) {
    const QDir dir(QString::fromStdString(folder.string()));
    if (folder.empty() || !dir.exists()) continue;
    for (const QFileInfo& file : dir.entryInfoList(kEndings, QDir::Files, QDir::Name))
      if (objectPhotoPlain(file.completeBaseName()) == objectPhotoPlain(name)) return pathOf(file);
    for (const QFileInfo& sub : dir.entryInfoList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name)) {
      if (objectPhotoPlain(sub.fileName()) != objectPhotoPlain(name)) continue;
      const auto files = QDir(sub.filePath()).entryInfoList(kEndings, QDir::Files, QDir::Name);
      if (!files.isEmpty()) return pathOf(files.first());
    }
  }
  return {};
}

void PhotoCache::setFolders(std::vector<std::filesystem::path> folders) {
  if (folders == folders_) {
    // Photos that were missing may exist now.
    std::erase_if(photos_, [](const auto& one) {
      return one.second.picture.isNull() && !one.second.reading->busy();
    });
    return;
  }
  folders_ = std::move(folders);
  photos_.clear();
}

const QPixmap& PhotoCache::photo(const QString& name) {
  Photo& photo = photos_[name];
  if (photo.reading) return photo.picture;
  photo.reading = std::make_unique<FileReading>(this);
  photo.reading->start(
      [this, &photo, name, folders = folders_]() -> FileReading::Take {
        return [this, &photo, image = imageOf(photoOf(name, folders))] {
          if (image.isNull()) return;
          photo.picture = QPixmap::fromImage(image);
          emit changed();
        };
      },
      [](const QString&) {});
  return photo.picture;
}

}  // namespace palpate::gui
