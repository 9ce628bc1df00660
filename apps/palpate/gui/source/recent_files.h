// Keeps the list of the recordings that were opened last, newest first, in the settings. The start
// page and the menu File show it.
#pragma once

#include <QObject>
#include <QSettings>
#include <QStringList>

#include "gui/source/abandonable.h"

namespace palpate::gui {

class RecentFiles : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMaximum = 10;

  // `settings` must outlive this object.
  explicit RecentFiles(QSettings& settings, QObject* parent = nullptr);

  // Absolute paths.
  const QStringList& paths() const noexcept { return paths_; }
  // Moves the path to the front; no path is listed twice.
  void add(const QString& path);
  void remove(const QString& path);
  void removeMissing();
  void clear();
  // As it was when they were last looked at.
  bool isMissing(const QString& path) const { return missing_.contains(path); }
  // Looks which are missing, in the background, as a network folder may not answer; changed()
  // follows when they are others than before.
  void look();
  // Waits until that is known, with events; for tests and pictures.
  void settle() { looking_.settle(); }
  // The folder in which files were chosen last; empty: none yet.
  QString lastFolder() const;
  void setLastFolder(const QString& folder);

 signals:
  void changed();

 private:
  void store();

  QSettings& settings_;
  QStringList paths_;
  QStringList missing_;
  Abandonable looking_;
};

}  // namespace palpate::gui
