#include "gui/open/session_storage.h"

#include <QFileInfo>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/source/session.h"

namespace palpate::gui {

void rememberSession(WindowState& windowState) {
  DisplayedSource& displayed = windowState.displayed;
  displayed.saveViewPosition();
  Session session;
  for (const OpenedRecordingPtr& recording : windowState.recordings.all()) {
    if (recording->path == windowState.demoRecording()) continue;
    if (recording == displayed.unfilteredRecording())
      session.current = static_cast<int>(session.files.size());
    const ViewPosition* left = displayed.viewPosition(recording->path);
    session.files.push_back(
        {QFileInfo(pathText(recording->path)).absoluteFilePath(), left ? *left : ViewPosition()});
  }
  if (windowState.keepsSession && session.files.empty()) return;
  saveSession(session, windowState.settings);
}

void restoreSession(WindowState& windowState) {
  const Session session = loadSession(windowState.settings);
  std::vector<std::filesystem::path> files;
  QStringList missing;
  for (const Session::File& file : session.files) {
    const std::filesystem::path path = file.path.toStdString();
    if (!QFileInfo(file.path).isFile()) {
      missing.append(QFileInfo(file.path).fileName());
      continue;
    }
    windowState.displayed.setLeftAt(path, file.viewPosition);
    files.push_back(path);
    // The recording that was shown goes first, because the first one that can be opened is shown.
    if (session.current >= 0 && &file == &session.files[static_cast<std::size_t>(session.current)])
      std::rotate(files.begin(), files.end() - 1, files.end());
  }
  windowState.open(files);
  if (!missing.isEmpty())
    windowState.messages.fail("These recordings were open last time and are missing now: " +
                              missing.join(", "));
}

}  // namespace palpate::gui
