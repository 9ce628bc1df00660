// The last recording that was made: gives it another name, or discards it, with all files that
// belong to it. If it is open in the window, it is closed first, and opened again under its new
// name.
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <vector>

#include "gui/window_state/window_state.h"

namespace palpate::gui {

class RecordedTake : public QObject {
  Q_OBJECT
 public:
  explicit RecordedTake(WindowState& windowState, QObject* parent = nullptr);

  // The files of the recording, one for each part; empty: none.
  void set(const std::vector<std::filesystem::path>& paths);
  const std::vector<std::filesystem::path>& paths() const noexcept { return paths_; }

  // Both ask the user first, and show why something can't be done.
  void rename();
  void discard();

  // Moves a file to the trash of the desktop; false: there is none for it. Tests replace it.
  std::function<bool(const QString& path)> moveToTrash;

 signals:
  // paths() has changed: the recording was made, renamed, or discarded.
  void changed();
  void renamed(const std::filesystem::path& from, const std::filesystem::path& to);
  // Its first part is gone: it is known by the next one from now on.
  void beginsWith(const std::filesystem::path& part, const std::filesystem::path& gone);
  void discarded(const std::filesystem::path& path);

 private:
  // The opened ones among the parts.
  std::vector<OpenedRecordingPtr> opened() const;
  void close(const std::vector<OpenedRecordingPtr>& recordings);
  // `moved` becomes the names of the files that are in the trash. False: the user keeps the others.
  bool discardFiles(QStringList& moved);
  // Says why not all of it was discarded (may be empty); paths() become what is left.
  void keepRest(const QString& why, const QStringList& moved);
  // Drops the parts of which no file is left; returns the names of the files that are.
  QStringList keepWhatIsThere();

  WindowState& windowState_;
  std::vector<std::filesystem::path> paths_;
};

}  // namespace palpate::gui
