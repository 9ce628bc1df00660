// Photos of things that are recognised: jpg or png files beside a model or in the folder that
// taught it, called as the class
// ("foam ball": foam_ball.jpg or "foam ball.png"), or any in the folder of that name.
#pragma once

#include <QPixmap>
#include <QString>
#include <filesystem>
#include <map>
#include <vector>

namespace palpate::gui {

// Path of the photo; empty: there is none. The first folder that has one.
std::filesystem::path photoOf(const QString& name,
                              const std::vector<std::filesystem::path>& folders);

// Reads each photo once, no larger than a screen needs it.
class PhotoCache {
 public:
  void setFolders(std::vector<std::filesystem::path> folders);
  // Null: there is none, or it can't be read.
  const QPixmap& photo(const QString& name);

 private:
  std::vector<std::filesystem::path> folders_;
  std::map<QString, QPixmap> read_;
};

}  // namespace palpate::gui
