// Keeps the list of the recordings that were opened last, newest first, in the settings. The start
// page and the menu File show it.
#pragma once

#include <QObject>
#include <QSettings>
#include <QStringList>

namespace palpate::gui {

class RecentFiles : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMost = 10;

  // `settings` must outlive this object.
  explicit RecentFiles(QSettings& settings, QObject* parent = nullptr);

  // Absolute paths.
  const QStringList& paths() const noexcept { return paths_; }
  // Moves the path to the front; no path is listed twice.
  void add(const QString& path);
  void remove(const QString& path);
  void removeMissing();
  void clear();
  static bool exists(const QString& path);
  // The folder in which files were chosen last; empty: none yet.
  QString lastFolder() const;
  void setLastFolder(const QString& folder);

 signals:
  void changed();

 private:
  void store();

  QSettings& settings_;
  QStringList paths_;
};

}  // namespace palpate::gui
