#include "gui/desktop/trash.h"

#include <QDir>
#include <QFile>
#include <QStandardPaths>

namespace palpate::gui {

bool moveFileToTrash(const QString& path) {
  // Where the folder of the user's trash is missing, Qt 6.4 would move the file into folders
  // "files" and "info" of the current directory.
  const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
  return QDir::isAbsolutePath(data) && QDir().mkpath(data + "/Trash") && QFile::moveToTrash(path);
}

}  // namespace palpate::gui
