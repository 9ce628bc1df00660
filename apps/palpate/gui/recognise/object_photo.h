// Finds photos of recognised objects: jpg or png files next to a model or in its training folder,
// named like the class ("foam ball": foam_ball.jpg or "foam ball.png"), or any photo in a subfolder
// of that name.
#pragma once

#include <QObject>
#include <QPixmap>
#include <QString>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "gui/source/file_reading.h"

namespace palpate::gui {

// Path of the photo from the first folder that has one; empty when none has.
std::filesystem::path photoOf(const QString& name,
                              const std::vector<std::filesystem::path>& folders);

// Reads each photo once, in the background, and keeps it no larger than a screen needs.
class PhotoCache : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  void setFolders(std::vector<std::filesystem::path> folders);
  // Null if there is no photo, if it can't be read, or until it has been read; changed() follows
  // then.
  const QPixmap& photo(const QString& name);

 signals:
  void changed();

 private:
  struct Photo {
    QPixmap picture;
    std::unique_ptr<FileReading> reading;
  };

  std::vector<std::filesystem::path> folders_;
  std::map<QString, Photo> photos_;
};

}  // namespace palpate::gui
