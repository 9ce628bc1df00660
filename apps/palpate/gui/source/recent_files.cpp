#include "gui/source/recent_files.h"

#include <QFileInfo>
#include <utility>

namespace palpate::gui {
namespace {

constexpr const char* kRecentFilesKey = "recent/files";
constexpr const char* kLastFolderKey = "recent/folder";

}  // namespace

RecentFiles::RecentFiles(QSettings& settings, QObject* parent)
    : QObject(parent), settings_(settings), paths_(settings.value(kRecentFilesKey).toStringList()) {
  paths_.removeAll(QString());
  paths_ = paths_.mid(0, kMaximum);
}

void RecentFiles::add(const QString& path) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  paths_.removeAll(absolute);
  missing_.removeAll(absolute);
  paths_.prepend(absolute);
  paths_ = paths_.mid(0, kMaximum);
  store();
}

void RecentFiles::remove(const QString& path) {
  if (paths_.removeAll(path) > 0) store();
}

void RecentFiles::removeMissing() {
  const auto gone = [this](const QString& path) { return isMissing(path); };
  if (paths_.removeIf(gone) > 0) store();
}

void RecentFiles::clear() {
  paths_.clear();
  store();
}

void RecentFiles::look() {
  if (looking_.busy()) return;
  looking_.start(
      [this, paths = paths_](const Abandonable::Asker&) -> Abandonable::Take {
        QStringList missing;
        for (const QString& path : paths)
          if (!QFileInfo(path).isFile()) missing.append(path);
        return [this, missing] {
          if (std::exchange(missing_, missing) != missing) emit changed();
        };
      },
      [](const QString&) {});
}

QString RecentFiles::lastFolder() const {
  const QString folder = settings_.value(kLastFolderKey).toString();
  return folder.isEmpty() && !paths_.isEmpty() ? QFileInfo(paths_.first()).path() : folder;
}

void RecentFiles::setLastFolder(const QString& folder) {
  settings_.setValue(kLastFolderKey, folder);
}

void RecentFiles::store() {
  settings_.setValue(kRecentFilesKey, paths_);
  emit changed();
}

}  // namespace palpate::gui
