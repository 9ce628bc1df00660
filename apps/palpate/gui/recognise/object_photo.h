// Finds photos of recognised objects: jpg or png files next to a model or in its training folder,
// named like the class ("foam ball": foam_ball.jpg or "foam ball.png"), or any photo in a subfolder
// of that name.
#pragma once

#include <QPixmap>
#include <QString>
#include <filesystem>
#include <map>
#include <vector>

namespace palpate::gui {

// Path of the photo from the first folder that has one; empty when none has.
std::filesystem::path photoOf(const QString& name,
                              const std::vector<std::filesystem::path>& folders);

// Reads each photo once and keeps it no larger than a screen needs.
class PhotoCache {
 public:
  void setFolders(std::vector<std::filesystem::path> folders);
  // Null when there is no photo or it cannot be read.
  const QPixmap& photo(const QString& name);

 private:
  std::vector<std::filesystem::path> folders_;
  std::map<QString, QPixmap> read_;
};

}  // namespace palpate::gui
