// The recordings that were opened last, newest first, remembered in the settings.
#pragma once

#include <QObject>
#include <QSettings>
#include <QStringList>

namespace palpate::gui {

class RecentFiles : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMost = 10;

  // `settings` must outlive this.
  explicit RecentFiles(QSettings& settings, QObject* parent = nullptr);

  const QStringList& paths() const noexcept { return paths_; }  // absolute
  void add(const QString& path);                                // to the front, once
  void remove(const QString& path);
  void removeMissing();
  void clear();
  static bool exists(const QString& path);
  // Where files were chosen last; empty: nowhere yet.
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
